// Whether a ray that has met a height field comes out of it again. Tells a search that stopped
// inside of the relief, behind the first hit, from one that passed through a feature and met
// another.
#pragma once

#include "quadrel/relief/trace/oracle/first_hit.hpp"

namespace quadrel::oracle {

/// Whether the field is below the ray by more than 2^-20 of the relief's depth anywhere at s in
/// [from, to], which is clipped to [0, 1]. In double, not proven. Cells are looked at one by one;
/// after 2^16 of them the answer is no.
bool emerges(const Field& field, const Ray& ray, double from, double to);

}  // namespace quadrel::oracle
