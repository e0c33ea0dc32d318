// shade-metallic-roughness against the specification's definition, which mixes a metal and a coated
// base; what each channel of its map does; and that it makes no light.
#include "shade/lighting.hpp"

namespace quadrel::test {
namespace {

constexpr const char* metallic_roughness = "shade-metallic-roughness";
constexpr double pi = 3.141592653589793;

struct GltfSurface {
    dvec3 base;
    double occlusion, roughness, metalness;
};

/// B.3: mix(dielectric_brdf, metal_brdf, metallic), each as it is named there, times pi N.L.
struct GltfBrdf {
    dvec3 N, L, V;

    double facets(double a) const {  // D G / (4 N.L N.V)
        const dvec3 H = normalize(L + V);
        const double NH = dot(N, H), NL = dot(N, L), NV = dot(N, V), a2 = a * a;
        const double D = a2 / (pi * pow(NH * NH * (a2 - 1) + 1, 2.0));
        const double GL = 2 * NL / (NL + std::sqrt(a2 + (1 - a2) * NL * NL));
        const double GV = 2 * NV / (NV + std::sqrt(a2 + (1 - a2) * NV * NV));
        return D * GL * GV / (4 * NL * NV);
    }
    double schlick() const { return pow(1 - dot(V, normalize(L + V)), 5.0); }

    /// Diffuse and specular parts.
    std::pair<dvec3, dvec3> parts(const GltfSurface& s) const {
        const double NL = dot(N, L), f = schlick(), glaze = 0.04 + 0.96 * f;
        const double sharp = dot(N, V) > 0 ? facets(s.roughness * s.roughness) : 0.0;
        const dvec3 metal = (s.base + (dvec3(1.0) - s.base) * f) * sharp;
        const dvec3 coat(glaze * sharp), under = s.base * ((1 - glaze) / pi);
        return {under * ((1 - s.metalness) * pi * NL),
                (coat * (1 - s.metalness) + metal * s.metalness) * (pi * NL)};
    }
};

Lighting expected_of(Batch<float>& batch, int lane, const GltfSurface& surface) {
    Lighting sum;
    const dvec3 P(batch.vector3(Value::hit_P, lane));
    for (int i = 0; i < batch.frame.light_count; ++i) {
        const LightUniforms& light = batch.frame.lights[i];
        const dvec3 to_light = three(light.position) - (light.directional ? dvec3(0.0) : P);
        const double d = length(to_light);
        const float(&a)[3] = light.attenuation;
        double arriving = batch.real(Value::shadow_visibility, lane, 0, i) * light.intensity;
        if (!light.directional) arriving /= a[0] + a[1] * d + a[2] * d * d;
        const GltfBrdf brdf{dvec3(batch.vector3(Value::N, lane)), to_light / d,
                            normalize(-dvec3(batch.vector3(Value::P, lane)))};
        if (dot(brdf.N, brdf.L) <= 0) continue;
        const auto [diffuse, specular] = brdf.parts(surface);
        sum.diffuse += three(light.diffuse) * diffuse * arriving;
        sum.specular += three(light.specular) * specular * arriving;
    }
    return sum;
}

/// |a - b| <= 2e-3 of b, and a little: sharp highlights of rounded cosines.
bool is_close(const vec3<float>& a, const dvec3& b) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(a[c] - b[c]) <= 2e-3 * std::abs(b[c]) + 2e-4)) return false;
    return true;
}

/// `order`: which of the map's channels holds occlusion, roughness and metalness.
testing::AssertionResult follows_the_definition(const std::array<int, 3>& order,
                                                const std::string& stage = metallic_roughness) {
    for (int i = 0; i < 40; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Batch<float> batch = random_points(random, 1 + random.below(max_lights));
        const auto part = [&] { return static_cast<float>(random.uniform(0, 1)); };
        const vec4<float> base{part(), part(), part(), part()};
        const vec4<float> gloss{part(), 0.3f + 0.7f * part(), part(), 1};
        const Map base_map = constant_map(base), gloss_map = constant_map(gloss);
        batch.bind(TextureSlot::color, base_map.sampled);
        batch.bind(TextureSlot::gloss, gloss_map.sampled);
        const auto channel = [&](int c) {
            return double(gloss[order[static_cast<std::size_t>(c)]]);
        };
        const GltfSurface surface{dvec3(base) * three(batch.material.diffuse), channel(0),
                                  channel(1) * 0.75, channel(2) * 0.5};
        Batch<float> given = batch;
        if (stage == metallic_roughness)
            batch.run(stage, {{"roughness", 0.75}, {"metalness", 0.5}});
        else
            batch.run(stage);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const Lighting sum = expected_of(given, lane, surface);
            dvec3 ambient(0.0);
            for (int l = 0; l < given.frame.light_count; ++l)
                ambient += three(given.frame.lights[l].ambient) * three(given.material.ambient) *
                           dvec3(base) * double(given.real(Value::occlusion, lane)) *
                           surface.occlusion;
            const dvec3 color =
                three(given.material.emission) + ambient + sum.diffuse + sum.specular;
            const bool good = is_close(batch.vector3(Value::light_ambient, lane), ambient) &&
                              is_close(batch.vector3(Value::light_diffuse, lane), sum.diffuse) &&
                              is_close(batch.vector3(Value::light_specular, lane), sum.specular) &&
                              is_close(batch.vector3(Value::color, lane), color) &&
                              batch.real(Value::opacity, lane) == base.w;
            if (!good)
                return testing::AssertionFailure()
                       << "batch " << i << ", lane " << lane << ": "
                       << batch.real(Value::light_specular, lane) << " for " << sum.specular.x;
        }
    }
    return testing::AssertionSuccess();
}

