// Cone maps: no texel inside of a cone, no cone needlessly narrow.
#include <array>

#include "bake/support.hpp"

namespace quadrel::test {
namespace {

/// Where a cone may be used.
struct Sector {
    int layer, channel;
    /// A texel at an offset in tiles, half a texel being (hu, hv).
    std::function<bool(double du, double dv, double hu, double hv)> holds;
};

const std::vector<Sector> whole_circle{{0, 1, [](double, double, double, double) { return true; }}};

std::vector<Sector> quadrants() {
    return {
        {0, 0,
         [](double u, double v, double, double) { return u < 0 && -u > std::abs(v) * (1 + 1e-9); }},
        {0, 1,
         [](double u, double v, double, double) { return u > 0 && u > std::abs(v) * (1 + 1e-9); }},
        {0, 2,
         [](double u, double v, double, double) {
             return v < 0 && -v >= std::abs(u) * (1 - 1e-9);
         }},
        {0, 3, [](double u, double v, double, double) {
             return v > 0 && v >= std::abs(u) * (1 - 1e-9);
         }}};
}

/// Strictly between azimuths 45 k and 45 (k + 1).
bool in_octant(int k, double u, double v) {
    constexpr int axis[9][2] = {{1, 0},   {1, 1},  {0, 1},  {-1, 1}, {-1, 0},
                                {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    const auto &from = axis[k], &to = axis[k + 1];
    return from[0] * v - from[1] * u > 1e-9 && u * to[1] - v * to[0] > 1e-9;
}

/// Texels count where a ray can pass over them: with `squares`, where any of their area is.
std::vector<Sector> octants(bool squares) {
    std::vector<Sector> all;
    for (int k = 0; k < 8; ++k) {
        all.push_back({k / 4, k % 4, [=](double u, double v, double hu, double hv) {
                           if (!squares) return in_octant(k, u, v);
                           for (int n = 0; n < 25; ++n)
                               if (in_octant(k, u + hu * (n % 5 - 2) / 2, v + hv * (n / 5 - 2) / 2))
                                   return true;
                           return false;
                       }});
    }
    return all;
}

/// Calls visit(ratio that the texel imposes, du, dv) for every texel of the plane that is higher
/// than texel (i, j) and could reach into a cone of ratio 1.
void for_each_higher(const Texture& field, const SamplerState& sampler, int i, int j,
                     const std::function<void(double ratio, double du, double dv)>& visit) {
    const int width = field.view().width[0], height = field.view().height[0];
    const double own = height_at(field, sampler, i, j);
    for (int dj = -height - 1; dj <= height + 1; ++dj) {
        for (int di = -width - 1; di <= width + 1; ++di) {
            const double rise = height_at(field, sampler, i + di, j + dj) - own;
            const double du = double(di) / width, dv = double(dj) / height;
            if (rise > 0) visit(std::sqrt(du * du + dv * dv) / rise, du, dv);
        }
    }
}

/// No texel's centre is inside of a cone; with `tight`, each cone reaches one or has ratio 1.
MapCheck bounds_cones(const std::vector<Sector>& sectors, bool tight) {
    return [=](const Texture& map, const Texture& field, const SamplerState& sampler) {
        const TextureView& view = map.view();
        for (int k = 0; k < view.width[0] * view.height[0]; ++k) {
            const int i = k % view.width[0], j = k / view.width[0];
            std::vector<double> least(sectors.size(), 1.0);
            for_each_higher(field, sampler, i, j, [&](double ratio, double du, double dv) {
                for (std::size_t s = 0; s < sectors.size(); ++s)
                    if (sectors[s].holds(du, dv, 0.5 / view.width[0], 0.5 / view.height[0]))
                        least[s] = std::min(least[s], ratio);
            });
            for (std::size_t s = 0; s < sectors.size(); ++s) {
                const double c = texel_of(map, 0, sectors[s].layer, i, j, sectors[s].channel);
                const bool narrow = tight && c < least[s] * (1 - 1e-6);
                if (c >= 0 && c <= least[s] * (1 + 1e-13) && !narrow) continue;
                return testing::AssertionFailure() << "texel " << i << " " << j << " sector " << s
                                                   << " ratio " << c << " bound " << least[s];
            }
        }
        return testing::AssertionSuccess();
    };
}

Baker planted_cones(Planted planted, BakeKind kind, int first_channel) {
    const Baker real = baker(kind);
    if (planted == Planted::square_metric) {
        // The cones of a square texture, whose texels are as high as they are wide.
        return [=](const Texture& field, const SamplerState& sampler) {
            const float scale = float(field.view().width[0]) / float(field.view().height[0]);
            return changed(real, [=](float v, int, int, int, int, int c) {
                return c < first_channel ? v : std::min(v * std::max(scale, 1 / scale), 1.0f);
            })(field, sampler);
        };
    }
    if (planted == Planted::wrap_forgotten) {
        return [=](const Texture& field, const SamplerState&) {
            return real(field, sampler_with(Wrap::clamp_to_edge, Wrap::clamp_to_edge));
        };
    }
    if (planted == Planted::sectors_turned) {
        return [=](const Texture& field, const SamplerState& sampler) {
            const Texels map = real(field, sampler);
            return with_values(*map, [&](float, int, int layer, int i, int j, int c) {
                return texel_of(*map, 0, layer, i, j, (c + 1) % 4);
            });
        };
    }
    return changed(real, [=](float v, int, int, int, int, int c) {
        if (c < first_channel) return v;
        if (planted == Planted::ratio_an_ulp_wide) return std::nextafter(v, 2.0f);
        if (planted == Planted::ratio_halved) return v / 2;
        return planted == Planted::open_cones ? 1.0f : v;
    });
}

testing::AssertionResult keeps_heights(const Texture& map, const Texture& field,
                                       const SamplerState&) {
    const TextureView& view = map.view();
    for (int k = 0; k < view.width[0] * view.height[0]; ++k) {
        const int i = k % view.width[0], j = k / view.width[0];
        if (texel_of(map, 0, 0, i, j, 0) != texel_of(field, 0, 0, i, j, 0))
            return testing::AssertionFailure() << "height of texel " << i << " " << j;
    }
    return testing::AssertionSuccess();
}

TEST(Cone, ReachesTheNearestHigherTexelAndNoFurther) {
    EXPECT_TRUE(holds_for_small_fields(baker(BakeKind::cone), bounds_cones(whole_circle, true)));
    EXPECT_TRUE(holds_for_small_fields(baker(BakeKind::cone), keeps_heights));
    for (const Planted planted :
         {Planted::ratio_an_ulp_wide, Planted::ratio_halved, Planted::square_metric,
          Planted::open_cones, Planted::wrap_forgotten}) {
        EXPECT_FALSE(holds_for_small_fields(planted_cones(planted, BakeKind::cone, 1),
                                            bounds_cones(whole_circle, true)))
            << static_cast<int>(planted);
    }
    EXPECT_FALSE(holds_for_small_fields(
        changed(baker(BakeKind::cone),
                [](float v, int, int, int, int, int c) { return c == 0 ? v * 0.99f : v; }),
        keeps_heights));
}

TEST(Cone, QuickAndRobustConesAreNeverWider) {
    BakeOptions centres;
    centres.parameters["near_side"] = 0;
    for (const Baker& baked : {baker(BakeKind::cone_quick), baker(BakeKind::cone_quick, centres),
                               baker(BakeKind::cone_robust)}) {
        EXPECT_TRUE(holds_for_small_fields(baked, bounds_cones(whole_circle, false)));
        EXPECT_TRUE(holds_for_small_fields(baked, keeps_heights));
    }
    EXPECT_FALSE(holds_for_small_fields(planted_cones(Planted::open_cones, BakeKind::cone_quick, 1),
                                        bounds_cones(whole_circle, false)));
}

/// A quick cone is not empty where it need not be: at least half of the nearest neighbours' bound.
testing::AssertionResult quick_cones_are_of_use(const Baker& quick) {
    const Texels field = random_field(16, 16, 3);
    const SamplerState sampler = sampler_with(Wrap::repeat, Wrap::repeat);
    const Texels map = quick(*field, sampler), exact = bake(*field, BakeKind::cone, sampler);
    double sum = 0, most = 0;
    for (int k = 0; k < 256; ++k) {
        sum += texel_of(*map, 0, 0, k % 16, k / 16, 1);
        most += texel_of(*exact, 0, 0, k % 16, k / 16, 1);
    }
    if (sum > 0.4 * most && sum <= most) return testing::AssertionSuccess();
    return testing::AssertionFailure() << sum << " of " << most;
}

TEST(Cone, QuickConesAreOfUse) {
    EXPECT_TRUE(quick_cones_are_of_use(baker(BakeKind::cone_quick)));
    EXPECT_FALSE(quick_cones_are_of_use(changed(baker(BakeKind::cone_quick), [](float v, int, int,
                                                                                int, int, int c) {
        return c == 1 ? v * 0.5f : v;
    }))) << static_cast<int>(Planted::ratio_halved);
}

TEST(Cone, SectorsHoldTheirDirections) {
    const auto quads = bounds_cones(quadrants(), true);
    EXPECT_TRUE(holds_for_small_fields(baker(BakeKind::quad_cone), quads));
    for (const Planted planted : {Planted::sectors_turned, Planted::ratio_an_ulp_wide,
                                  Planted::ratio_halved, Planted::wrap_forgotten}) {
        EXPECT_FALSE(holds_for_small_fields(planted_cones(planted, BakeKind::quad_cone, 0), quads))
            << static_cast<int>(planted);
    }
    const auto eighths = bounds_cones(octants(true), false);
    EXPECT_TRUE(holds_for_small_fields(baker(BakeKind::aniso_cone), eighths));
    for (const Planted planted :
         {Planted::sectors_turned, Planted::ratio_an_ulp_wide, Planted::open_cones}) {
        EXPECT_FALSE(
            holds_for_small_fields(planted_cones(planted, BakeKind::aniso_cone, 0), eighths))
            << static_cast<int>(planted);
    }
}

/// An anisotropic map whose texels count by their centres alone.
Texels bake_by_centres(const Texture& field, const SamplerState& sampler) {
    const auto sectors = octants(false);
    return with_values(*bake(field, BakeKind::aniso_cone, sampler),
                       [&](float, int, int layer, int i, int j, int c) {
                           double least = 1;
                           for_each_higher(field, sampler, i, j, [&](double r, double u, double v) {
                               if (sectors[layer * 4 + c].holds(u, v, 0, 0))
                                   least = std::min(least, r);
                           });
                           return static_cast<float>(least * (1 - 3e-7));
                       });
}

TEST(Cone, SectorsHoldWhatTheirRaysPassOver) {
    EXPECT_TRUE(holds_for_small_fields(bake_by_centres, bounds_cones(octants(false), true)));
    EXPECT_FALSE(holds_for_small_fields(bake_by_centres, bounds_cones(octants(true), false)));
}

/// Some sector of an anisotropic cone is as wide as the cone, and none is narrower.
testing::AssertionResult sectors_are_of_use(const Baker& aniso) {
    for (const Texels& field : small_fields()) {
        const SamplerState sampler = sampler_with(Wrap::repeat, Wrap::clamp_to_edge);
        const Texels map = aniso(*field, sampler), round = bake(*field, BakeKind::cone, sampler);
        for (int k = 0; k < map->view().width[0] * map->view().height[0]; ++k) {
            const int i = k % map->view().width[0], j = k / map->view().width[0];
            float least = 1;
            for (int s = 0; s < 8; ++s)
                least = std::min(least, texel_of(*map, 0, s / 4, i, j, s % 4));
            if (least != texel_of(*round, 0, 0, i, j, 1))
                return testing::AssertionFailure() << "texel " << i << " " << j;
        }
    }
    return testing::AssertionSuccess();
}

TEST(Cone, TheNarrowestSectorIsTheCone) {
    EXPECT_TRUE(sectors_are_of_use(baker(BakeKind::aniso_cone)));
    EXPECT_FALSE(sectors_are_of_use(planted_cones(Planted::ratio_halved, BakeKind::aniso_cone, 0)));
}

/// The robust map is the least of 3x3 of the brute-force map, rounded down to codes.
testing::AssertionResult is_least_of_3x3(const Baker& robust, int bits) {
    return holds_for_small_fields(
        robust, [bits](const Texture& map, const Texture& field, const SamplerState& sampler) {
            const Texels exact = bake(field, BakeKind::cone, sampler);
            const int width = map.view().width[0], height = map.view().height[0];
            for (int k = 0; k < width * height; ++k) {
                const int i = k % width, j = k / width;
                float least = 1;
                for (int n = 0; n < 9; ++n) {
                    const int x = reference_wrap(i + n % 3 - 1, width, sampler.wrap_u);
                    const int y = reference_wrap(j + n / 3 - 1, height, sampler.wrap_v);
                    if (x >= 0 && y >= 0) least = std::min(least, texel_of(*exact, 0, 0, x, y, 1));
                }
                const float c = texel_of(map, 0, 0, i, j, 1);
                const float code = 1.0f / static_cast<float>((1 << bits) - 1);
                const bool right = bits == 0 ? c == least : c <= least && c > least - code;
                if (!right) return testing::AssertionFailure() << "texel " << i << " " << j;
                if (bits > 0 && std::nearbyint(c / code) * code != c &&
                    std::abs(std::nearbyint(c / code) - c / code) > 1e-4)
                    return testing::AssertionFailure() << c << " is no code";
            }
            return testing::AssertionSuccess();
        });
}

TEST(Cone, RobustConesAreTheLeastOf3x3) {
    BakeOptions eight;
    eight.parameters["bits"] = 8;
    EXPECT_TRUE(is_least_of_3x3(baker(BakeKind::cone_robust), 0));
    EXPECT_TRUE(is_least_of_3x3(baker(BakeKind::cone_robust, eight), 8));
    EXPECT_FALSE(is_least_of_3x3(baker(BakeKind::cone), 0))
        << static_cast<int>(Planted::no_least_of_3x3);
    EXPECT_FALSE(is_least_of_3x3(changed(baker(BakeKind::cone_robust, eight),
                                         [](float v, int, int, int, int, int c) {
                                             return c == 1 ? std::min(v + 1 / 255.0f, 1.0f) : v;
                                         }),
                                 8))
        << static_cast<int>(Planted::code_rounded_up);
    EXPECT_FALSE(is_least_of_3x3(baker(BakeKind::cone_robust), 8));
}

}  // namespace
}  // namespace quadrel::test
