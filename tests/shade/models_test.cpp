// The reflection models against their formulas in double; nothing negative, nothing from behind.
#include "shade/lighting.hpp"

namespace quadrel::test {
namespace {

using Shading = StageUnderTest<float>;

/// One light over one fragment, in double.
struct Geometry {
    dvec3 N, L, V;
    double shininess;
    dvec3 specular;  ///< the material's
};

/// The highlight of a white light before attenuation, material colour included.
using Highlight = dvec3 (*)(const Geometry&);

dvec3 half(const Geometry& g) { return normalize(g.L + g.V); }

dvec3 no_highlight(const Geometry&) { return dvec3(0.0); }
dvec3 phong(const Geometry& g) {
    const dvec3 R = g.N * (2 * dot(g.N, g.L)) - g.L;
    return g.specular * pow(std::max(dot(R, g.V), 0.0), g.shininess);
}
dvec3 blinn(const Geometry& g) {
    return g.specular * pow(std::max(dot(half(g), g.N), 0.0), g.shininess);
}
dvec3 blinn_normalised(const Geometry& g) {
    return blinn(g) * ((g.shininess + 2) / (2 * 3.141592653589793) * dot(g.N, g.L));
}
dvec3 squared_cosine(const Geometry& g) {
    return g.specular * pow(std::max(dot(half(g), g.N), 0.0), 2.0);
}
/// Snell's and Fresnel's laws by angles: the mean of both polarisations.
double fresnel(double F0, double cosine) {
    const double n = (1 + std::sqrt(F0)) / (1 - std::sqrt(F0));
    const double t = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
    const double s = (cosine - n * t) / (cosine + n * t), p = (n * cosine - t) / (n * cosine + t);
    return (s * s + p * p) / 2;
}
dvec3 cook_torrance(const Geometry& g) {
    const dvec3 H = half(g);
    const double NH = dot(g.N, H), NV = dot(g.N, g.V), NL = dot(g.N, g.L), VH = dot(g.V, H);
    if (!(NV > 0)) return dvec3(0.0);
    const double m2 = 2 / (g.shininess + 2), tan2 = (1 - NH * NH) / (NH * NH);
    const double D = exp(-tan2 / m2) / (3.141592653589793 * m2 * NH * NH * NH * NH);
    const double G = std::min({1.0, 2 * NH * NV / VH, 2 * NH * NL / VH});
    dvec3 s;
    for (int c = 0; c < 3; ++c)
        s[c] = 3.141592653589793 * D * fresnel(std::min(g.specular[c], 0.98), VH) * G / (4 * NV);
    return s;
}

struct Model {
    const char* id;
    Highlight highlight;
};
const std::vector<Model> models = {
    {"shade-lambert", no_highlight},   {"shade-phong", phong},
    {"shade-blinn-phong", blinn},      {"shade-rabbid", blinn_normalised},
    {"shade-mcguire", squared_cosine}, {"shade-cook-torrance", cook_torrance},
};

/// The model, or one with an error in what it is given.
Shading flawed(const std::string& id, Planted planted) {
    const auto before = [&](void (*change)(Batch<float>&)) { return Shading{id, change}; };
    switch (planted) {
        case Planted::no_attenuation:
            return before([](Batch<float>& b) {
                for (LightUniforms& light : b.frame.lights) light.attenuation[2] = 0;
            });
        case Planted::first_light_only:
            return before([](Batch<float>& b) { b.frame.light_count = 1; });
        case Planted::visibility_ignored:
            return before([](Batch<float>& b) {
                each_lane(b, [&](int lane) {
                    for (int i = 0; i < max_lights; ++i)
                        b.real(Value::shadow_visibility, lane, 0, i) = 1;
                });
            });
        case Planted::occlusion_ignored:
            return before([](Batch<float>& b) { open_sky(b); });
        default:
            return {id};
    }
}

// ---- The formulas -------------------------------------------------------------------------------

/// |a - b| <= 2e-3 of b, and a little: high powers of rounded cosines.
bool close(const vec3<float>& a, const dvec3& b) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(a[c] - b[c]) <= 2e-3 * std::abs(b[c]) + 2e-4)) return false;
    return true;
}

