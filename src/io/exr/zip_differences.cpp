#include "io/exr/zip_differences.hpp"

#include <cstddef>

namespace quadrel {
namespace {

std::uint8_t difference(std::uint8_t byte, std::uint8_t before) {
    return static_cast<std::uint8_t>(byte - before + 128);
}

}  // namespace

void zip_differences(std::span<const std::uint8_t> bytes, std::uint8_t* out) {
    const std::uint8_t* const in = bytes.data();
    const std::size_t size = bytes.size(), even = (size + 1) / 2, odd = size / 2;
    if (size == 0) return;
    out[0] = in[0];
    for (std::size_t i = 1; i < even; ++i) out[i] = difference(in[2 * i], in[2 * i - 2]);
    if (odd > 0) out[even] = difference(in[1], in[2 * even - 2]);
    for (std::size_t i = 1; i < odd; ++i) out[even + i] = difference(in[2 * i + 1], in[2 * i - 1]);
}

}  // namespace quadrel
