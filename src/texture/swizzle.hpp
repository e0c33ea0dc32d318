// Swizzles: which channel of an image, complement or constant each channel of a texture takes.
#pragma once

#include <string>
#include <vector>

#include "quadrel/texture/image.hpp"

namespace quadrel {

/// One output channel.
struct SwizzleEntry {
    int source;       ///< 0 to 3: r g b a; -1: the constant
    bool complement;  ///< 1 - source
    int constant;     ///< 0 or 1
};

/// Parses "rgba", "1-r", "gba1", "r 1-g 0 1"; spaces and commas separate where wished. The result
/// has 1, 2 or 4 entries. Throws InputError naming `file` and `key`.
std::vector<SwizzleEntry> parse_swizzle(const std::string& text, const std::string& file,
                                        const std::string& key);

/// A swizzle of one channel: alpha where an image has it, else the first. For what reads maps whose
/// heights may or may not be packed beside a normal or a colour.
inline constexpr const char* alpha_or_first = "alpha-or-first";

/// The swizzle of `text`, or the image's own channels if it is empty, with each source an index
/// into the image's channels: luminance answers for r, g and b, a missing alpha is 1.
std::vector<SwizzleEntry> resolve_swizzle(const std::string& text, const Image& image,
                                          const std::string& key);

}  // namespace quadrel
