#include "render/draw/lane_bits.hpp"

#include <cstring>

namespace quadrel {
namespace {

/// Four lanes at a time and without branches, which compilers make four-wide instructions of.
template <class Element, class Bits>
void write_rows(const Element* from, int quads, std::uint32_t* even, std::uint32_t* odd,
                const Bits& bits) {
    for (int q = 0; q < quads; ++q, from += 4) {
        std::uint32_t lanes[4];
        for (int k = 0; k < 4; ++k) lanes[k] = bits(from[k]);
        std::memcpy(even + 2 * q, lanes, sizeof(lanes) / 2);
        std::memcpy(odd + 2 * q, lanes + 2, sizeof(lanes) / 2);
    }
}

/// canonical_bits, by a mask.
std::uint32_t masked_canonical(std::uint32_t bits) {
    const bool nan = static_cast<std::int32_t>(bits & 0x7fffffffu) > 0x7f800000;
    const std::uint32_t mask = nan ? 0xffffffffu : 0u;
    return (bits & ~mask) | (canonical_nan & mask);
}

/// The mean of so many equal samples, added one after another.
template <int Samples>
float mean_of(float x) {
    float sum = x;
    for (int s = 1; s < Samples; ++s) sum += x;
    return sum * (1.0f / Samples);
}

/// Calls f with mean_of<samples>: with a number that compilers know.
template <class F>
void with_mean(int samples, const F& f) {
    switch (samples) {
        case 1:
            return f([](float x) { return x; });
        case 2:
            return f([](float x) { return mean_of<2>(x); });
        case 4:
            return f([](float x) { return mean_of<4>(x); });
        case 8:
            return f([](float x) { return mean_of<8>(x); });
        default:
            return f([](float x) { return mean_of<16>(x); });
    }
}

}  // namespace

void LaneBits::rows(int first, int quads, std::uint32_t* even, std::uint32_t* odd) const {
    if (element_ == Element::integer)
        return write_rows(static_cast<const std::uint32_t*>(array_) + first, quads, even, odd,
                          [](std::uint32_t x) { return x; });
    with_mean(samples_, [&, sign = sign_](const auto& mean) {
        const auto real = [&](auto x) {
            return masked_canonical(std::bit_cast<std::uint32_t>(mean(static_cast<float>(x))) ^
                                    sign);
        };
        if (element_ == Element::single)
            write_rows(static_cast<const float*>(array_) + first, quads, even, odd, real);
        else
            write_rows(static_cast<const double*>(array_) + first, quads, even, odd, real);
    });
}

}  // namespace quadrel
