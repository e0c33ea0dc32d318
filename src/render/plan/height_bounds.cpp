#include "render/plan/height_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "quadrel/texture/filter.hpp"

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
        low = std::min(low, x == 0 && std::signbit(x) ? -std::numeric_limits<float>::min() : x);
        high = std::max(high, x);
    }
};

void add_level(const TextureView& view, int level, Range& range) {
    const float* texel = view.texels + view.offset[level];
    const std::ptrdiff_t texels = std::ptrdiff_t(view.width[level]) * view.height[level];
    for (std::ptrdiff_t i = 0; i < texels; ++i) range.add(texel[i * view.channels]);
}

}  // namespace

std::optional<ValueRange> height_range(const SampledTexture& map) {
    if (map.view.faces != 1) return std::nullopt;
    const int levels = map.sampler.mip == MipFilter::none ? 1 : map.view.levels;
    Range range;
    for (int level = 0; level < levels; ++level) add_level(map.view, level, range);
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
