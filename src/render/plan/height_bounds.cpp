#include "render/plan/height_bounds.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "quadrel/texture/filter.hpp"
#include "texture/row_loop.hpp"

namespace quadrel {
namespace {

/// Lowest and highest value so far. A negative zero is counted below zero: filters give it back as
/// zero, look-ups without a filter do not, so that a map with one is not flat.
struct Range {
    float low = std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();
    bool known = true;  ///< nothing was NaN

    void add(float x) {
        known = known && !std::isnan(x);
        low = std::min(low, below_zero(x));
        high = std::max(high, x);
    }
    void add(const Range& other) {
        known = known && other.known;
        low = std::min(low, other.low);
        high = std::max(high, other.high);
    }
    static float below_zero(float x) {
        return std::bit_cast<std::uint32_t>(x) == 0x80000000u ? -std::numeric_limits<float>::min()
                                                              : x;
    }
};

/// Of a channel of `count` texels.
QUADREL_ROW_LOOP Range range_of(const float* from, std::size_t count, std::size_t channels) {
    // Side by side, so that no comparison waits for the one before.
    constexpr std::size_t side_by_side = 32;
    float low[side_by_side], high[side_by_side];
    std::uint32_t numbers[side_by_side];
    const Range nothing;
    std::fill_n(low, side_by_side, nothing.low);
    std::fill_n(high, side_by_side, nothing.high);
    std::fill_n(numbers, side_by_side, 1u);
    std::size_t i = 0;
    if (channels == 1)
        for (; i + side_by_side <= count; i += side_by_side)
            for (std::size_t k = 0; k < side_by_side; ++k) {
                const float x = from[i + k], lower = Range::below_zero(x);
                numbers[k] &= x == x ? 1u : 0u;
                low[k] = lower < low[k] ? lower : low[k];
                high[k] = x > high[k] ? x : high[k];
            }
    Range range;
    for (; i < count; ++i) range.add(from[i * channels]);
    for (std::size_t k = 0; k < side_by_side; ++k)
        range.add(Range{low[k], high[k], numbers[k] != 0});
    return range;
}

Range range_of_level(const TextureView& view, int level) {
    const float* const texels = view.texels + view.offset[level];
    const std::size_t count =
        static_cast<std::size_t>(view.width[level]) * static_cast<std::size_t>(view.height[level]);
    const auto channels = static_cast<std::size_t>(view.channels);
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, count, 1 << 16), Range(),
        [&](const tbb::blocked_range<std::size_t>& part, Range range) {
            range.add(range_of(texels + part.begin() * channels, part.size(), channels));
            return range;
        },
        [](Range a, const Range& b) {
            a.add(b);
            return a;
        });
}

}  // namespace

std::optional<ValueRange> height_range(const SampledTexture& map) {
    if (map.view.faces != 1) return std::nullopt;
    const int levels = map.sampler.mip == MipFilter::none ? 1 : map.view.levels;
    Range range;
    for (int level = 0; level < levels; ++level) range.add(range_of_level(map.view, level));
    if (has_border(map.sampler)) range.add(map.sampler.border[0]);
    const auto finite = [](float low, float high) {
        return std::isfinite(low) && std::isfinite(high);
    };
    if (!range.known || !finite(range.low, range.high)) return std::nullopt;
    if (range.low == range.high) return ValueRange{range.low, range.high};
    // a + t (b - a) is off by at most 5 units of 2^-24 of the largest magnitude, and there are
    // three of them: x, y, level.
    const float margin = std::max(std::fabs(range.low), std::fabs(range.high)) * 0x1p-20f;
    const ValueRange bounds{range.low - margin, range.high + margin};
    if (!finite(bounds.low, bounds.high)) return std::nullopt;
    return bounds;
}

std::optional<ValueRange> height_range(const SampledTexture& map, const std::string& id,
                                       TextureCache& cache) {
    const std::string name =
        fmt::format("heights {} {} {:a} {}", id, map.sampler.mip == MipFilter::none,
                    has_border(map.sampler) ? map.sampler.border[0] : 0, has_border(map.sampler));
    return cache.range(name, [&] { return height_range(map); });
}

}  // namespace quadrel
