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

/// Stands for the one channel that holds heights: alpha where an image has it (the usual place
/// beside a normal or a colour), else the first.
inline constexpr const char* height_swizzle = "height";

/// The swizzle of `text`, or the image's own channels if it is empty, with each source an index
/// into the image's channels: luminance answers for r, g and b, a missing alpha is 1.
std::vector<SwizzleEntry> resolve_swizzle(const std::string& text, const Image& image,
                                          const std::string& key);

}  // namespace quadrel
