// The distance transform of a line of boxes.
#pragma once

namespace quadrel {

/// Replaces values[i * stride], 0 <= i < count, by the least over boxes b of
/// values[b * stride] + d * d, d the distance from i to the box [b - 1/2, b + 1/2]. Exact up to
/// rounding. Periodic lines go on beyond their ends.
void transform_boxes(double* values, int count, int stride, bool periodic);

}  // namespace quadrel
