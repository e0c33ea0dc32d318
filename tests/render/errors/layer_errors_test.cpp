// err.* of depth layers: what is drawn against the exact search of as many layers.
#include "effort.hpp"
#include "quadrel/texture/of_texels.hpp"
#include "random.hpp"
#include "render/errors/judged_scenes.hpp"
#include "render/errors/layer_truth.hpp"

namespace quadrel::render_tests {
namespace {

/// A plate near the top over one near the bottom, both of a slope; `thin`: the upper one a sheet.
TextureReference plates(bool thin) {
    const auto texel = [thin](int x, int, int c) {
        const double slope = 0.1 * std::sin(x * 6.283185307179586 / map_size);
        const double depths[] = {0.2, thin ? 0.21 : 0.4, 0.7, 0.9};
        return depths[c] + slope;
    };
    return finest_level(texture(write_texture(thin ? "sheet.exr" : "plates.exr", map_size, texel)));
}

Scene judged_layers(const std::string& trace, bool thin = false, int size = 32) {
    Scene scene = judged_scene(trace, hills(), "frame-face", size);
    Material& material = scene.materials[0];
    material.textures.erase("height");
    material.textures["layers"] = plates(thin);
    material.surface = stage("h2n-layers", "materials.relief.relief.surface");
    material.shadow = stage("shadow-layers-exact", "materials.relief.relief.shadow");
    return scene;
}

std::vector<std::string> errors_of_parts() {
    std::vector<std::string> names;
    for (const char* part : {"err.", "err.search.", "err.frame."})
        for (const char* name :
             {"s", "uv", "cell", "kind", "normal", "shadow", "color.R", "color.G", "color.B"})
            names.push_back(std::string(part) + name);
    return names;
}

testing::AssertionResult has_no_errors(const Renderer& renderer, const std::string& judge) {
    for (const char* number : {"float", "double"}) {
        RenderOptions options;
        options.number = number;
        const Film film = errors_of(renderer, judged_layers(judge), options);
        int seen = 0;
        const auto zero = everywhere(film, covered(film), [&](int x, int y) -> std::string {
            ++seen;
            for (const std::string& name : errors_of_parts())
                if ((bits(film, name, x, y) & 0x7fffffffu) != 0) return name;
            return bits(film, "err.certified", x, y) == 0 ? "" : "proven by no one";
        });
        if (!zero) return zero;
        if (seen < 200) return testing::AssertionFailure() << seen << " pixels";
    }
    return testing::AssertionSuccess();
}

/// How many hits have a normal that looks away from the eye, and how many there are.
std::pair<int, int> hits_seen_from_behind(const std::string& trace, int size) {
    const Scene scene =
        load_scene("rows/dual-depth", {fmt::format("size=[{},{}]", size, size),
                                       fmt::format("material.relief.trace=\"{}\"", trace)});
    RenderOptions options;
    options.channels = {"P", "N", "hit.status"};
    const Film film = render(scene, options);
    int behind = 0, hits = 0;
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        if (film.find("hit.status")->bits[i] != static_cast<std::uint32_t>(Status::hit)) continue;
        double facing = 0;
        for (const char* axis : {"X", "Y", "Z"})
            facing -= double(film.find(std::string("P.") + axis)->as_float(i)) *
                      film.find(std::string("N.") + axis)->as_float(i);
        ++hits;
        behind += facing < 0;
    }
    return {behind, hits};
}

/// A march reads levels by which thin solids lie elsewhere than on level 0: of the front and the
/// back beside a hit the one is met that faces the ray.
TEST(LayerErrors, TheSideThatFacesTheRayIsMet) {
    for (const char* trace : {"dual-depth", "dual-depth-exact"}) {
        const auto [behind, hits] = hits_seen_from_behind(trace, 64);
        EXPECT_GT(hits, 1000) << trace;
        EXPECT_LT(behind, hits / 50) << trace << ": " << behind << " of " << hits;
    }
}

TEST(LayerErrors, ExactSearchesHaveNone) {
    for (const char* judge : {"dual-depth-exact", "multilayer-exact"}) {
        EXPECT_TRUE(has_no_errors(render, judge)) << judge;
        EXPECT_FALSE(has_no_errors(
            [](Scene scene, const RenderOptions& options) {
                scene.materials[0].trace.id = "multilayer";
                return render(scene, options);
            },
            judge));
    }
}

constexpr int layer_steps = 20;

/// Steps that are shorter than what they look for end in it, late by one at most.
testing::AssertionResult is_late_by_a_step(const Renderer& renderer, const std::string& trace) {
    Scene scene = judged_layers(trace);
    scene.materials[0].trace.parameters = {{"steps", layer_steps}, {"binary_steps", 0}};
    const Film film = errors_of(renderer, scene);
    int late = 0;
    const auto found = everywhere(film, covered(film), [&](int x, int y) -> std::string {
        const double s = value(film, "err.s", x, y);
        const ErrorKind kind = kind_at(film, x, y);
        late += kind == ErrorKind::late;
        if (kind != ErrorKind::late && kind != ErrorKind::same) return error_kind_name(kind);
        return s > -1e-5 && s < 1.0 / layer_steps + 1e-5 ? "" : "s is " + std::to_string(s);
    });
    if (!found) return found;
    return late > 150 ? testing::AssertionSuccess() : testing::AssertionFailure() << late;
}

TEST(LayerErrors, MarchesAreLateByAStep) {
    for (const char* trace : {"dual-depth", "multilayer"}) {
        EXPECT_TRUE(is_late_by_a_step(render, trace)) << trace;
        EXPECT_FALSE(is_late_by_a_step(
            [](Scene scene, const RenderOptions& options) {
                scene.materials[0].trace.parameters["steps"] = layer_steps / 2;
                return render(scene, options);
            },
            trace));
    }
}

/// Behind a sheet that it has passed through, a march meets another surface, or none.
TEST(LayerErrors, PassedSheetsAreTold) {
    Scene scene = judged_layers("multilayer", true);
    scene.materials[0].trace.parameters = {{"steps", layer_steps}};
    const Film film = errors_of(render, scene, {}, {"hit.s"});
    int passed = 0;
    EXPECT_TRUE(everywhere(film, covered(film), [&](int x, int y) -> std::string {
        const bool behind = value(film, "hit.s", x, y) > 0.5f;
        passed += behind;
        const ErrorKind kind = kind_at(film, x, y);
        return behind == (kind == ErrorKind::other_surface) ? "" : error_kind_name(kind);
    }));
    EXPECT_GT(passed, 100);
}

/// Where one of the sheet's rays finds nothing, its fragment is not there: counted by objects.
TEST(LayerErrors, HolesAreCounted) {
    const auto holes = [](const std::string& trace) {
        Scene scene = judged_layers(trace, true);
        const ErrorSummary summary = measure_errors(scene);
        EXPECT_NE(to_text(summary).find("show another object"), std::string::npos);
        return summary.other_object.value_or(99999);
    };
    EXPECT_EQ(holes("dual-depth-exact"), 0);
    EXPECT_GT(holes("dual-depth"), 100);
    EXPECT_FALSE(measure_errors(judged_scene("linear")).other_object.has_value());
}

/// What stops behind the sheet, where the judge's rays go on to what is behind it or meet nothing.
TEST(LayerErrors, ThePublishedSearchInventsHits) {
    Scene scene = judged_layers("dual-depth@published", true);
    scene.materials[0].textures["layers"].swizzle = "rggr";
    scene.materials[0].trace.parameters["scale"] = 0.125;
    const ErrorSummary summary = measure_errors(scene);
    EXPECT_NE(summary.judges.find("dual-depth-exact"), std::string::npos) << summary.judges;
    EXPECT_EQ(summary.judged, summary.covered);
    EXPECT_LT(summary.parts[0].share(ErrorKind::same), 0.9);
}

// ---- Whether a ray comes out --------------------------------------------------------------------

/// By samples, of which a thousandth of the depth has ten or more.
bool leaves_by_samples(const SampledTexture& map, const oracle::Ray& ray, double from, double to) {
    constexpr int samples = 4000;
    const TextureView& view = map.view;
    const auto depth = [&](double u, double v, int layer) {
        const double x = u * view.width[0] - 0.5, y = v * view.height[0] - 0.5;
        const double i = std::floor(x), j = std::floor(y), f = x - i, g = y - j;
        const auto texel = [&](double column, double row) {
            const auto wrapped = [](double a, int n) {
                return static_cast<int>(a - std::floor(a / n) * n);
            };
            return double(view.texels[(wrapped(row, view.height[0]) * view.width[0] +
                                       wrapped(column, view.width[0])) *
                                          4 +
                                      layer]);
        };
        return (texel(i, j) * (1 - f) + texel(i + 1, j) * f) * (1 - g) +
               (texel(i, j + 1) * (1 - f) + texel(i + 1, j + 1) * f) * g;
    };
    for (int k = 0; k <= samples; ++k) {
        const double s = from + (to - from) * k / samples;
        const double u = ray.u + (s - ray.s_polygon) * ray.Ku,
                     v = ray.v + (s - ray.s_polygon) * ray.Kv;
        bool inside = false;
        for (int pair = 0; pair < 4; pair += 2)
            inside = inside || (depth(u, v, pair) <= s && s < depth(u, v, pair + 1));
        if (!inside) return true;
    }
    return false;
}

/// Stretches of random rays through random layers: none that samples find is missed, and samples
/// miss few.
TEST(LayerErrors, RaysThatComeOutAreFound) {
    test::Random random(8);
    int out = 0, in = 0, only_found = 0;
    for (int map_number = 0; map_number < (test::sanitized ? 4 : 12); ++map_number) {
        std::vector<float> texels;
        for (int texel = 0; texel < 64; ++texel) {
            // Thick solids, so that stretches within one are found.
            const double front = random.uniform(0, 0.2), back = random.uniform(0.5, 0.7);
            for (const double depth :
                 {front, back, random.uniform(0.5, 0.7), random.uniform(0.8, 1)})
                texels.push_back(static_cast<float>(depth));
        }
        const SampledTexture map = texture_of_texels(texels, 8, 8);
        for (int k = 0; k < 60; ++k) {
            const oracle::Ray ray{random.uniform(0, 1), random.uniform(0, 1),
                                  random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), 0};
            const double from = random.uniform(0, 0.9), to = from + random.uniform(0.01, 0.4);
            const double end = std::min(to, 1.0);
            const bool found = leaves_layers(map, 4, ray, from, to);
            const bool sampled = leaves_by_samples(map, ray, from, end);
            EXPECT_TRUE(found || !sampled) << map_number << ", " << k;
            ++(found ? out : in);
            only_found += found && !sampled;
        }
    }
    EXPECT_GT(out, test::rounds(100));
    EXPECT_GT(in, test::rounds(100));
    EXPECT_LE(only_found, 6);
}

}  // namespace
}  // namespace quadrel::render_tests
