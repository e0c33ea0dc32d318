// Horizons against sight lines to points of the field.
#include "bake/support.hpp"

namespace quadrel::test {
namespace {

BakeOptions azimuths(int count) {
    BakeOptions options;
    options.parameters["azimuths"] = count;
    options.parameters["reach"] = 6;
    return options;
}

/// The steepest sight line from a texel's centre by many points of the ray, out to `length` tiles.
double sampled_slope(const Texture& field, const SamplerState& sampler, int i, int j,
                     double degrees, double length) {
    const double u = std::cos(degrees / 57.295779513082321),
                 v = std::sin(degrees / 57.295779513082321);
    const double own = height_at(field, sampler, i, j);
    double most = 0;
    for (int n = 1; n <= 2400; ++n) {
        const double t = length * n / 2400;
        const double h = bilinear_at(field, sampler, i + u * t * field.view().width[0],
                                     j + v * t * field.view().height[0]);
        most = std::max(most, (h - own) / t);
    }
    return most;
}

/// No point above the horizon, and (`tight`) the horizon not above all points.
testing::AssertionResult is_the_horizon(const Baker& baked, int count, bool tight) {
    for (const Texels& field : {random_field(6, 4, 51), stress_fields(7, 5)[1],
                                stress_fields(5, 5)[3], stress_fields(7, 5)[5]}) {
        for (const SamplerState& sampler :
             {sampler_with(Wrap::repeat, Wrap::mirrored_repeat),
              sampler_with(Wrap::clamp_to_edge, Wrap::repeat),
              sampler_with(Wrap::clamp_to_border, Wrap::mirror_once)}) {
            const Texels map = baked(*field, sampler);
            const int width = field->view().width[0], height = field->view().height[0];
            for (int k = 0; k < count; ++k) {
                for (int n = 0; n < width * height; n += 3) {
                    const int i = n % width, j = n / width;
                    const double stored = texel_of(*map, 0, k, i, j);
                    const double seen =
                        sampled_slope(*field, sampler, i, j, 360.0 * k / count, 6.0);
                    const double slack = tight ? 0.02 * (1 + stored) : 1e9;
                    if (stored < seen * (1 - 1e-9) - 1e-12 || stored > seen + slack)
                        return testing::AssertionFailure()
                               << describe(*field, sampler) << " texel " << i << " " << j
                               << " azimuth " << k << ": " << stored << " of " << seen;
                }
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(Horizon, HidesWhatIsBelowItAndNothingElse) {
    const Baker real = baker(BakeKind::horizon);
    EXPECT_TRUE(is_the_horizon(real, 8, true));
    EXPECT_TRUE(is_the_horizon(baker(BakeKind::horizon, azimuths(16)), 16, true));
    EXPECT_FALSE(is_the_horizon(
        changed(real, [](float v, int, int, int, int, int) { return v * 0.995f; }), 8, true))
        << static_cast<int>(Planted::lowered);
    EXPECT_FALSE(is_the_horizon(
        changed(real, [](float v, int, int, int, int, int) { return v * 1.1f + 0.1f; }), 8, true))
        << static_cast<int>(Planted::raised);
    EXPECT_FALSE(is_the_horizon(
        [&](const Texture& field, const SamplerState& sampler) {
            const Texels map = real(field, sampler);
            return with_values(*map, [&](float, int, int layer, int i, int j, int) {
                return texel_of(*map, 0, (layer + 1) % 8, i, j);
            });
        },
        8, true))
        << static_cast<int>(Planted::layers_turned);
    EXPECT_FALSE(is_the_horizon(
        [&](const Texture& field, const SamplerState&) {
            return real(field, sampler_with(Wrap::repeat, Wrap::repeat));
        },
        8, true))
        << static_cast<int>(Planted::wrap_forgotten);
    EXPECT_FALSE(is_the_horizon(baker(BakeKind::horizon_sampled), 8, true));
}

/// Sampled horizons by the definition: nearest texels at whole steps.
testing::AssertionResult samples_texels(const Texture& map, const Texture& field,
                                        const SamplerState& sampler) {
    const int width = field.view().width[0], height = field.view().height[0];
    const int steps[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    for (int k = 0; k < 8; ++k) {
        if (k % 2 == 1 && width != height) continue;
        for (int n = 0; n < width * height; ++n) {
            const int i = n % width, j = n / width;
            double most = 0;
            for (int s = 1; s <= 4 * std::max(width, height); ++s) {
                const double du = double(s * steps[k][0]) / width;
                const double dv = double(s * steps[k][1]) / height;
                const double rise =
                    height_at(field, sampler, i + s * steps[k][0], j + s * steps[k][1]) -
                    height_at(field, sampler, i, j);
                most = std::max(most, rise / std::sqrt(du * du + dv * dv));
            }
            if (std::abs(texel_of(map, 0, k, i, j) - most) > 1e-5 * (1 + most))
                return testing::AssertionFailure()
                       << "texel " << i << " " << j << " azimuth " << k << ": "
                       << texel_of(map, 0, k, i, j) << " of " << most;
        }
    }
    return testing::AssertionSuccess();
}

TEST(HorizonSampled, LooksAtTexels) {
    EXPECT_TRUE(holds_for_small_fields(baker(BakeKind::horizon_sampled), samples_texels));
    EXPECT_FALSE(
        holds_for_small_fields(changed(baker(BakeKind::horizon_sampled),
                                       [](float v, int, int, int, int, int) { return v * 0.999f; }),
                               samples_texels))
        << static_cast<int>(Planted::lowered);
    const Texels square = random_field(6, 6, 55);
    const SamplerState sampler = sampler_with(Wrap::repeat, Wrap::repeat);
    EXPECT_TRUE(
        samples_texels(*bake(*square, BakeKind::horizon_sampled, sampler), *square, sampler));
}

}  // namespace
}  // namespace quadrel::test
