// The bits of a channel as compact text for a page; data/page/sources.js undoes it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace quadrel::page {

/// Bits that differ from `earlier` (of the same length, or empty for none), in rows of `width` (0:
/// no rows), by one of several predictions, whichever promises the shortest text: a byte says
/// which, then come four bytes of the width, and four planes of bytes, the least significant first.
/// In a zlib stream, whose checksum finds damage; in base64.
std::string packed_bits(std::span<const std::uint32_t> bits,
                        std::span<const std::uint32_t> earlier = {}, std::size_t width = 0);

/// Text in a zlib stream, in base64.
std::string packed_text(const std::string& text);

}  // namespace quadrel::page
