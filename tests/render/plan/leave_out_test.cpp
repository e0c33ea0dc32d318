// Steps of searches that no height can meet are left out, and no bit shows it; rays of shadow that
// no light needs, lights that no output needs and objects out of view cost nothing.
#include <random>

#include "built_isas.hpp"
#include "kernels/select.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/heights.hpp"
#include "quadrel/stats.hpp"
#include "render/films.hpp"
#include "render/plan/height_bounds.hpp"
#include "render/plan/prepared.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

/// A change to what the plan tells the stages, for planted errors.
using Damage = std::function<void(MaterialUniforms&)>;

Renderer render_with_bounds(const Damage& damage) {
    return [damage](const Scene& scene, const RenderOptions& options) {
        PreparedRender prepared =
            prepare_render(scene, options, select_kernels(options.number, options.isa));
        for (MaterialUniforms& uniforms : prepared.plan.uniforms) damage(uniforms);
        return draw(prepared, options);
    };
}

/// A relief under two lights. `height(x, y)` gives its map.
template <class Height>
Scene relief_scene(const std::string& name, const Height& height) {
    Scene scene = empty_scene(18, 12);
    set_perspective_camera(scene, {0.4, 0.5, 2.5}, {.near = 0.5, .far = 50});
    scene.lights = {directional_light({1, 0.4f, 0.3f}), directional_light({-0.5f, 1, 1})};
    scene.materials = {relief_material("relief", false)};
    scene.materials[0].textures["height"] =
        texture(write_texture(name, 8, [&](int x, int y, int) { return height(x, y); }), "r");
    add_object(scene, make_quad(3), 0, rotation(-50, {1, 0, 0}));
    return scene;
}

testing::AssertionResult leaves_no_trace(const Renderer& renderer, const Scene& scene,
                                         const std::string& isa, const std::string& number) {
    RenderOptions options;
    options.channels = channels_without_counts(scene);
    options.isa = isa;
    options.number = number;
    const Film found = renderer(scene, options);
    options.skip = false;
    return same_bits(render(scene, options), found);
}

void choose_settings(Scene& scene, std::mt19937& random) {
    Material& material = scene.materials[0];
    material.trace.parameters["steps"] = 1 + random() % 150;
    material.shadow.parameters["steps"] = 1 + random() % 60;
    material.seat = static_cast<float>(random() % 5) / 4;
    SamplerState& sampler = material.textures["height"].sampler;
    sampler.wrap_u = static_cast<Wrap>(random() % 5);
    sampler.wrap_v = static_cast<Wrap>(random() % 5);
    sampler.mag = random() % 3 ? Filter::linear : Filter::nearest;
    sampler.min = random() % 3 ? Filter::linear : Filter::nearest;
    sampler.mip = static_cast<MipFilter>(random() % 3);
    sampler.border[0] = static_cast<float>(random() % 3) / 2;
    sampler.weight_bits = random() % 2 ? 8 : 0;
}

/// Heights on, beside and far from the steps of a march, and outside of the relief.
float flat_height(int i, int steps, std::mt19937& random) {
    const float on_step =
        1 - static_cast<float>(random() % (unsigned(steps) + 1)) / static_cast<float>(steps);
    switch (i % 6) {
        case 0:
            return on_step;
        case 1:
            return std::nextafterf(on_step, 2);
        case 2:
            return std::nextafterf(on_step, -1);
        case 3:
            return static_cast<float>(random() % 4) - 1;
        default:
            return static_cast<float>(random() % 1000) / 999;
    }
}

