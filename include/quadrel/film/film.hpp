// A rendered image: named planes over a window of the frame.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quadrel {

/// Half-open rectangle in image coordinates: pixels from the top-left, y down.
struct Window {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    /// Pixels in the window.
    std::size_t area() const {
        return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
    }
    bool operator==(const Window&) const = default;
};

/// Whether `inner` lies in `outer`.
bool contains(const Window& outer, const Window& inner);

enum class ChannelType : std::int32_t { float32, uint32 };

/// The one NaN that films, files and hashes know: which payload an operation gives depends on the
/// compiler and on the instruction set.
inline constexpr std::uint32_t canonical_nan = 0x7fc00000u;

/// `bits` of a float32, with every NaN as canonical_nan.
constexpr std::uint32_t canonical_bits(std::uint32_t bits) {
    return (bits & 0x7fffffffu) > 0x7f800000u ? canonical_nan : bits;
}

/// One plane, row-major from the window's top-left. Floats are kept by their bits, with every NaN
/// written as 0x7fc00000.
struct Plane {
    std::string name;
    ChannelType type = ChannelType::float32;
    std::vector<std::uint32_t> bits;

    float as_float(std::size_t i) const;
    bool operator==(const Plane&) const = default;
};

struct Film {
    Window frame;   ///< the whole image
    Window window;  ///< the part that the planes hold
    std::vector<Plane> planes;

    const Plane* find(const std::string& name) const;  ///< null if there is none
    Plane* find(const std::string& name);
    /// Adds a plane of `window`'s size, every value `fill` (its bits). The name must be free.
    Plane& add(const std::string& name, ChannelType type, std::uint32_t fill = 0);
    /// Index of the pixel at image coordinates (x, y), which must lie in the window.
    std::size_t index(int x, int y) const;
    bool operator==(const Film&) const = default;
};

/// What two windows share; empty, with a width or height of 0 or less, where they share nothing.
Window intersection(const Window& a, const Window& b);

/// Keeps the pixels of `window`, which must lie in the film's; the frame stays.
void crop(Film& film, const Window& window);

/// Rewrites every NaN of the float planes as canonical_nan.
void canonicalize(Film& film);

/// SHA-256 (hex) over frame, window and each plane's name, type and bits. Neither the order of the
/// planes nor the payload of a NaN matters; everything else does.
std::string film_hash(const Film& film);

/// Puts films of disjoint windows of one frame together. The windows must tile their common
/// bounding rectangle without gap or overlap and hold the same channels; the first film's order of
/// planes is kept. Throws UsageError where they do not fit.
Film join(std::span<const Film> parts);

}  // namespace quadrel
