// The corrected lighting against the Phong formulas, and the identities that they imply.
#include "shade/lighting.hpp"

namespace quadrel::test {
namespace {

using Shading = StageUnderTest<float>;

Shading before(void (*change)(Batch<float>&)) { return {"shade-thesis", change}; }
Shading after(void (*change)(Batch<float>&, int)) {
    return {"shade-thesis", {}, [change](Batch<float>& b) {
                each_lane(b, [&](int lane) { change(b, lane); });
            }};
}

/// color = mix(mix(refraction, phong, a), reflection, mirror) of the terms, with another order or
/// another phong.
vec3<float> combine(Batch<float>& b, int lane, bool mirror_first, bool emission) {
    const auto term = [&](Value v) { return b.vector3(v, lane); };
    vec3<float> phong = term(Value::light_emissive);
    if (!emission) phong = vec3<float>(0);
    phong = phong + term(Value::light_ambient) + term(Value::light_diffuse) +
            term(Value::light_specular);
    const float a = b.real(Value::opacity, lane);
    const SampledTexture* map = b.bound(TextureSlot::gloss);
    const float mirror = map ? map->view.texels[2] : 0.0f;
    const vec3<float> bent = term(Value::light_refraction), back = term(Value::light_reflection);
    if (mirror_first) return mix(mix(bent, back, mirror), phong, a);
    return mix(mix(bent, phong, a), back, mirror);
}

/// The stage with an error in what it is given.
Shading misled(Planted planted) {
    switch (planted) {
        case Planted::no_attenuation:
            return before([](Batch<float>& b) {
                for (LightUniforms& light : b.frame.lights) light.directional = 1;
            });
        case Planted::linear_as_quadratic:
            return before([](Batch<float>& b) {
                for (auto& light : b.frame.lights)
                    std::swap(light.attenuation[1], light.attenuation[2]);
            });
        case Planted::first_light_only:
            return before([](Batch<float>& b) { b.frame.light_count = 1; });
        case Planted::visibility_ignored:
            return before([](Batch<float>& b) {
                each_lane(b, [&](int lane) {
                    for (int i = 0; i < max_lights; ++i) {
                        b.real(Value::shadow_visibility, lane, 0, i) = 1;
                    }
                });
            });
        case Planted::environment_turns:
            return before([](Batch<float>& b) {
                std::copy_n(default_frame().eye_to_world, 9, b.frame.eye_to_world);
            });
        default:
            return {"shade-thesis"};
    }
}

/// The stage with an error in what it gives, or in neither.
Shading shading(Planted planted = Planted::none) {
    switch (planted) {
        case Planted::as_published:
            return {"shade-thesis@published"};
        case Planted::highlight_on_dark_side:
            return after(
                [](Batch<float>& b, int lane) { b.real(Value::light_specular, lane) = 1; });
        case Planted::ambient_shadowed:
            return after([](Batch<float>& b, int lane) {
                b.set(
                    Value::light_ambient, lane,
                    b.vector3(Value::light_ambient, lane) * b.real(Value::shadow_visibility, lane));
            });
        case Planted::mirror_before_opacity:
            return after([](Batch<float>& b, int lane) {
                b.set(Value::color, lane, combine(b, lane, true, true));
            });
        case Planted::emission_forgotten:
            return after([](Batch<float>& b, int lane) {
                b.set(Value::color, lane, combine(b, lane, false, false));
            });
        case Planted::black_total_reflection:
            return after([](Batch<float>& b, int lane) {
                if (b.vector3(Value::light_refraction, lane) ==
                    b.vector3(Value::light_reflection, lane)) {
                    b.set(Value::light_refraction, lane, dvec3(0.0));
                }
            });
        case Planted::opacity_of_white:
            return after([](Batch<float>& b, int lane) { b.real(Value::opacity, lane) = 1; });
        default:
            return misled(planted);
    }
}

/// A random material with one-texel maps.
struct Mapped {
    Surface surface;
    Map base, gloss, glow, environment;

