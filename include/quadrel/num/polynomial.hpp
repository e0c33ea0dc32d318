// Horner's scheme, for the approximations of math.hpp.
#pragma once

#include <array>
#include <cstddef>

#include "quadrel/num/traits.hpp"

namespace quadrel {

/// c[0] + x * (c[1] + x * (c[2] + ...)).
template <Number F, std::size_t count>
F polynomial(F x, const std::array<Scalar<F>, count>& c) {
    F sum = F(c[count - 1]);
    for (std::size_t i = count - 1; i-- > 0;) sum = F(c[i]) + x * sum;
    return sum;
}

}  // namespace quadrel
