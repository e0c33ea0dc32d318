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

}  // namespace

void LaneBits::rows(int first, int quads, std::uint32_t* even, std::uint32_t* odd) const {
    const std::uint32_t sign = sign_;
    const auto real = [sign](auto x) {
        return masked_canonical(std::bit_cast<std::uint32_t>(static_cast<float>(x)) ^ sign);
    };
    const auto resolved = [this, &real](auto x) { return real(mean(static_cast<float>(x))); };
    if (element_ == Element::integer)
        write_rows(static_cast<const std::uint32_t*>(array_) + first, quads, even, odd,
                   [](std::uint32_t x) { return x; });
    else if (element_ == Element::single && samples_ > 1)
        write_rows(static_cast<const float*>(array_) + first, quads, even, odd, resolved);
    else if (samples_ > 1)
        write_rows(static_cast<const double*>(array_) + first, quads, even, odd, resolved);
    else if (element_ == Element::single)
        write_rows(static_cast<const float*>(array_) + first, quads, even, odd, real);
    else
        write_rows(static_cast<const double*>(array_) + first, quads, even, odd, real);
}

}  // namespace quadrel
