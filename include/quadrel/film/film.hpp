// A rendered image: named planes over a window of the frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quadrel {

/// Half-open rectangle in image coordinates: pixels from the top-left, y down.
struct Window {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool operator==(const Window&) const = default;
};

enum class ChannelType : std::int32_t { float32, uint32 };

/// One plane, row-major from the window's top-left. Floats are kept by their bits, with every NaN
/// written as 0x7fc00000.
struct Plane {
    std::string name;
    ChannelType type = ChannelType::float32;
    std::vector<std::uint32_t> bits;

    float as_float(std::size_t i) const;
};

struct Film {
    Window frame;   ///< the whole image
    Window window;  ///< the part that the planes hold
    std::vector<Plane> planes;

    const Plane* find(const std::string& name) const;
};

}  // namespace quadrel