testing::AssertionResult flat_maps_leave_no_trace(const Renderer& renderer) {
    std::mt19937 random(3);
    const std::vector<std::string> isas = built_isas();
    for (int i = 0; i < 36; ++i) {
        Scene scene = relief_scene("unused.exr", [](int, int) { return 0; });
        choose_settings(scene, random);
        const int steps = static_cast<int>(*scene.materials[0].trace.parameters["steps"].number());
        const float height = flat_height(i, steps, random);
        TextureReference& map = scene.materials[0].textures["height"];
        map.file = write_texture("flat" + std::to_string(i) + ".exr", 8,
                                 [&](int, int, int) { return height; });
        if (i % 4 != 0) map.sampler.border[0] = height;
        const bool wide = i % 5 == 4;
        if (auto same =
                leaves_no_trace(renderer, scene, wide ? "scalar" : isas[unsigned(i) % isas.size()],
                                wide ? "double" : "float");
            !same)
            return same << ", height " << height << ", " << steps << " steps";
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult low_maps_leave_no_trace(const Renderer& renderer) {
    std::mt19937 random(4);
    const std::vector<std::string> isas = built_isas();
    for (int i = 0; i < 24; ++i) {
        const double low = -0.2 + 0.1 * (i % 5), range = 0.1 * (1 + i % 4);
        Scene scene = relief_scene("low" + std::to_string(i % 20) + ".exr",
                                   [&](int x, int y) { return low + range * noise(x, y, 1); });
        choose_settings(scene, random);
        const bool wide = i % 5 == 4;
        if (auto same =
                leaves_no_trace(renderer, scene, wide ? "scalar" : isas[unsigned(i) % isas.size()],
                                wide ? "double" : "float");
            !same)
            return same << ", heights from " << low << " to " << low + range;
    }
    return testing::AssertionSuccess();
}

struct Search {
    const char *trace, *parameter;
    const char* shadow;
};

/// Rows that go by bounds of parts of the map, over maps with high and low places and levels.
testing::AssertionResult searches_by_parts_leave_no_trace(const Renderer& renderer) {
    constexpr Search searches[] = {
        {"linear", "steps", "shadow-march-thesis"}, {"relief-binary", "steps", "shadow-relief"},
        {"steep", "steps", "shadow-soft-riccardi"}, {"pom", "steps_grazing", "shadow-march-thesis"},
        {"secant", "steps", "shadow-relief"},       {"contact", "steps", "shadow-soft-riccardi"},
    };
    std::mt19937 random(5);
    const std::vector<std::string> isas = built_isas();
    for (unsigned i = 0; i < 24; ++i) {
        const Search& search = searches[i % std::size(searches)];
        Scene scene = relief_scene("parts" + std::to_string(i % 5) + ".exr", [&](int x, int y) {
            return (x + 3 * y) % 8 == 0 ? 1 : 0.4 * noise(x, y, 1 + int(i % 5));
        });
        choose_settings(scene, random);
        Material& material = scene.materials[0];
        material.trace.id = search.trace;
        material.trace.parameters.clear();
        material.trace.parameters[search.parameter] = 100 + random() % 200;
        material.shadow.id = search.shadow;
        material.shadow.parameters["steps"] = 100 + random() % 100;
        const bool wide = i % 5 == 4;
        if (auto same = leaves_no_trace(renderer, scene, wide ? "scalar" : isas[i % isas.size()],
                                        wide ? "double" : "float");
            !same)
            return same << ", " << search.trace << " and " << search.shadow;
    }
    return testing::AssertionSuccess();
}

TEST(LeaveOut, SearchesByPartsOfTheMap) {
    EXPECT_TRUE(searches_by_parts_leave_no_trace(render));
    static HeightMaxima shifted;
    EXPECT_FALSE(searches_by_parts_leave_no_trace(render_with_bounds([](MaterialUniforms& m) {
        if (m.maxima == nullptr) return;
        shifted = *m.maxima;
        for (LevelMaxima& level : shifted.level) level.first_y += 3;
        m.maxima = &shifted;
    })));
}

TEST(LeaveOut, FlatMaps) { EXPECT_TRUE(flat_maps_leave_no_trace(render)); }
TEST(LeaveOut, LowMaps) { EXPECT_TRUE(low_maps_leave_no_trace(render)); }

TEST(LeaveOut, PlantedErrorsAreCaught) {
    const auto flat = [](const Damage& damage) {
        return flat_maps_leave_no_trace(render_with_bounds(damage));
    };
    // One step more or less, where the height lies on a step.
    EXPECT_FALSE(flat([](MaterialUniforms& m) {
        if (m.height_low == m.height_high)
            m.height_low = m.height_high = std::nextafterf(m.height_high, -2);
    }));
    EXPECT_FALSE(flat([](MaterialUniforms& m) {
        if (m.height_low == m.height_high)
            m.height_low = m.height_high = std::nextafterf(m.height_high, 2);
    }));
    EXPECT_FALSE(low_maps_leave_no_trace(
        render_with_bounds([](MaterialUniforms& m) { m.height_high -= 0.05f; })));
    EXPECT_FALSE(low_maps_leave_no_trace(
        render_with_bounds([](MaterialUniforms& m) { m.height_low = m.height_high; })));
}

/// The closed form against the march's own comparisons, one by one.
template <class T>
testing::AssertionResult is_first_step(int (*first)(T, int)) {
    std::mt19937 random(9);
    for (int i = 0; i < 20000; ++i) {
        const int n = 1 + static_cast<int>(random() % (i % 50 == 0 ? 65536 : 300));
        T h = static_cast<T>(random() % 4096) / 4095;
        if (i % 3 == 1) h = 1 - static_cast<T>(random() % unsigned(n + 1)) / static_cast<T>(n);
        if (i % 6 == 1) h = std::nextafter(h, T(2));
        if (i % 9 == 2) h = static_cast<T>(static_cast<int>(random() % 9) - 4) * T(1e9);
        int expected = 0;
        while (expected <= n && !(h >= 1 - static_cast<T>(expected) / static_cast<T>(n)))
            ++expected;
        if (first(h, n) != expected)
            return testing::AssertionFailure()
                   << h << " of " << n << ": " << first(h, n) << ", step by step " << expected;
    }
    return testing::AssertionSuccess();
}

TEST(LeaveOut, FirstStepIsThatOfTheMarch) {
    EXPECT_TRUE(is_first_step<float>(first_step_below<float>));
    EXPECT_TRUE(is_first_step<double>(first_step_below<double>));
    EXPECT_FALSE(
        is_first_step<float>([](float h, int n) { return to_int(std::ceil(float(n) * (1 - h))); }));
}

TEST(LeaveOut, BoundsHoldAllThatSamplersGive) {
    const auto range = [](float low, float high, const std::function<void(SamplerState&)>& change) {
        const Scene scene =
            relief_scene(fmt::format("range{}_{}.exr", low, high),
                         [&](int x, int y) { return x == 3 && y == 5 ? high : low; });
        const TextureReference& map = scene.materials[0].textures.at("height");
        TextureOptions options;
        options.swizzle = "r";
        const auto owned = make_texture(load_image(map.file, NotFinite::count), options);
        SampledTexture sampled{owned->view(), map.sampler};
        change(sampled.sampler);
        return height_range(sampled);
    };
    const auto unchanged = [](SamplerState&) {};
    const auto to_border = [](SamplerState& s) {
        s.wrap_v = Wrap::clamp_to_border;
        s.border[0] = 0.75f;
    };
    EXPECT_EQ(range(0.5f, 0.5f, unchanged)->low, 0.5f);
    EXPECT_EQ(range(0.5f, 0.5f, unchanged)->high, 0.5f);
    EXPECT_GE(range(0.5f, 0.5f, to_border)->high, 0.75f);
    EXPECT_LT(range(0.25f, 0.75f, unchanged)->low, 0.25f);
    EXPECT_GT(range(0.25f, 0.75f, unchanged)->high, 0.75f);
    const auto zeros = range(0.0f, -0.0f, unchanged);
    EXPECT_TRUE(zeros && zeros->low < zeros->high);
    EXPECT_FALSE(range(-3e38f, 3.4028234e38f, unchanged).has_value());
    EXPECT_FALSE(range(0.5f, std::nanf(""), unchanged).has_value());
    EXPECT_FALSE(range(INFINITY, INFINITY, unchanged).has_value());
}

RenderStats stats_of(const Scene& scene, const std::vector<std::string>& channels,
                     bool skip = true) {
    RenderStats stats;
    RenderOptions options;
    options.channels = channels;
    options.skip = skip;
    options.stats = &stats;
    options.touched = true;
    render(scene, options);
    return stats;
}

bool says(const RenderStats& stats, const std::string& words) {
    return std::any_of(stats.left_out.begin(), stats.left_out.end(), [&](const std::string& line) {
        return line.find(words) != std::string::npos;
    });
}

/// A flat map costs no look-up at all until someone asks how many there are.
TEST(LeaveOut, FlatMapsAreNotSearched) {
    const Scene scene = relief_scene("flat.exr", [](int, int) { return 0.375; });
    const RenderStats cheap = stats_of(scene, {"hit.s", "shadow.visibility"});
    EXPECT_EQ(cheap.fetches.fetches, 0u);
    EXPECT_EQ(cheap.touched.texels, 0u);
    EXPECT_TRUE(says(cheap, "flat, 0.375"));
    const RenderStats counted = stats_of(scene, {"hit.s", "hit.steps", "shadow.visibility"});
    EXPECT_GT(counted.trace_steps, 0u);
    EXPECT_FALSE(says(counted, "flat"));
    const Scene low = relief_scene("low.exr", [](int x, int y) { return 0.3 * noise(x, y, 2); });
    const RenderStats fewer = stats_of(low, {"hit.s"}), all = stats_of(low, {"hit.s"}, false);
    EXPECT_LT(fewer.trace_steps, all.trace_steps);
    EXPECT_TRUE(says(fewer, "above height 0.2"));
}

/// Of the relief's two lights, one stands behind the surface.
TEST(LeaveOut, LightsBehindTheSurfaceCastNoRays) {
    Scene scene = relief_scene("lit.exr", [](int x, int y) { return noise(x, y, 3); });
    scene.lights = {directional_light({0, -1, -1}), directional_light({0.3f, 1, 1})};
    const auto dark = stats_of(scene, {"shadow.0.visibility", "shadow.0.steps"});
    const auto lit = stats_of(scene, {"shadow.1.visibility", "shadow.1.steps"});
    EXPECT_EQ(dark.shadow_steps, 0u);
    EXPECT_GT(lit.shadow_steps, 0u);
    EXPECT_LT(dark.fetches.fetches, lit.fetches.fetches);
}

/// Shadows are computed for the lights that a channel names, and for all once something is shaded.
TEST(LeaveOut, LightsThatNoOutputNeeds) {
    const Scene scene = relief_scene("lit.exr", [](int x, int y) { return noise(x, y, 3); });
    const auto batches = [&](const std::vector<std::string>& channels) {
        const RenderStats stats = stats_of(scene, channels);
        const auto find = [&](const char* id) {
            const auto stage = std::find_if(stats.stages.begin(), stats.stages.end(),
                                            [&](const StageStats& s) { return s.id == id; });
            return stage == stats.stages.end() ? 0 : stage->batches;
        };
        return find("shadow-march-thesis") / std::max<std::uint64_t>(1, find("interpolate"));
    };
    EXPECT_EQ(batches({"uv"}), 0u);
    EXPECT_EQ(batches({"shadow.1.visibility"}), 1u);
    EXPECT_EQ(batches({"shadow.0.visibility", "shadow.1.visibility"}), 2u);
    EXPECT_EQ(batches({"R"}), 2u);
    EXPECT_TRUE(says(stats_of(scene, {"shadow.1.visibility"}), "(light 0)"));
}

/// Objects that are hidden, beside the frame, behind the eye or outside of the window open no file.
TEST(LeaveOut, WhatIsOutOfViewIsNotLoaded) {
    Scene scene = relief_scene("lit.exr", [](int x, int y) { return noise(x, y, 3); });
    scene.materials.push_back(relief_material("missing", false));
    for (auto& [slot, reference] : scene.materials[1].textures)
        reference.file = texture_folder() / "missing.exr";
    add_object(scene, make_quad(0.5), 1);
    EXPECT_THROW(take(render, scene), InputError);
    Object& object = scene.objects.back();
    object.visible = false;
    EXPECT_NO_THROW(take(render, scene));
    object.visible = true;
    for (const glm::dvec3& place : {glm::dvec3(50, 0, 0), glm::dvec3(0, 0, 40)}) {
        object.transform = glm::mat4(translation(place));
        EXPECT_NO_THROW(take(render, scene));
    }
    object.transform = glm::mat4(1.0f);
    RenderOptions options;
    options.window = Window{0, 0, 2, 2};
    EXPECT_NO_THROW(render(scene, options));
}

}  // namespace
}  // namespace quadrel::render_tests
