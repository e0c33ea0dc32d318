#include "floors/look_ups.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "support/clock.hpp"

namespace quadrel::peers {
namespace {

// Compiled into each of its callers, with the instruction set of that one.
#define QUADREL_FLOOR_INLINE [[gnu::always_inline]] inline

constexpr int samples = 8;
constexpr std::size_t chunk = 4096;  ///< places that stay in the first cache

struct HeightMap {
    const float* texels;
    int width, height;
};

struct Span {
    const float *u, *v, *du, *dv;
    float* sum;
    std::size_t count;
};

/// Adds the k-th samples. Pointers that stand for themselves, or compilers make no vectors of it.
QUADREL_FLOOR_INLINE void sample(const float* __restrict texels, int width, int height, float k,
                                 const float* __restrict us, const float* __restrict vs,
                                 const float* __restrict dus, const float* __restrict dvs,
                                 float* __restrict sums, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float x = (us[i] + k * dus[i]) * static_cast<float>(width) - 0.5f;
        const float y = (vs[i] + k * dvs[i]) * static_cast<float>(height) - 0.5f;
        const float left = __builtin_floorf(x), top = __builtin_floorf(y);
        const float part_x = x - left, part_y = y - top;
        const int column = static_cast<int>(left), row = static_cast<int>(top);
        const int x0 = column & (width - 1), x1 = (column + 1) & (width - 1);
        const int y0 = (row & (height - 1)) * width, y1 = ((row + 1) & (height - 1)) * width;
        const float a = texels[y0 + x0], b = texels[y0 + x1];
        const float c = texels[y1 + x0], d = texels[y1 + x1];
        const float low = a + (b - a) * part_x, high = c + (d - c) * part_x;
        sums[i] += low + (high - low) * part_y;
    }
}

QUADREL_FLOOR_INLINE void walk(const HeightMap& map, const Span& s) {
    for (int k = 0; k < samples; ++k)
        sample(map.texels, map.width, map.height, static_cast<float>(k), s.u, s.v, s.du, s.dv,
               s.sum, s.count);
}

void walk_plain(const HeightMap& map, const Span& s) { walk(map, s); }
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target("avx2,tune=haswell")]] void walk_avx2(const HeightMap& map, const Span& s) {
    walk(map, s);
}
[[gnu::target("avx512f,avx512dq,avx512vl,prefer-vector-width=512,tune=icelake-server")]] void
walk_avx512(const HeightMap& map, const Span& s) {
    walk(map, s);
}
auto widest_walk() {
    if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return walk_avx512;
    return __builtin_cpu_supports("avx2") ? walk_avx2 : walk_plain;
}
#else
auto widest_walk() { return walk_plain; }
#endif

/// Four channels of a texel, which fill a register.
using Rgba [[gnu::vector_size(16)]] = float;

QUADREL_FLOOR_INLINE Rgba mixed(Rgba a, Rgba b, float part) { return a + (b - a) * part; }

QUADREL_FLOOR_INLINE Rgba texel(const TextureView& map, int level, int x, int y) {
    Rgba r;
    const int place = map.offset[level] + 4 * (y * map.width[level] + x);
    std::memcpy(&r, map.texels + place, sizeof r);
    return r;
}

QUADREL_FLOOR_INLINE Rgba bilinear(const TextureView& map, int level, float u, float v) {
    const int width = map.width[level], height = map.height[level];
    // Places are far above -1024: cutting off what is behind the point rounds down.
    constexpr int whole = 1024;
    const float x = u * static_cast<float>(width) - 0.5f, y = v * static_cast<float>(height) - 0.5f;
    const int i = static_cast<int>(x + whole) - whole, j = static_cast<int>(y + whole) - whole;
    const float part_x = x - static_cast<float>(i), part_y = y - static_cast<float>(j);
    const int x0 = i & (width - 1), x1 = (i + 1) & (width - 1);
    const int y0 = j & (height - 1), y1 = (j + 1) & (height - 1);
    return mixed(mixed(texel(map, level, x0, y0), texel(map, level, x1, y0), part_x),
                 mixed(texel(map, level, x0, y1), texel(map, level, x1, y1), part_x), part_y);
}

void colours(const TextureView& map, const Places& places, std::vector<float>& out) {
    for (std::size_t i = 0; i < places.u.size(); ++i) {
        const int fine = std::min(static_cast<int>(places.level[i]), map.levels - 1);
        const int coarse = std::min(fine + 1, map.levels - 1);
        const Rgba rgba = mixed(bilinear(map, fine, places.u[i], places.v[i]),
                                bilinear(map, coarse, places.u[i], places.v[i]),
                                places.level[i] - static_cast<float>(fine));
        std::memcpy(&out[4 * (i % chunk)], &rgba, sizeof rgba);
    }
}

/// Least nanoseconds for each of `count` that `work` does.
template <class Work>
double least_ns(std::size_t count, int repeats, const Work& work) {
    bench::Least least;
    for (int i = 0; i <= repeats; ++i) least.add(bench::timed(CLOCK_PROCESS_CPUTIME_ID, work));
    return 1e9 * least.value() / static_cast<double>(count);
}

}  // namespace

double height_look_up_ns(const TextureView& map, const Places& places, int repeats) {
    const HeightMap heights{map.texels + map.offset[0], map.width[0], map.height[0]};
    std::vector<float> sums(chunk);
    const auto widest = widest_walk();
    const std::size_t all = places.u.size();
    return least_ns(samples * all, repeats, [&] {
        for (std::size_t at = 0; at < all; at += chunk)
            widest(heights, {&places.u[at], &places.v[at], &places.du[at], &places.dv[at],
                             sums.data(), std::min(chunk, all - at)});
    });
}

double colour_look_up_ns(const TextureView& map, const Places& places, int repeats) {
    std::vector<float> out(4 * chunk);
    return least_ns(places.u.size(), repeats, [&] { colours(map, places, out); });
}

double four_floats_ns(std::size_t places, int repeats) {
    std::vector<float> planes(4 * places);
    int value = 0;
    return least_ns(places, repeats,
                    [&] { std::memset(planes.data(), ++value, planes.size() * sizeof(float)); });
}

}  // namespace quadrel::peers
