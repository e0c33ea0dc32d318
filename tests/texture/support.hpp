// Textures of random texels, and the specification's sampler written a second time: in double, one
// coordinate at a time, with true remainders and a weighted sum of taps.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "quadrel/num/quad.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel::test {

/// A chain whose levels are unrelated random texels in [0, 1], so that no wrong level goes unseen.
struct RandomTexture {
    std::vector<float> texels;
    SampledTexture sampled{};

    RandomTexture(int width, int height, int channels, int faces = 1, std::uint32_t seed = 1) {
        TextureView& view = sampled.view;
        view.channels = channels;
        view.faces = faces;
        std::int32_t offset = 0;
        for (int w = width, h = height;; w = std::max(1, w / 2), h = std::max(1, h / 2)) {
            view.width[view.levels] = w;
            view.height[view.levels] = h;
            view.offset[view.levels++] = offset;
            offset += w * h * channels * faces;
            if (w == 1 && h == 1) break;
        }
        std::mt19937 random(seed);
        for (std::int32_t i = 0; i < offset; ++i) {
            texels.push_back(static_cast<float>(random() >> 8) * 0x1p-24f);
        }
        view.texels = texels.data();
    }
    RandomTexture(const RandomTexture&) = delete;
    RandomTexture& operator=(const RandomTexture&) = delete;
};

/// A texture of one row of one channel.
struct RowTexture : RandomTexture {
    explicit RowTexture(const std::vector<float>& row)
        : RandomTexture(static_cast<int>(row.size()), 1, 1) {
        std::copy(row.begin(), row.end(), texels.begin());
        sampled.sampler.mip = MipFilter::none;
    }
};

inline constexpr Wrap all_wraps[] = {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge,
                                     Wrap::clamp_to_border, Wrap::mirror_once};

/// Vulkan specification, "Wrapping Operation"; -1 for the border.
inline int reference_wrap(std::int64_t i, std::int64_t n, Wrap wrap) {
    const auto modulo = [](std::int64_t a, std::int64_t m) { return ((a % m) + m) % m; };
    const auto mirror = [](std::int64_t k) { return k >= 0 ? k : -(1 + k); };
    const auto edge = [&](std::int64_t k) { return std::min(std::max<std::int64_t>(k, 0), n - 1); };
    std::int64_t result = 0;
    switch (wrap) {
        case Wrap::repeat:
            result = modulo(i, n);
            break;
        case Wrap::mirrored_repeat:
            result = (n - 1) - mirror(modulo(i, 2 * n) - n);
            break;
        case Wrap::clamp_to_edge:
            result = edge(i);
            break;
        case Wrap::clamp_to_border:
            result = i < 0 || i >= n ? -1 : i;
            break;
        case Wrap::mirror_once:
            result = edge(mirror(i));
            break;
    }
    return static_cast<int>(result);
}

/// Component c of texel (x, y), not wrapped yet.
inline double reference_texel(const SampledTexture& t, int level, std::int64_t x, std::int64_t y,
                              int c) {
    const TextureView& v = t.view;
    if (c >= v.channels) return c == 3 ? 1 : 0;
    const int column = reference_wrap(x, v.width[level], t.sampler.wrap_u);
    const int row = reference_wrap(y, v.height[level], t.sampler.wrap_v);
    if (column < 0 || row < 0) return t.sampler.border[c];
    return v.texels[v.offset[level] + (row * v.width[level] + column) * v.channels + c];
}

inline double reference_level(const SampledTexture& t, double u, double v, int level, Filter filter,
                              int c) {
    const double x = u * t.view.width[level], y = v * t.view.height[level];
    if (filter == Filter::nearest) {
        return reference_texel(t, level, std::llround(std::floor(x)), std::llround(std::floor(y)),
                               c);
    }
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    const double a = x - 0.5 - left, b = y - 0.5 - top;
    double sum = 0;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            sum += (i ? a : 1 - a) * (j ? b : 1 - b) *
                   reference_texel(t, level, std::llround(left) + i, std::llround(top) + j, c);
        }
    }
    return sum;
}

/// The whole look-up for a level of detail.
inline vec4<double> reference_sample(const SampledTexture& t, double u, double v, double lod) {
    const SamplerState& s = t.sampler;
    const double clamped = std::max<double>(s.lod_min, std::min<double>(s.lod_max, lod));
    const Filter filter = clamped <= 0 ? s.mag : s.min;
    const double d =
        s.mip == MipFilter::none ? 0 : std::min(std::max(clamped, 0.0), t.view.levels - 1.0);
    vec4<double> result;
    for (int c = 0; c < 4; ++c) {
        if (s.mip == MipFilter::linear) {
            const int fine = static_cast<int>(d), coarse = std::min(fine + 1, t.view.levels - 1);
            result[c] = (1 - (d - fine)) * reference_level(t, u, v, fine, filter, c) +
                        (d - fine) * reference_level(t, u, v, coarse, filter, c);
        } else {
            const int level = static_cast<int>(std::ceil(d + 0.5)) - 1;
            result[c] = reference_level(t, u, v, level, filter, c);
        }
    }
    return result;
}

template <class F>
double first_lane(F v) {
    Scalar<F> lane[lanes_of<F>];
    store(lane, v);
    return lane[0];
}
template <class F>
vec4<double> first_lane(const vec4<F>& v) {
    return {first_lane(v.x), first_lane(v.y), first_lane(v.z), first_lane(v.w)};
}

/// The sampler under test, all lanes alike.
template <class F>
vec4<double> sample_lod(const SampledTexture& t, double u, double v, double lod) {
    using S = Scalar<F>;
    const vec2<F> uv(F(static_cast<S>(u)), F(static_cast<S>(v)));
    return first_lane(texture_lod(t, SampleContext<F>{}, uv, F(static_cast<S>(lod))));
}

using Sampler = std::function<vec4<double>(const SampledTexture&, double u, double v, double lod)>;

}  // namespace quadrel::test