Lighting expected_of(Batch<float>& batch, int lane, const Surface& surface, Highlight highlight) {
    Lighting sum;
    const MaterialUniforms& m = batch.material;
    for (int i = 0; i < batch.frame.light_count; ++i) {
        const LightUniforms& light = batch.frame.lights[i];
        const dvec3 P(batch.vector3(Value::hit_P, lane)), base(surface.base);
        const dvec3 to_light = three(light.position) - (light.directional ? dvec3(0.0) : P);
        const double d = length(to_light);
        const Geometry g{dvec3(batch.vector3(Value::N, lane)), to_light / d,
                         normalize(-dvec3(batch.vector3(Value::P, lane))), 255.0 * surface.gloss.r,
                         three(m.specular)};
        const float(&a)[3] = light.attenuation;
        double arriving = batch.real(Value::shadow_visibility, lane, 0, i) * light.intensity;
        if (!light.directional) arriving /= a[0] + a[1] * d + a[2] * d * d;
        sum.ambient += three(light.ambient) * three(m.ambient) * base *
                       double(batch.real(Value::occlusion, lane));
        const double cosine = dot(g.N, g.L);
        if (cosine <= 0) continue;
        sum.diffuse += three(light.diffuse) * three(m.diffuse) * base * (cosine * arriving);
        sum.specular += three(light.specular) * highlight(g) * arriving;
    }
    return sum;
}

