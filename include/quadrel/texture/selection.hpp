// Which image is meant, where a file holds several.
#pragma once

#include <string>

namespace quadrel {

/// Of an EXR file; other formats hold one image here.
struct ImageSelection {
    /// The channels that begin with "<layer>.", taken without that; or all channels of the part
    /// that has this name. Empty: all channels.
    std::string layer;
    /// A part's name, or its number from 0; a name wins. Empty: the only part; with a layer, the
    /// part of its name or the only one that has such channels.
    std::string part;

    bool empty() const { return layer.empty() && part.empty(); }
    bool operator==(const ImageSelection&) const = default;
};

}  // namespace quadrel
