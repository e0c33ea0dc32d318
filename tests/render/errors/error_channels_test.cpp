// err.*: what is drawn against the exact frame and the proven first hit.
#include "effort.hpp"
#include "quadrel/scene/load.hpp"
#include "render/errors/judged_scenes.hpp"
#include "render/hash_file.hpp"
#include "render/plan/prepared.hpp"

namespace quadrel::render_tests {
namespace {

/// Channels of one part, "err." or "err.search." or "err.frame.".
std::vector<std::string> of_part(const std::string& prefix) {
    std::vector<std::string> names;
    for (const char* name :
         {"s", "uv", "cell", "kind", "normal", "shadow", "color.R", "color.G", "color.B"})
        names.push_back(prefix + name);
    return names;
}

testing::AssertionResult are_zero(const Film& film, const std::string& prefix) {
    return everywhere(film, covered(film), [&](int x, int y) -> std::string {
        for (const std::string& name : of_part(prefix))
            if ((bits(film, name, x, y) & 0x7fffffffu) != 0)
                return name + " is " + std::to_string(value(film, name, x, y));
        return "";
    });
}

testing::AssertionResult judge_has_no_error(const Renderer& renderer) {
    for (const char* number : {"float", "double"}) {
        RenderOptions options;
        options.number = number;
        Scene scene = judged_scene("oracle-bilinear");
        scene.materials[0].shadow = stage("shadow-oracle", "materials.relief.relief.shadow");
        const Film film = errors_of(renderer, scene, options);
        for (const char* prefix : {"err.", "err.search.", "err.frame."})
            if (const auto zero = are_zero(film, prefix); !zero) return zero;
        const auto proven = everywhere(film, covered(film), [&](int x, int y) -> std::string {
            return bits(film, "err.certified", x, y) == 0 ? "not certified" : "";
        });
        if (!proven) return proven;
    }
    return testing::AssertionSuccess();
}

/// render() of the scene with another trace.
Renderer with_trace(const std::string& trace) {
    return [=](Scene scene, const RenderOptions& options) {
        scene.materials[0].trace.id = trace;
        return render(scene, options);
    };
}

TEST(ErrorChannels, TheJudgeHasNone) {
    EXPECT_TRUE(judge_has_no_error(render));
    EXPECT_FALSE(judge_has_no_error(with_trace("linear")));
    for (const std::string& name : of_part("err."))
        EXPECT_FALSE(judge_has_no_error(changed([&](Film& film) {
            for (std::uint32_t& bits : film.find(name)->bits) bits = 1;
        }))) << name;
}

/// Other surfaces have judges of their own.
TEST(ErrorChannels, BlocksAreJudgedAsBlocks) {
    for (const char* trace : {"qdm", "oracle-block", "oracle-tri-min"}) {
        const Film film = errors_of(render, judged_scene(trace));
        EXPECT_TRUE(everywhere(film, covered(film), [&](int x, int y) {
            return kind_at(film, x, y) == ErrorKind::same ? "" : "another hit";
        })) << trace;
    }
    RenderOptions options;
    options.channels = {"err.s"};
    const auto judges = render_attributes(judged_scene("qdm"), options);
    EXPECT_EQ(std::ranges::count(
                  judges, std::pair<std::string, std::string>{"quadrel:judges",
                                                              "relief: frame-face, oracle-block"}),
              1);
}

constexpr int linear_steps = 20;

/// Equal steps over a smooth field end behind it, by no more than a step.
testing::AssertionResult linear_is_late_by_a_step(const Renderer& renderer) {
    Scene scene = judged_scene("linear");
    scene.materials[0].trace.parameters["steps"] = linear_steps;
    const Film film = errors_of(renderer, scene, {}, {"K"});
    int late = 0;
    const auto found = everywhere(film, covered(film), [&](int x, int y) -> std::string {
        const double s = value(film, "err.s", x, y), step = 1.0 / linear_steps;
        const vec2<double> K(value(film, "K.U", x, y), value(film, "K.V", x, y));
        const ErrorKind kind = kind_at(film, x, y);
        late += kind == ErrorKind::late;
        if (kind != ErrorKind::late && kind != ErrorKind::same) return error_kind_name(kind);
        if (kind == ErrorKind::late ? s < 1e-5 : s > 3e-4) return "late is not late";
        if (!(s > -1e-5 && s < step + 1e-5)) return "s is " + std::to_string(s);
        const double texels = std::sqrt(dot(K, K)) * s * map_size;
        return differs("uv", value(film, "err.uv", x, y), std::abs(texels), 1e-3);
    });
    if (!found) return found;
    if (late < 100) return testing::AssertionFailure() << late << " late ones";
    return testing::AssertionSuccess();
}

TEST(ErrorChannels, LinearIsLateByAStepAtMost) {
    EXPECT_TRUE(linear_is_late_by_a_step(render));
    EXPECT_FALSE(linear_is_late_by_a_step(
        changed([](Film& film) { change_plane(film, "err.s", [](float s) { return -s; }); })));
    EXPECT_FALSE(linear_is_late_by_a_step(changed(
        [](Film& film) { change_plane(film, "err.uv", [](float uv) { return uv / map_size; }); })));
    EXPECT_FALSE(linear_is_late_by_a_step([](Scene scene, const RenderOptions& options) {
        scene.materials[0].trace.parameters["steps"] = linear_steps / 2;
        return render(scene, options);
    }));
}

/// Steps wider than a fence: what a ray passes through is no late hit.
testing::AssertionResult passing_through_is_told(const Renderer& renderer) {
    Scene scene = judged_scene("linear", fences());
    scene.materials[0].trace.parameters["steps"] = 4;
    scene.materials[0].depth = 1.5f;
    const Film film = errors_of(renderer, scene, {}, {"hit", "oracle"});
    int passed = 0;
    const auto found = everywhere(film, covered(film), [&](int x, int y) -> std::string {
        // A fence is two texels wide: behind it by more, the ray has come out.
        const double texels =
            std::abs(value(film, "hit.U", x, y) - value(film, "oracle.U", x, y)) * map_size;
        const bool behind =
            value(film, "oracle.s", x, y) < 0.6 && value(film, "hit.s", x, y) > 0.7 && texels > 2.1;
        passed += behind;
        if (behind && kind_at(film, x, y) != ErrorKind::other_surface) return "not told";
        return "";
    });
    if (!found) return found;
    if (passed < 5) return testing::AssertionFailure() << passed << " passed through";
    return testing::AssertionSuccess();
}

TEST(ErrorChannels, PassingThroughIsTold) {
    EXPECT_TRUE(passing_through_is_told(render));
    EXPECT_FALSE(passing_through_is_told(changed([](Film& film) {
        for (std::uint32_t& kind : film.find("err.kind")->bits)
            if (kind == static_cast<std::uint32_t>(ErrorKind::other_surface))
                kind = static_cast<std::uint32_t>(ErrorKind::late);
    })));
}

/// On the exact frame the whole error is the search's; under the judge's search the frame's.
testing::AssertionResult parts_are_told_apart(const Renderer& renderer) {
    const auto equal = [](const Film& film, const std::string& other) {
        for (const std::string& name : of_part("err."))
            if (film.find(name)->bits != film.find(other + name.substr(4))->bits)
                return testing::AssertionFailure() << name << " and " << other;
        return testing::AssertionSuccess();
    };
    const Film search = errors_of(renderer, judged_scene("linear"));
    Scene scene = judged_scene("oracle-bilinear", hills(), "frame-thesis");
    scene.materials[0].shadow = stage("shadow-oracle", "materials.relief.relief.shadow");
    const Film frame = errors_of(renderer, scene);
    if (const auto result = equal(search, "err.search."); !result) return result;
    if (const auto result = equal(frame, "err.frame."); !result) return result;
    if (const auto zero = are_zero(frame, "err.search."); !zero) return zero;
    // The frame judges the search's shadows by the judge's: its own are none.
    for (const char* name : {"err.frame.s", "err.frame.uv", "err.frame.K"})
        for (std::size_t i = 0; i < search.window.area(); ++i)
            if (search.find(name)->as_float(i) != 0)
                return testing::AssertionFailure() << name << " of the exact frame";
    return testing::AssertionSuccess();
}

TEST(ErrorChannels, FrameAndSearchAreToldApart) {
    EXPECT_TRUE(parts_are_told_apart(render));
    EXPECT_FALSE(parts_are_told_apart(changed([](Film& film) {
        std::swap(film.find("err.search.uv")->bits, film.find("err.frame.uv")->bits);
    })));
}

/// Whatever draws them.
TEST(ErrorChannels, HaveTheSameBitsInEveryRun) {
    Scene scene = judged_scene("linear", hills(), "frame-gram", 37);
    for (const int samples : {1, 4}) {
        scene.samples = samples;
        RenderOptions plain, other;
        plain.isa = "scalar";
        plain.threads = 1;
        other.threads = 3;
        other.tile = 8;
        const Film expected = errors_of(render, scene, plain);
        EXPECT_TRUE(same_bits(expected, errors_of(render, scene, other)));
        other.skip = false;
        EXPECT_TRUE(same_bits(expected, errors_of(render, scene, other)));
        other.window = Window{5, 3, 30, 28};
        Film part = expected;
        crop(part, *other.window);
        EXPECT_TRUE(same_bits(part, errors_of(render, scene, other)));
        // One channel alone is the same, too.
        for (const std::string& name : error_channels())
            EXPECT_TRUE(same_bits(with_planes(expected, {name}), take(render, scene, {name})))
                << name;
    }
}

TEST(ErrorChannels, FloatAndDoubleAgree) {
    Scene scene = judged_scene("linear", hills(), "frame-gram");
    RenderOptions wide;
    wide.number = "double";
    const Film film = errors_of(render, scene), precise = errors_of(render, scene, wide);
    int apart = 0;
    EXPECT_TRUE(everywhere(film, covered(film), [&](int x, int y) -> std::string {
        // A step that only one of them takes is a step apart.
        apart += std::abs(value(film, "err.uv", x, y) - value(precise, "err.uv", x, y)) > 1e-2f;
        return "";
    }));
    EXPECT_LE(apart, 5);
}

TEST(ErrorChannels, WithoutATruthThereIsNone) {
    Scene scene = judged_scene("linear");
    Material noise = scene.materials[0], plain = plain_material("plain");
    noise.textures.erase("height");
    noise.noise = NoiseHeights{4, 2};
    noise.surface.id = "h2n-patch";
    for (const Material& material : {noise, plain}) {
        scene.materials[0] = material;
        const Film film = errors_of(render, scene);
        EXPECT_TRUE(everywhere(film, covered(film), [&](int x, int y) -> std::string {
            if (kind_at(film, x, y) != ErrorKind::not_judged) return "judged";
            return std::isnan(value(film, "err.uv", x, y)) ? "" : "a number";
        })) << material.name;
    }
}

/// Asking for errors changes nothing else, and no one pays who does not ask.
TEST(ErrorChannels, CostNothingUnlessAskedFor) {
    const Scene scene = judged_scene("linear", hills(), "frame-gram");
    const auto names = all_channels(scene);
    std::vector<std::string> more = names;
    more.push_back("err");
    EXPECT_TRUE(same_bits(take(render, scene, names), take(render, scene, more)));
    RenderOptions options;
    const auto runs = [&] {
        int count = 0;
        for (const ErrorPlan& plan :
             plan_render(scene, options, scalar_float_kernels()).plan.errors)
            for (const auto& run : plan.runs) count += run.has_value();
        return count;
    };
    EXPECT_EQ(runs(), 0);
    options.channels = {"hit", "oracle"};
    EXPECT_EQ(runs(), 0);
    options.channels = {"err.uv"};
    EXPECT_EQ(runs(), 1);
    options.channels = {"err.uv", "err.search.s"};
    EXPECT_EQ(runs(), 2);
    options.channels = {"err"};
    EXPECT_EQ(runs(), 3);
}

/// Whatever the scene: a class for every fragment, and no error where it is the same.
TEST(ErrorChannels, EverySceneCanBeJudged) {
    int row = 0;
    for (const std::string& name : installed_scenes()) {
        if (!test::is_tried(row++)) continue;
        const Scene scene = load_scene(name, {size_override("9x8")});
        const Film film = take(render, scene, {"A", "err.kind", "err.uv", "err.s", "err.cell"});
        for (std::size_t i = 0; i < film.window.area(); ++i) {
            if (!(film.find("A")->as_float(i) > 0)) continue;
            const auto kind = static_cast<ErrorKind>(film.find("err.kind")->bits[i]);
            const float uv = film.find("err.uv")->as_float(i);
            ASSERT_LE(kind, ErrorKind::not_judged) << name;
            EXPECT_TRUE(kind != ErrorKind::not_judged || std::isnan(uv)) << name;
            EXPECT_TRUE(kind != ErrorKind::same || uv < 1) << name;
        }
    }
}

}  // namespace
}  // namespace quadrel::render_tests
