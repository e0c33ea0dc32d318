// Inputs that several probes are made of.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "rules/probe.hpp"

namespace quadrel::rules {

/// Sides of frames: of few questions, and of many.
inline constexpr int side = 16, fine_side = 32;

using Asked = std::vector<std::array<float, 4>>;

/// One number for each pixel of a frame: number(i), i = 0, 1, ... row by row.
template <class Number>
Asked ask_pixels(int width, int height, const Number& number) {
    Asked asked;
    for (int i = 0; i < width * height; ++i) asked.push_back(number(i));
    return asked;
}

/// One for each quad, in all of its lanes.
template <class Number>
Asked ask_quads(int width, int height, const Number& number) {
    Asked asked;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) asked.push_back(number((y / 2) * (width / 2) + x / 2));
    return asked;
}

/// Answer `channel` of pixel i.
inline float answer(const Values& values, std::size_t i, std::size_t channel = 0) {
    return values[4 * i + channel];
}

/// SplitMix64: the same numbers everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [low, high).
    float in(float low, float high) {
        return low + (high - low) * static_cast<float>(bits() >> 40) * 0x1p-24f;
    }

  private:
    std::uint64_t state_;
};

/// Window coordinates of a frame of `width` x `height` pixels as a vertex.
inline Corner corner(double x, double y, int width, int height, std::array<float, 4> varying = {}) {
    return {{static_cast<float>(2 * x / width - 1), static_cast<float>(2 * y / height - 1), 0, 1},
            varying};
}

/// [x0, x1) x [y0, y1), two triangles.
inline void add_rectangle(std::vector<Triangle>& to, double x0, double y0, double x1, double y1,
                          int width, int height) {
    const auto at = [&](double x, double y) { return corner(x, y, width, height); };
    to.push_back({at(x0, y0), at(x1, y0), at(x1, y1)});
    to.push_back({at(x0, y0), at(x1, y1), at(x0, y1)});
}

/// A texture whose levels are their own numbers: a look-up gives the level of detail.
inline ProbeTexture level_numbers(int size, const SamplerState& sampler = {}) {
    ProbeTexture map;
    map.width = map.height = size;
    map.sampler = sampler;
    for (int level = 0; size >> level > 0; ++level)
        map.levels.emplace_back(
            static_cast<std::size_t>(size >> level) * static_cast<std::size_t>(size >> level),
            static_cast<float>(level));
    return map;
}

/// Of weights over [0, 1]: how many bits tell them apart.
std::string bits_words(const Values& values);

}  // namespace quadrel::rules
