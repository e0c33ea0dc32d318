// Maps of random heights, and another reading of the field that displaces: texel by texel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "quadrel/scene/displace.hpp"
#include "quadrel/texture/of_texels.hpp"
#include "random.hpp"

namespace quadrel {

/// A map of random heights.
struct Map {
    Map(int width, int height, Wrap wrap = Wrap::repeat, std::uint64_t seed = 1) {
        test::Random random(seed);
        for (int i = 0; i < width * height; ++i)
            texels.push_back(static_cast<float>(random.uniform(0, 1)));
        SamplerState sampler;
        sampler.wrap_u = sampler.wrap_v = wrap;
        sampler.border[0] = 0.25f;
        heights = texture_of_texels(texels, width, height, sampler);
    }
    Map(const Map&) = delete;
    Map& operator=(const Map&) = delete;

    std::vector<float> texels;
    SampledTexture heights;
};

inline int wrapped(long i, int n, Wrap wrap) {
    const auto mod = [](long a, long b) { return (a % b + b) % b; };
    switch (wrap) {
        case Wrap::repeat:
            return int(mod(i, n));
        case Wrap::mirrored_repeat:
            return int(mod(i, 2L * n) < n ? mod(i, 2L * n) : 2 * n - 1 - mod(i, 2L * n));
        case Wrap::clamp_to_border:
            return i < 0 || i >= n ? -1 : int(i);
        case Wrap::mirror_once:
            return int(std::min<long>(i < 0 ? -1 - i : i, n - 1));
        default:
            return int(std::clamp<long>(i, 0, n - 1));
    }
}

inline double texel(const Map& map, long i, long j) {
    const TextureView& view = map.heights.view;
    const int x = wrapped(i, view.width[0], map.heights.sampler.wrap_u);
    const int y = wrapped(j, view.height[0], map.heights.sampler.wrap_v);
    if (x < 0 || y < 0) return map.heights.sampler.border[0];
    return map.texels[std::size_t(y) * std::size_t(view.width[0]) + std::size_t(x)];
}

inline double bilinear(const Map& map, double x, double y) {
    const double i = std::floor(x), j = std::floor(y), f = x - i, g = y - j;
    const auto at = [&](int a, int b) { return texel(map, long(i) + a, long(j) + b); };
    return (at(0, 0) * (1 - f) + at(1, 0) * f) * (1 - g) + (at(0, 1) * (1 - f) + at(1, 1) * f) * g;
}

/// Where a point of texture space lies in its cell.
struct Cell {
    double i, j, f, g;
    bool main;
    double h00, h10, h01, h11;
    bool beyond() const { return main ? g > f : f + g > 1; }
    double height() const {
        if (main)
            return h00 + (beyond() ? f * (h11 - h01) + g * (h01 - h00)
                                   : f * (h10 - h00) + g * (h11 - h10));
        if (!beyond()) return h00 + f * (h10 - h00) + g * (h01 - h00);
        return h11 + (1 - f) * (h01 - h11) + (1 - g) * (h10 - h11);
    }
};

inline Cell cell_at(const Map& map, const Displacement& d, const glm::dvec2& uv) {
    const TextureView& view = map.heights.view;
    const double x = d.cells > 0 ? uv.x * d.cells : uv.x * view.width[0] - 0.5;
    const double y = d.cells > 0 ? uv.y * d.cells : uv.y * view.height[0] - 0.5;
    const double i = std::floor(x), j = std::floor(y);
    const auto at = [&](double a, double b) {
        if (d.cells == 0) return texel(map, long(a), long(b));
        return bilinear(map, a / d.cells * view.width[0] - 0.5, b / d.cells * view.height[0] - 0.5);
    };
    Cell cell{i, j, x - i, y - j, false, at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)};
    cell.main = d.split == CellSplit::main ||
                (d.split == CellSplit::min &&
                 std::abs(cell.h00 - cell.h11) <= std::abs(cell.h10 - cell.h01));
    return cell;
}

}  // namespace quadrel
