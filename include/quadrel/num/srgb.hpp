// The sRGB transfer function (IEC 61966-2-1), on any number type; the scene side uses double.
#pragma once

#include "quadrel/num/pow.hpp"

namespace quadrel {

/// Code value in [0, 1] to linear: c / 12.92 up to 0.04045, ((c + 0.055) / 1.055)^2.4 above.
/// Negative codes follow the linear part; NaN stays NaN.
template <Number F>
F srgb_decode(F code) {
    using T = Scalar<F>;
    const F linear = code / F(T(12.92));
    const F curve = pow((code + F(T(0.055))) / F(T(1.055)), F(T(2.4)));
    return select(code <= F(T(0.04045)), linear, curve);
}
/// Linear in [0, 1] to code value: 12.92 c up to 0.0031308, 1.055 c^(1/2.4) - 0.055 above.
/// Negative values follow the linear part; NaN stays NaN.
template <Number F>
F srgb_encode(F linear) {
    using T = Scalar<F>;
    const F curve = F(T(1.055)) * pow(linear, F(T(1 / 2.4))) - F(T(0.055));
    return select(linear <= F(T(0.0031308)), linear * F(T(12.92)), curve);
}

}  // namespace quadrel