    Mapped(Random& random, Batch<float>& batch) {
        const auto texel = [&] {
            vec4<float> t;
            for (int c = 0; c < 4; ++c) t[c] = static_cast<float>(random.uniform(0, 1));
            return t;
        };
        surface = {texel(), texel(), texel()};
        base = constant_map(surface.base);
        gloss = constant_map(surface.gloss);
        glow = constant_map(surface.glow);
        environment = cube_map(random, 8, false);
        batch.bind(TextureSlot::color, base.sampled);
        batch.bind(TextureSlot::gloss, gloss.sampled);
        batch.bind(TextureSlot::emissive, glow.sampled);
        batch.bind(TextureSlot::environment, environment.sampled);
    }
};

// ---- The formulas -------------------------------------------------------------------------------

testing::AssertionResult terms_follow_the_formulas(const Shading& implementation) {
    for (int i = 0; i < 100; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Batch<float> batch = random_points(random, random.below(max_lights + 1));
        const Mapped mapped(random, batch);
        Batch<float> given = batch;
        implementation.run(batch);
        const dvec3 emissive = three(batch.material.emission) + dvec3(mapped.surface.glow);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const Lighting sum = all_lights(given, lane, mapped.surface);
            const bool good = near(batch.vector3(Value::light_ambient, lane), sum.ambient) &&
                              near(batch.vector3(Value::light_diffuse, lane), sum.diffuse) &&
                              near(batch.vector3(Value::light_specular, lane), sum.specular) &&
                              near(batch.vector3(Value::light_emissive, lane), emissive) &&
                              batch.real(Value::opacity, lane) == mapped.surface.base.a;
            if (!good) return testing::AssertionFailure() << "batch " << i << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(ShadeThesis, TermsFollowTheFormulas) {
    EXPECT_TRUE(terms_follow_the_formulas(shading()));
    for (const Planted planted :
         {Planted::as_published, Planted::no_attenuation, Planted::linear_as_quadratic,
          Planted::first_light_only, Planted::visibility_ignored, Planted::ambient_shadowed,
          Planted::highlight_on_dark_side, Planted::opacity_of_white}) {
        EXPECT_FALSE(terms_follow_the_formulas(shading(planted))) << static_cast<int>(planted);
    }
}

/// Without maps: white, opaque, the material's own shininess, and no mirror.
testing::AssertionResult maps_have_defaults(const Shading& implementation) {
    Random random(20);
    Batch<float> batch = random_points(random, 2);
    Surface surface;
    surface.gloss.r = batch.material.shininess / 255;
    Batch<float> given = batch;
    implementation.run(batch);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const Lighting sum = all_lights(given, lane, surface);
        const dvec3 phong =
            three(batch.material.emission) + sum.ambient + sum.diffuse + sum.specular;
        const bool good = near(batch.vector3(Value::light_specular, lane), sum.specular) &&
                          near(batch.vector3(Value::color, lane), phong) &&
                          batch.real(Value::opacity, lane) == 1;
        if (!good) return testing::AssertionFailure() << "lane " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(ShadeThesis, MapsHaveDefaults) {
    EXPECT_TRUE(maps_have_defaults(shading()));
    EXPECT_FALSE(maps_have_defaults(shading(Planted::as_published)));
}

/// Bit for bit.
testing::AssertionResult terms_add_up_to_the_colour(const Shading& implementation) {
    for (int i = 0; i < 50; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Batch<float> batch = random_points(random, 3);
        const Mapped mapped(random, batch);
        implementation.run(batch);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            if (batch.vector3(Value::color, lane) == combine(batch, lane, false, true)) continue;
            return testing::AssertionFailure() << "batch " << i << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(ShadeThesis, TermsAddUpToTheColour) {
    EXPECT_TRUE(terms_add_up_to_the_colour(shading()));
    EXPECT_FALSE(terms_add_up_to_the_colour(shading(Planted::mirror_before_opacity)));
    EXPECT_FALSE(terms_add_up_to_the_colour(shading(Planted::emission_forgotten)));
}

// ---- Lights -------------------------------------------------------------------------------------

/// Turned away from the light, or in its shadow: neither diffuse nor specular.
testing::AssertionResult dark_side_is_dark(const Shading& implementation, bool in_shadow) {
    Random random(21);
    int dark = 0;
    Batch<float> batch = random_points(random, 1, batch_lanes);
    if (in_shadow) {
        each_lane(batch, [&](int lane) { batch.real(Value::shadow_visibility, lane) = 0; });
    }
    implementation.run(batch);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const LightUniforms& light = batch.frame.lights[0];
        const dvec3 P(batch.vector3(Value::hit_P, lane));
        const dvec3 to_light = three(light.position) - (light.directional ? dvec3(0.0) : P);
        if (!in_shadow && dot(dvec3(batch.vector3(Value::N, lane)), to_light) > -1e-5) continue;
        ++dark;
        const auto sum =
            batch.vector3(Value::light_diffuse, lane) + batch.vector3(Value::light_specular, lane);
        if (sum != vec3<float>(0)) return testing::AssertionFailure() << "lane " << lane;
    }
    return dark > 20 ? testing::AssertionSuccess() : testing::AssertionFailure() << dark << " dark";
}

TEST(ShadeThesis, TheUnlitSideHasNoHighlights) {
    EXPECT_TRUE(dark_side_is_dark(shading(), false));
    EXPECT_FALSE(dark_side_is_dark(shading(Planted::highlight_on_dark_side), false));
    EXPECT_FALSE(dark_side_is_dark(shading(Planted::as_published), false));
    EXPECT_TRUE(dark_side_is_dark(shading(), true));
    EXPECT_FALSE(dark_side_is_dark(shading(Planted::visibility_ignored), true));
}

/// Twice as far in the same direction: the part of each coefficient.
testing::AssertionResult fades_by(const Shading& implementation, int coefficient, float factor) {
    Random random(22);
    Batch<float> batch = random_points(random, 1);
    LightUniforms& light = batch.frame.lights[0];
    light.directional = 0;
    light.intensity = 1;
    for (int i = 0; i < 3; ++i) light.attenuation[i] = i == coefficient ? 1.0f : 0.0f;
    each_lane(batch, [&](int lane) { batch.set(Value::hit_P, lane, dvec3(0.5, 0.25, -2)); });
    const dvec3 offset(1, 2, 1.5), from(0.5, 0.25, -2);
    const auto place = [&](double distance) {
        for (int c = 0; c < 3; ++c) {
            light.position[c] = static_cast<float>(from[c] + offset[c] * distance);
        }
    };
    place(2);
    Batch<float> far_away = batch;
    place(1);
    implementation.run(batch);
    implementation.run(far_away);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const auto wanted = batch.vector3(Value::light_diffuse, lane) * factor;
        const auto got = far_away.vector3(Value::light_diffuse, lane);
        if (length(got - wanted) > 1e-5f * length(wanted)) {
            return testing::AssertionFailure() << "lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(ShadeThesis, LightFadesWithTheDistance) {
    EXPECT_TRUE(fades_by(shading(), 0, 1));
    EXPECT_TRUE(fades_by(shading(), 1, 0.5f));
    EXPECT_TRUE(fades_by(shading(), 2, 0.25f));
    EXPECT_FALSE(fades_by(shading(Planted::no_attenuation), 2, 0.25f));
    EXPECT_FALSE(fades_by(shading(Planted::linear_as_quadratic), 2, 0.25f));
}

/// Two lights are the sum of each alone, bit for bit.
testing::AssertionResult lights_add_up(const Shading& implementation) {
    Random random(23);
    Batch<float> both = random_points(random, 2);
    open_sky(both);
    Batch<float> first = both, second = both;
    first.frame.light_count = second.frame.light_count = 1;
    second.frame.lights[0] = both.frame.lights[1];
    for (int lane = 0; lane < both.lanes; ++lane) {
        second.real(Value::shadow_visibility, lane) =
            both.real(Value::shadow_visibility, lane, 0, 1);
    }
    for (Batch<float>* batch : {&both, &first, &second}) implementation.run(*batch);
    for (const Value v : {Value::light_ambient, Value::light_diffuse, Value::light_specular}) {
        for (int lane = 0; lane < both.lanes; ++lane) {
            if (both.vector3(v, lane) == first.vector3(v, lane) + second.vector3(v, lane)) continue;
            return testing::AssertionFailure() << info(v).name << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(ShadeThesis, LightsAddUp) {
    EXPECT_TRUE(lights_add_up(shading()));
    EXPECT_FALSE(lights_add_up(shading(Planted::first_light_only)));
}

// ---- Environment --------------------------------------------------------------------------------

/// eta 1.9: where k < 0 the refraction shows the reflection, elsewhere its own direction.
testing::AssertionResult total_reflection_mirrors(const Shading& implementation) {
    Random random(24);
    Batch<float> batch = random_points(random, 0, batch_lanes);
    const Map environment = cube_map(random, 8, false);
    const Map gloss = constant_map({0, 0.95f, 0, 1});
    batch.bind(TextureSlot::environment, environment.sampled);
    batch.bind(TextureSlot::gloss, gloss.sampled);
    implementation.run(batch);
    int total = 0;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const dvec3 V = normalize(-dvec3(batch.vector3(Value::P, lane)));
        const double cosine = dot(V, dvec3(batch.vector3(Value::N, lane)));
        const double k = 1 - 1.9 * 1.9 * (1 - cosine * cosine);
        if (std::abs(k) < 1e-4) continue;
        total += k < 0;
        const bool same = batch.vector3(Value::light_refraction, lane) ==
                          batch.vector3(Value::light_reflection, lane);
        if (same != (k < 0)) return testing::AssertionFailure() << "lane " << lane << ", k " << k;
    }
    return total > 20 ? testing::AssertionSuccess() : testing::AssertionFailure() << total;
}

TEST(ShadeThesis, TotalReflectionShowsTheReflection) {
    EXPECT_TRUE(total_reflection_mirrors(shading()));
    EXPECT_FALSE(total_reflection_mirrors(shading(Planted::black_total_reflection)));
}

/// The same points, seen by a camera that is turned about its place: world = M * eye space.
testing::AssertionResult environment_keeps_still(const Shading& implementation) {
    Random random(25);
    Batch<float> straight = random_points(random, 0);
    const Map environment = cube_map(random, 8, false);
    straight.bind(TextureSlot::environment, environment.sampled);
    Batch<float> turned = straight;
    const dvec3 rows[3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}};
    for (int i = 0; i < 9; ++i)
        turned.frame.eye_to_world[i] = static_cast<float>(rows[i / 3][i % 3]);
    for (const Value v : {Value::P, Value::hit_P, Value::N}) {
        each_lane(turned, [&](int lane) {
            const dvec3 world(straight.vector3(v, lane));
            turned.set(v, lane, rows[0] * world.x + rows[1] * world.y + rows[2] * world.z);
        });
    }
    implementation.run(straight);
    implementation.run(turned);
    for (const Value v : {Value::light_reflection, Value::light_refraction}) {
        for (int lane = 0; lane < straight.lanes; ++lane) {
            const auto difference = straight.vector3(v, lane) - turned.vector3(v, lane);
            if (length(difference) < 1e-3f) continue;
            return testing::AssertionFailure() << info(v).name << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(ShadeThesis, TheEnvironmentKeepsStill) {
    EXPECT_TRUE(environment_keeps_still(shading()));
    EXPECT_FALSE(environment_keeps_still(shading(Planted::environment_turns)));
    EXPECT_FALSE(environment_keeps_still(shading(Planted::as_published)));
}

/// A white surface under white ambient light in a white environment is white, whatever its gloss
/// and opacity.
testing::AssertionResult white_stays_white(const Shading& implementation) {
    for (int i = 0; i < 50; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Batch<float> batch = random_points(random, 1);
        const Map environment = cube_map(random, 4, true);
        const auto part = [&] { return static_cast<float>(random.uniform(0, 1)); };
        const Map gloss = constant_map({part(), part(), part(), 1});
        const Map base = constant_map({1, 1, 1, part()});
        batch.bind(TextureSlot::environment, environment.sampled);
        batch.bind(TextureSlot::gloss, gloss.sampled);
        batch.bind(TextureSlot::color, base.sampled);
        batch.frame.lights[0].intensity = 0;
        std::fill_n(batch.frame.lights[0].ambient, 3, 1.0f);
        std::fill_n(batch.material.ambient, 3, 1.0f);
        std::fill_n(batch.material.emission, 3, 0.0f);
        open_sky(batch);
        implementation.run(batch);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const auto off = abs(batch.vector3(Value::color, lane) - vec3<float>(1));
            if (max(max(off.x, off.y), off.z) > 0x1p-22f) {
                return testing::AssertionFailure() << "off by " << off.x << " in lane " << lane;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(ShadeThesis, WhiteStaysWhite) {
    EXPECT_TRUE(white_stays_white(shading()));
    EXPECT_FALSE(white_stays_white(shading(Planted::as_published)));
}

}  // namespace
}  // namespace quadrel::test