TEST(MetallicRoughness, FollowsTheDefinition) {
    EXPECT_TRUE(follows_the_definition({0, 1, 2}));
    for (const auto& other : {std::array{1, 0, 2}, std::array{0, 2, 1}, std::array{2, 1, 0}})
        EXPECT_FALSE(follows_the_definition(other)) << "channels exchanged";
    EXPECT_FALSE(follows_the_definition({0, 1, 2}, "shade-lambert"));
}

/// Half of the map's occlusion is half of the way to none, and other light is as it was.
TEST(MetallicRoughness, OcclusionDimsAmbientLightAlone) {
    Random random(3);
    Batch<float> batch = random_points(random, 2);
    const Map map = constant_map({0.25f, 0.5f, 0, 1});
    batch.bind(TextureSlot::gloss, map.sampled);
    Batch<float> none = batch, half = batch, full = batch;
    none.run(metallic_roughness, {{"occlusion_strength", 0}});
    half.run(metallic_roughness, {{"occlusion_strength", 0.5}});
    full.run(metallic_roughness, {{"occlusion_strength", 1}});
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const float open = none.real(Value::light_ambient, lane);
        EXPECT_FLOAT_EQ(half.real(Value::light_ambient, lane), open * 0.625f);
        EXPECT_FLOAT_EQ(full.real(Value::light_ambient, lane), open * 0.25f);
    }
    EXPECT_TRUE(same_bits<float>(none, full, values(Value::light_diffuse, Value::light_specular)));
}

/// The part of the whole sky's light over a white surface that goes to an eye at this elevation.
double reflected_part(double roughness, double metalness, double cosine) {
    constexpr int rings = 128, sectors = 32;
    Random random(1);
    Batch<float> batch = random_points(random, 1, batch_lanes);
    batch.frame.lights[0] = {{0, 0, 0}, 0, {0, 0, 0}, {1, 1, 1}, {1, 1, 1}, 1, {1, 0, 0}};
    std::fill_n(batch.material.diffuse, 3, 1.0f);
    std::fill_n(batch.material.emission, 3, 0.0f);
    const dvec3 V(std::sqrt(1 - cosine * cosine), 0, cosine);
    double sum = 0;
    for (int first = 0; first < rings * sectors; first += batch.lanes) {
        each_lane(batch, [&](int lane) {
            const int k = first + lane;
            const double z = (k / sectors + 0.5) / rings, r = std::sqrt(1 - z * z);
            const double phi = 2 * pi * (k % sectors + 0.5) / sectors;
            batch.set(Value::N, lane, dvec3(0, 0, 1));
            batch.set(Value::hit_P, lane, -dvec3(r * cos(phi), r * sin(phi), z));
            batch.set(Value::P, lane, -V);
            batch.real(Value::shadow_visibility, lane) = 1;
        });
        batch.run(metallic_roughness, {{"roughness", roughness}, {"metalness", metalness}});
        each_lane(batch, [&](int lane) { sum += batch.real(Value::color, lane); });
    }
    return sum * 2 / (rings * sectors);
}

/// Metal reflects no more than arrives, and smooth metal nearly all. Glaze over a white base does
/// at low elevations, by the definition: what the base gets is told by the half vector of each
/// light.
TEST(MetallicRoughness, MakesNoLight) {
    for (const double roughness : {0.4, 0.7, 1.0})
        for (const double metalness : {0.0, 0.5, 1.0})
            for (const double cosine : {1.0, 0.6, 0.2}) {
                const double part = reflected_part(roughness, metalness, cosine);
                const double most = metalness == 1 || cosine > 0.5 ? 1.02 : 1.15;
                EXPECT_LE(part, most) << roughness << " " << metalness << " " << cosine;
                EXPECT_GT(part, 0.3) << roughness << " " << metalness << " " << cosine;
            }
    EXPECT_NEAR(reflected_part(0.4, 1, 1), 1, 0.05);
}

/// No NaN where lights and eyes are in line with the normal or in the plane, and none of 0
/// roughness.
TEST(MetallicRoughness, IsFiniteEverywhere) {
    Random random(8);
    for (const double roughness : {0.0, 0.01, 1.0}) {
        Batch<float> batch = random_points(random, 1, batch_lanes);
        each_lane(batch, [&](int lane) {
            const dvec3 N = random_direction(random), along = cross(N, random_direction(random));
            const dvec3 ways[] = {N, -N, normalize(along), random_direction(random)};
            batch.set(Value::N, lane, N);
            batch.set(Value::hit_P, lane, -ways[lane % 4]);
            batch.set(Value::P, lane, lane % 16 < 4 ? ways[lane % 4] : -ways[lane / 4 % 4]);
        });
        batch.frame.lights[0].directional = 0;
        std::fill_n(batch.frame.lights[0].position, 3, 0.0f);
        batch.run(metallic_roughness, {{"roughness", roughness}});
        int tried = 0;
        each_lane(batch, [&](int lane) {
            // Opposite to the eye the half vector has no direction; nothing is lit there.
            for (int c = 0; c < 3; ++c) {
                const float x = batch.vector3(Value::color, lane)[c];
                EXPECT_TRUE(x >= 0 && x < 1e9f) << "lane " << lane << ": " << x;
            }
            ++tried;
        });
        EXPECT_GT(tried, 32);
    }
}

}  // namespace
}  // namespace quadrel::test
