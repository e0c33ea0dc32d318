// The headers alone, without a library: a derivative, the mip level that it selects, and a look-up
// on plain floats. Compiles with warnings, which are not Quadrel's to make errors of.
#include <cstdio>

#include "quadrel/plugin.hpp"
#include "quadrel/testing.hpp"
#include "quadrel/texture/of_texels.hpp"

using namespace quadrel;

static bool samples() {
    const float checks[] = {0, 1, 1, 0};
    SamplerState sampler;
    sampler.mag = Filter::nearest;
    const SampledTexture t = texture_of_texels(checks, 2, 2, sampler);
    const bool plain = texture_lod(t, {}, vec2<float>(0.75f, 0.25f), 0.0f).x == 1;
    const auto quad = texture_lod(t, {}, vec2<Quad<float>>(0.75f, 0.25f), 0.0f);
    return plain && unit::lane_of(quad, 0).x == 1;
}

int main() {
    int warned_about;
    const auto quad = unit::run_quad<Quad<double>>(
        4, 4, [](const auto& xy) { return xy * xy.x * Quad<double>(0.25); });
    const bool derived = quad.dFdx_fine(0) == vec2<double>(2.5, 1.125);
    const auto mip = unit::select_level({64, 64}, vec2<float>(1.0f / 16, 0), vec2<float>(0, 0.01f));
    const bool selected = mip.level == 2;
    const bool sampled = samples();
    std::printf("derived %d selected %d sampled %d\n", derived, selected, sampled);
    return derived && selected && sampled ? 0 : 1;
}
