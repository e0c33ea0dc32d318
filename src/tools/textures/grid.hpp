// A rectangle of values, row 0 first.
#pragma once

#include <vector>

namespace quadrel::textures {

template <class T>
struct Grid {
    int width, height;
    std::vector<T> values;

    Grid(int w, int h, T fill = T(0))
        : width(w), height(h), values(static_cast<std::size_t>(w) * h, fill) {}

    T& at(int x, int y) { return values[static_cast<std::size_t>(y) * width + x]; }
    const T& at(int x, int y) const { return values[static_cast<std::size_t>(y) * width + x]; }

    /// The value at (x, y) of the plane tiled with this grid.
    const T& tiled(int x, int y) const {
        return at(((x % width) + width) % width, ((y % height) + height) % height);
    }
    T& tiled(int x, int y) {
        return at(((x % width) + width) % width, ((y % height) + height) % height);
    }
};

/// A grid of value(x, y).
template <class T, class Function>
Grid<T> make_grid(int width, int height, Function value) {
    Grid<T> grid(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) grid.at(x, y) = value(x, y);
    return grid;
}

}  // namespace quadrel::textures
