// Distance volumes against distances measured in the open.
#include "bake/distance/distance_transform.hpp"

#include "bake/support.hpp"

namespace quadrel::test {
namespace {

// ---- One line -----------------------------------------------------------------------------------

using Transform = std::function<void(double* values, int count, int stride, bool periodic)>;

testing::AssertionResult is_least_over_boxes(const Transform& transform) {
    std::mt19937 random(31);
    for (int trial = 0; trial < 400; ++trial) {
        const int count = 1 + static_cast<int>(random() % 20), stride = 1 + trial % 3;
        const bool periodic = trial % 2 == 0;
        std::vector<double> values(count * stride);
        for (double& v : values) v = random() % 5 == 0 ? 0 : random() % 1000 / 10.0;
        std::vector<double> result = values;
        transform(result.data(), count, stride, periodic);
        for (int i = 0; i < count; ++i) {
            double least = 1e300;
            for (int b = periodic ? -2 * count : 0; b < (periodic ? 3 * count : count); ++b) {
                const double d = std::max(0.0, std::abs(i - b) - 0.5);
                least = std::min(least, values[(b + 2 * count) % count * stride] + d * d);
            }
            if (std::abs(result[i * stride] - least) > 1e-9)
                return testing::AssertionFailure() << result[i * stride] << " for " << least;
        }
    }
    return testing::AssertionSuccess();
}

TEST(DistanceTransform, IsTheLeastOverBoxes) {
    EXPECT_TRUE(is_least_over_boxes(transform_boxes));
    EXPECT_FALSE(is_least_over_boxes([](double* values, int count, int stride, bool) {
        transform_boxes(values, count, stride, false);
    })) << static_cast<int>(Planted::wrap_forgotten);
    EXPECT_FALSE(is_least_over_boxes([](double* values, int count, int stride, bool periodic) {
        transform_boxes(values, count, stride, periodic);
        values[0] += 1e-6;
    })) << static_cast<int>(Planted::raised);
}

// ---- The exact volume ---------------------------------------------------------------------------

constexpr int slices = 8;

BakeOptions eight_slices() {
    BakeOptions options;
    options.parameters["slices"] = slices;
    return options;
}

/// The volume at a point in voxels, trilinear, clamped below and above.
double trilinear(const Texture& map, const SamplerState& sampler, double x, double y, double z) {
    const double top = std::min(std::max(z - 0.5, 0.0), slices - 1.0);
    const int k = std::min(static_cast<int>(top), slices - 2);
    double sum = 0;
    for (int n = 0; n < 8; ++n) {
        const double fx = x - 0.5, fy = y - 0.5;
        const int i = static_cast<int>(std::floor(fx)) + n % 2;
        const int j = static_cast<int>(std::floor(fy)) + n / 2 % 2;
        const double a = fx - std::floor(fx), b = fy - std::floor(fy), c = top - k;
        const double weight = (n % 2 ? a : 1 - a) * (n / 2 % 2 ? b : 1 - b) * (n / 4 ? c : 1 - c);
        const int column = reference_wrap(i, map.view().width[0], sampler.wrap_u);
        const int row = reference_wrap(j, map.view().height[0], sampler.wrap_v);
        if (column < 0 || row < 0) return -1e300;
        sum += weight * texel_of(map, 0, k + n / 4, column, row);
    }
    return sum * slices;
}

/// The distance in voxels from a point to the bilinear surface or the tops and walls of blocks, by
/// points: not below the true one, and hardly above it.
double sampled_distance(const Texture& field, const SamplerState& sampler, double x, double y,
                        double z) {
    double least = 1e300;
    for (double dy = -6; dy <= 6; dy += 0.125) {
        for (double dx = -6; dx <= 6; dx += 0.125) {
            const int i = static_cast<int>(std::floor(x + dx));
            const int j = static_cast<int>(std::floor(y + dy));
            const double h = std::max(bilinear_at(field, sampler, x + dx - 0.5, y + dy - 0.5),
                                      height_at(field, sampler, i, j)) *
                             slices;
            const double dz = std::max(0.0, z - h);
            least = std::min(least, dx * dx + dy * dy + dz * dz);
        }
    }
    return std::sqrt(least);
}

/// Never above the distance; with the slack of interpolation and of columns not far below.
testing::AssertionResult bounds_distances(const Baker& baked) {
    std::mt19937 random(41);
    for (const Texels& field :
         {random_field(6, 5, 42), stress_fields(7, 5)[1], stress_fields(7, 5)[3]}) {
        for (const Wrap wrap :
             {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge, Wrap::mirror_once}) {
            const SamplerState sampler = sampler_with(wrap, Wrap::repeat);
            const Texels map = baked(*field, sampler);
            for (int k = 0; k < 60; ++k) {
                const double x = random() % 600 / 100.0, y = random() % 500 / 100.0;
                const double z = random() % (slices * 100) / 100.0;
                const double stored = trilinear(*map, sampler, x, y, z);
                const double true_one = sampled_distance(*field, sampler, x, y, z);
                if (stored > true_one + 1e-5 || stored < true_one - 3.5)
                    return testing::AssertionFailure()
                           << describe(*field, sampler) << " at " << x << " " << y << " " << z
                           << ": " << stored << " of " << true_one;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(DistanceExact, IsNeverAboveTheDistance) {
    const Baker real = baker(BakeKind::distance_exact, eight_slices());
    EXPECT_TRUE(bounds_distances(real));
    EXPECT_FALSE(bounds_distances(changed(real, [](float v, int, int, int, int, int) {
        return v + 0.9f / slices;
    }))) << static_cast<int>(Planted::raised);
    EXPECT_FALSE(bounds_distances(changed(real, [](float v, int, int, int, int, int) {
        return v - 3.0f / slices;
    }))) << static_cast<int>(Planted::lowered);
    EXPECT_FALSE(bounds_distances([&](const Texture& field, const SamplerState& sampler) {
        const Texels map = real(field, sampler);
        return with_values(*map, [&](float, int, int layer, int i, int j, int) {
            return texel_of(*map, 0, (layer + 2) % slices, i, j);
        });
    })) << static_cast<int>(Planted::layers_turned);
}

// ---- The published volume -----------------------------------------------------------------------

/// Distance in voxels to the nearest solid voxel, by looking at all.
double voxel_distance(const Texture& field, const SamplerState& sampler, int i, int j, int k) {
    double least = 1e300;
    for (int y = -12; y <= 12; ++y) {
        for (int x = -12; x <= 12; ++x) {
            const double h = height_at(field, sampler, i + x, j + y) * slices;
            const int top = std::max(1, static_cast<int>(std::ceil(h)) - 1);
            const int z = std::max(0, k - top);
            least = std::min(least, double(x * x + y * y + z * z));
        }
    }
    return std::sqrt(least);
}

/// The sweeps never find less than the distance and at most a little more; codes are cut.
testing::AssertionResult is_nearly_the_distance(const Texture& map, const Texture& field,
                                                const SamplerState& sampler) {
    for (int n = 0; n < map.view().width[0] * map.view().height[0] * slices; ++n) {
        const int i = n % map.view().width[0], j = n / map.view().width[0] % map.view().height[0];
        const int k = n / (map.view().width[0] * map.view().height[0]);
        const double exact = std::min(1.0, voxel_distance(field, sampler, i, j, k) / slices);
        const double stored = texel_of(map, 0, k, i, j) * 255.0;
        if (stored < exact * 255 - 1 || stored > exact * 255 + 0.3 * 255 / slices ||
            std::abs(stored - std::nearbyint(stored)) > 1e-4 || (exact == 0) != (stored == 0))
            return testing::AssertionFailure() << "voxel " << i << " " << j << " " << k << ": code "
                                               << stored << " of " << exact * 255;
    }
    return testing::AssertionSuccess();
}

TEST(Distance, SweepsFindNearlyTheDistance) {
    const Baker real = baker(BakeKind::distance, eight_slices());
    EXPECT_TRUE(holds_for_small_fields(real, is_nearly_the_distance));
    EXPECT_FALSE(holds_for_small_fields(
        changed(real, [](float v, int, int, int, int, int) { return std::min(v + 0.1f, 1.0f); }),
        is_nearly_the_distance))
        << static_cast<int>(Planted::raised);
    EXPECT_FALSE(holds_for_small_fields(
        changed(real, [](float v, int, int, int, int, int) { return std::max(v - 0.01f, 0.0f); }),
        is_nearly_the_distance))
        << static_cast<int>(Planted::lowered);
    EXPECT_FALSE(holds_for_small_fields(
        [&](const Texture& field, const SamplerState&) {
            return real(field, sampler_with(Wrap::clamp_to_edge, Wrap::clamp_to_edge));
        },
        is_nearly_the_distance))
        << static_cast<int>(Planted::wrap_forgotten);
}

}  // namespace
}  // namespace quadrel::test
