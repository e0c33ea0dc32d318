// Isolated one-texel spikes on a flat floor, and some pairs: what a march with too long a step
// misses.
#include "noise.hpp"
#include "recipes.hpp"
#include "write_image.hpp"

namespace quadrel::textures {

void write_spikes(const std::filesystem::path& directory) {
    constexpr int size = 256, pitch = 16;
    Grid<double> height(size, size);
    for (int row = 0; row < size / pitch; ++row)
        for (int column = 0; column < size / pitch; ++column) {
            const int x = column * pitch + static_cast<int>(random(column, row, 201) * pitch);
            const int y = row * pitch + static_cast<int>(random(column, row, 202) * pitch);
            const double tip = 0.5 + 0.5 * random(column, row, 203);
            height.tiled(x, y) = tip;
            // Every fourth spike has a twin: beside, above, on the diagonal, or one texel apart.
            static constexpr int twins[4][2] = {{1, 0}, {0, 1}, {1, 1}, {2, 0}};
            const int kind = static_cast<int>(random(column, row, 204) * 16);
            if (kind < 4) height.tiled(x + twins[kind][0], y + twins[kind][1]) = tip;
        }
    write_height(directory / "spikes_height.exr", height);
}

}  // namespace quadrel::textures
