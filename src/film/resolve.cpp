#include "quadrel/film/resolve.hpp"

#include <bit>

#include "quadrel/check.hpp"

namespace quadrel {

ColorSample resolve(std::span<const ColorSample> samples) {
    QUADREL_CHECK(std::has_single_bit(samples.size()) && samples.size() <= 16, samples.size());
    ColorSample sum = samples[0];
    for (const ColorSample& sample : samples.subspan(1)) {
        sum.r += sample.r;
        sum.g += sample.g;
        sum.b += sample.b;
        sum.a += sample.a;
        if (sample.z < sum.z || sum.z != sum.z) sum.z = sample.z;
    }
    const float scale = 1.0f / static_cast<float>(samples.size());
    sum.r *= scale;
    sum.g *= scale;
    sum.b *= scale;
    sum.a *= scale;
    return sum;
}

}  // namespace quadrel
