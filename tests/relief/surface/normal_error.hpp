// How far the normals of a batch are from what they should be.
#pragma once

#include "relief/inputs.hpp"

namespace quadrel::test {

/// Largest distance between the stage's normals and `expected`; NaN if one is.
inline double largest_error(Batch<float>& batch, const dvec3& expected) {
    double worst = 0;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const double error = length(dvec3(batch.vector3(Value::N, lane)) - expected);
        if (!(error <= worst)) worst = error;
    }
    return worst;
}

}  // namespace quadrel::test