testing::AssertionResult follows_the_formulas(const Shading& shading, Highlight highlight) {
    for (int i = 0; i < 60; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Batch<float> batch = random_points(random, random.below(max_lights + 1));
        const auto part = [&] { return static_cast<float>(random.uniform(0, 1)); };
        const Surface surface{{part(), part(), part(), part()}, {part() / 4, 0, 0, 1}, {}};
        const Map base = constant_map(surface.base), gloss = constant_map(surface.gloss);
        batch.bind(TextureSlot::color, base.sampled);
        batch.bind(TextureSlot::gloss, gloss.sampled);
        Batch<float> given = batch;
        shading.run(batch);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const Lighting sum = expected_of(given, lane, surface, highlight);
            const dvec3 color =
                three(batch.material.emission) + sum.ambient + sum.diffuse + sum.specular;
            const bool good = close(batch.vector3(Value::light_ambient, lane), sum.ambient) &&
                              close(batch.vector3(Value::light_diffuse, lane), sum.diffuse) &&
                              close(batch.vector3(Value::light_specular, lane), sum.specular) &&
                              close(batch.vector3(Value::color, lane), color) &&
                              batch.real(Value::opacity, lane) == surface.base.a;
            if (!good)
                return testing::AssertionFailure()
                       << shading.id << ": batch " << i << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(ReflectionModels, FollowTheirFormulas) {
    for (const auto& [id, highlight] : models) {
        EXPECT_TRUE(follows_the_formulas({id}, highlight));
        for (const Planted planted : {Planted::no_attenuation, Planted::first_light_only,
                                      Planted::visibility_ignored, Planted::occlusion_ignored})
            EXPECT_FALSE(follows_the_formulas(flawed(id, planted), highlight)) << id;
        for (const auto& [other, other_highlight] : models) {
            if (id == std::string(other)) continue;
            EXPECT_FALSE(follows_the_formulas({other}, highlight)) << id << " by " << other;
        }
    }
}

// ---- Signs and special points -------------------------------------------------------------------

/// Any normal, light and eye: no NaN, nothing negative, and dark where N.L <= 0.
testing::AssertionResult never_negative(const std::string& id) {
    int dark = 0;
    for (int i = 0; i < 40; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Batch<float> batch = random_points(random, 1, batch_lanes);
        std::fill_n(batch.material.ambient, 3, 0.0f);
        std::fill_n(batch.material.emission, 3, 0.0f);
        batch.material.shininess = i % 4 == 0 ? 0.0f : static_cast<float>(random.uniform(0, 2000));
        LightUniforms& light = batch.frame.lights[0];
        light.directional = 0;
        for (float& x : light.position) x = 0;
        each_lane(batch, [&](int lane) {
            const dvec3 N = random_direction(random), along = cross(N, random_direction(random));
            // Lights and eyes at the zenith, in the plane, opposite to one another, and anywhere.
            const dvec3 ways[] = {N, -N, normalize(along), random_direction(random)};
            const dvec3 L = ways[lane % 4], V = lane % 16 < 4 ? -L : ways[lane / 4 % 4];
            batch.set(Value::N, lane, N);
            batch.set(Value::hit_P, lane, -L);
            batch.set(Value::P, lane, -V);
        });
        batch.run(id);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const auto color = batch.vector3(Value::color, lane);
            for (int c = 0; c < 3; ++c)
                if (!(color[c] >= 0 && color[c] < 1e9f))
                    return testing::AssertionFailure() << "lane " << lane << ": " << color[c];
            const vec3<float> L = normalize(-batch.vector3(Value::hit_P, lane));
            if (dot(batch.vector3(Value::N, lane), L) > 0) continue;
            ++dark;
            if (color != vec3<float>(0)) return testing::AssertionFailure() << "lit from behind";
        }
    }
    return dark > 1000 ? testing::AssertionSuccess() : testing::AssertionFailure() << dark;
}

TEST(ReflectionModels, AreNeverNegativeAndDarkFromBehind) {
    for (const auto& [id, highlight] : models) EXPECT_TRUE(never_negative(id)) << id;
    EXPECT_FALSE(never_negative("shade-rabbid@published"));
}

/// A highlight at right angles to its direction with exponent 0: pow(0, 0) is 1.
TEST(ReflectionModels, ExponentZeroIsFlat) {
    for (const char* id : {"shade-phong", "shade-blinn-phong"}) {
        Random random(1);
        Batch<float> batch = random_points(random, 1);
        batch.material.shininess = 0;
        batch.frame.lights[0].directional = 1;
        const float up[3] = {0, 0, 1};
        std::copy_n(up, 3, batch.frame.lights[0].position);
        each_lane(batch, [&](int lane) {
            batch.set(Value::N, lane, dvec3(0, 0, 1));
            batch.set(Value::P, lane, dvec3(lane % 2 ? -1 : 1, 0, 0));  // R.V is 0
            batch.real(Value::shadow_visibility, lane) = 1;
        });
        batch.run(id);
        each_lane(batch, [&](int lane) {
            EXPECT_EQ(batch.real(Value::light_specular, lane), batch.frame.lights[0].specular[0] *
                                                                   batch.material.specular[0] *
                                                                   batch.frame.lights[0].intensity)
                << id;
        });
    }
}

/// Float textures may hold anything: of a gloss below 0 an exponent of 0 is left, as infinite
/// powers of a cosine of 0 would be NaN beside black.
TEST(ReflectionModels, GlossBelowZeroIsExponentZero) {
    for (const char* id : {"shade-phong", "shade-blinn-phong", "shade-rabbid",
                           "shade-cook-torrance", "shade-thesis"}) {
        Random random(3);
        const Batch<float> points = random_points(random, 2, batch_lanes);
        const auto lit = [&](float red) {
            const Map gloss = constant_map({red, 0.5f, 0.0f, 1.0f});
            Batch<float> batch = points;
            batch.bind(TextureSlot::gloss, gloss.sampled);
            batch.run(id);
            return batch;
        };
        constexpr auto color = values(Value::color, Value::light_specular);
        Batch<float> below = lit(-3.0f), zero = lit(0.0f), above = lit(3.0f);
        EXPECT_TRUE(same_bits<float>(below, zero, color)) << id;
        EXPECT_FALSE(same_bits<float>(above, zero, color)) << id;
    }
}

// ---- shade-welsh --------------------------------------------------------------------------------

/// Two undimmed lights over white, seen from the surface: the published program, bit for bit. Else
/// in [0, 1].
TEST(Welsh, GeneralisesTheProgram) {
    Random random(6);
    Batch<float> batch = random_points(random, 2, batch_lanes);
    const Map map = constant_map({0.3f, 0.7f, 0.9f, 0.5f});
    batch.bind(TextureSlot::color, map.sampled);
    each_lane(batch, [&](int lane) {
        for (int i = 0; i < 2; ++i) batch.real(Value::shadow_visibility, lane, 0, i) = 1;
        batch.set(Value::hit_P, lane, batch.vector3(Value::P, lane));
    });
    std::fill_n(batch.material.diffuse, 3, 1.0f);
    std::fill_n(batch.material.ambient, 3, 1.0f);
    for (LightUniforms& light : batch.frame.lights) {
        light.directional = 0;
        light.intensity = 1;
        for (int i = 0; i < 3; ++i) light.attenuation[i] = i == 0 ? 1.0f : 0.0f;
    }
    std::fill_n(batch.frame.lights[1].ambient, 3, 0.0f);
    Batch<float> published = batch;
    batch.run("shade-welsh");
    published.run("shade-welsh@published");
    constexpr auto color = values(Value::color, Value::opacity);
    EXPECT_TRUE(same_bits<float>(batch, published, color));
    batch.frame.lights[0].intensity = 0.5f;
    batch.run("shade-welsh");
    EXPECT_FALSE(same_bits<float>(batch, published, color));
}

TEST(Welsh, NeverExceedsTheBaseColour) {
    Random random(7);
    Batch<float> batch = random_points(random, max_lights, batch_lanes);
    for (LightUniforms& light : batch.frame.lights) light.intensity = 50;
    const Map map = constant_map({0.3f, 0.7f, 0.9f, 0.5f});
    batch.bind(TextureSlot::color, map.sampled);
    batch.run("shade-welsh");
    int full = 0;
    each_lane(batch, [&](int lane) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(batch.real(Value::color, lane, c), map.sampled.view.texels[c]);
            full += batch.real(Value::color, lane, c) == map.sampled.view.texels[c];
        }
    });
    EXPECT_GT(full, batch.lanes);
}

}  // namespace
}  // namespace quadrel::test
