// What filtered values of sRGB8 maps are off by where each texel may be decoded as if its code were
// `ErrorBudget::srgb` away.
//
// D decodes, c_i are the texels' codes and w_i their weights. While all codes move by s, f = sum
// w_i D(c_i + s) grows by sum w_i D'(c_i + s). As a function of D(c), D' is concave from 0.0137 on,
// and so no sum of weights is above its value at f; below, where D begins as a line, it is less
// than 4/3 of it. So f moves no further than its own code moves by s, or by 4/3 s where it is dark.
// Down it moves less than up, since D is convex.
#pragma once

#include "quadrel/num/srgb.hpp"
#include "quadrel/texture/range/footprint.hpp"

namespace quadrel::range_detail {

/// Of a value of a channel, or of one that is less.
inline double decoding_error(const SampledTexture& texture, int channel, double value) {
    constexpr double dark = 0.014, steepest = 2.4 / 1.055;
    constexpr int alpha = 3;
    const double codes = budget().srgb / 255;
    if (codes == 0 || channel == alpha || !range_context().is_srgb_map(texture.view.texels))
        return 0;
    const double border = texture.sampler.border[channel];
    const bool plain = !has_border(texture.sampler) || (border >= 0 && border <= 1);
    if (!plain || !(value >= 0 && value <= 1)) return codes * steepest;
    const double off = value < dark ? codes * 4 / 3 : codes;
    return srgb_decode(srgb_encode(value) + off) - value + codes * 0x1p-20;
}

/// A filtered value with it. Codes 0 and 255 are decoded exactly.
inline RealInterval decoded(const SampledTexture& texture, int channel, const RealInterval& x) {
    const double low = x.lo == 1 ? 0 : decoding_error(texture, channel, x.lo);
    const double high = x.hi == 0 ? 0 : decoding_error(texture, channel, x.hi);
    if (low == 0 && high == 0) return x;
    return {std::max(x.lo - low, std::min(x.lo, 0.0)), std::min(x.hi + high, std::max(x.hi, 1.0))};
}

}  // namespace quadrel::range_detail
