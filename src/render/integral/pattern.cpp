#include "render/integral/pattern.hpp"

#include "quadrel/render.hpp"

namespace quadrel {
namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Each bit is flipped by a hash of those below it: Burley 2020, listing 2 (Laine and Karras).
std::uint32_t permute(std::uint32_t x, std::uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

/// Each bit is flipped by a hash of those above it.
std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
    return reverse_bits(permute(reverse_bits(x), seed));
}

/// The second dimension of Sobol's sequence, whose first is reverse_bits: the direction numbers of
/// the polynomial x + 1 are v_k = v_(k-1) ^ (v_(k-1) >> 1), rows of Pascal's triangle.
std::uint32_t sobol(std::uint32_t index) {
    std::uint32_t x = 0;
    for (std::uint32_t v = 0x80000000u; index != 0; index >>= 1, v ^= v >> 1)
        if ((index & 1u) != 0) x ^= v;
    return x;
}

/// The finalizer of SplitMix64.
std::uint64_t mix_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// A 12-bit part of the pixel, by its centre.
std::int32_t centre(std::uint32_t fraction) {
    constexpr int parts_bits = 12;
    static_assert(place_units == 2 << parts_bits);
    return 2 * static_cast<std::int32_t>(fraction >> (32 - parts_bits)) + 1;
}

}  // namespace

SamplePlace sample_place(int x, int y, int sample) {
    const auto replicate = static_cast<std::uint64_t>(sample % IntegralOptions::replicates);
    const auto index = static_cast<std::uint32_t>(sample / IntegralOptions::replicates);
    const std::uint64_t quad = static_cast<std::uint64_t>(x) << 32 | static_cast<std::uint64_t>(y);
    const std::uint64_t seed = mix_bits(mix_bits(quad) + replicate);
    return {centre(scramble(reverse_bits(index), static_cast<std::uint32_t>(seed))),
            centre(scramble(sobol(index), static_cast<std::uint32_t>(seed >> 32)))};
}

}  // namespace quadrel
