// The bits of a channel as compact text for a page; data/page/sources.js undoes it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace quadrel::page {

/// Bits that differ from `earlier` (of the same length, or empty for none), as four planes of
/// bytes, the least significant first, each byte as the difference to the one before; in a zlib
/// stream, whose checksum finds damage; in base64.
std::string packed_bits(std::span<const std::uint32_t> bits,
                        std::span<const std::uint32_t> earlier = {});

}  // namespace quadrel::page
