// exact.* and derr.* of what shading differentiates: heights, normals, mirrored directions,
// colours.
#include <gtest/gtest.h>

#include "quadrel/error.hpp"
#include "quadrel/relief/registry.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

Film take_shading(const Renderer& renderer, const Scene& scene, const std::string& number) {
    RenderOptions options;
    options.channels = {"A", "uv", "P", "exact", "derr"};
    options.number = number;
    options.isa = "scalar";
    return renderer(scene, options);
}

/// Heights and colours rise with u by 1 per tile, between the centres of the outermost texels.
TextureReference ramp() {
    return texture(write_texture("ramp.exr", 8, [](int x, int, int) { return (x + 0.5) / 8; }));
}

/// A square of 33.5 pixels a tile, parallel to the picture.
Scene ramp_scene() {
    Scene scene = empty_scene(40, 32);
    set_pixel_camera(scene);
    scene.materials = {plain_material("ramp")};
    scene.materials[0].textures["height"] = scene.materials[0].textures["color"] = ramp();
    scene.materials[0].shade = stage("shade-texture", "materials.ramp.shade");
    add_object(scene, rectangle(-17.25f, -11, 16.25f, 12, -5), 0);
    return scene;
}

Where inner(const Film& film) {
    return [&film](int x, int y) {
        const float u = value(film, "uv.U", x, y);
        return value(film, "A", x, y) > 0 && u > 0.13f && u < 0.87f;
    };
}

testing::AssertionResult has_the_slope_of_a_ramp(const Renderer& renderer) {
    for (const char* number : {"float", "double"}) {
        const Film film = take_shading(renderer, ramp_scene(), number);
        const auto result = everywhere(film, inner(film), [&](int x, int y) {
            for (const std::string name : {"dhdx", "dcolordx.R"}) {
                const auto off =
                    differs(name.c_str(), value(film, "exact." + name, x, y), 1 / 33.5, 1e-6);
                if (!off.empty()) return off;
            }
            for (const std::string name : {"dhdy", "dcolordy.G", "dNdx.X", "dmirroreddy.Z"})
                if (value(film, "exact." + name, x, y) != 0) return name;
            for (const std::string name : {"dhdx", "dhdy", "dcolordx.R", "dcolordy.B", "dNdy.X"})
                if (std::abs(value(film, "derr." + name, x, y)) > 1e-6f) return "error of " + name;
            return std::string();
        });
        if (!result) return result;
    }
    return testing::AssertionSuccess();
}

/// Of a plane straight ahead, at the point (X, Y, -d) at the distance r, the mirrored direction is
/// (X, Y, d) / r.
testing::AssertionResult mirrors_as_the_formula_says(const Renderer& renderer) {
    Scene scene = empty_scene(32, 32);
    set_perspective_camera(scene, {0, 0, 3}, {.near = 0.5, .far = 50});
    scene.materials = {plain_material("mirror")};
    add_object(scene, make_quad(2), 0);
    const Film film = take_shading(renderer, scene, "double");
    return everywhere(film, covered(film), [&](int x, int y) {
        const double X = value(film, "P.X", x, y), Y = value(film, "P.Y", x, y);
        const double r = std::sqrt(X * X + Y * Y + 9), step = value(film, "exact.dPdx.X", x, y);
        const double along[] = {(r * r - X * X) / (r * r * r), -X * Y / (r * r * r),
                                -3 * X / (r * r * r)};
        for (int c = 0; c < 3; ++c) {
            const std::string name = std::string("exact.dmirroreddx.") + "XYZ"[c];
            const auto off = differs(name.c_str(), value(film, name, x, y), step * along[c], 1e-6);
            if (!off.empty()) return off;
        }
        return std::string();
    });
}

double median_of(const Film& film, const std::string& channel) {
    std::vector<float> all;
    for (std::size_t i = 0; i < film.window.area(); ++i)
        if (film.find("A")->as_float(i) > 0)
            all.push_back(std::abs(film.find(channel)->as_float(i)));
    std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
    return all[all.size() / 2];
}

/// Relief on a sphere, with the bumps of `surface`.
Scene bumpy_sphere(int size, const std::string& surface) {
    Scene scene = empty_scene(size, size);
    set_perspective_camera(scene, {0, 0, 2.6}, {.near = 0.5, .far = 50});
    scene.materials = {relief_material("relief", false)};
    scene.materials[0].trace = stage("max-mip", "trace");
    scene.materials[0].surface = stage(surface, "surface");
    scene.materials[0].shadow = stage("none", "shadow");
    scene.materials[0].depth = 0.02f;
    scene.environment = noise_environment();
    scene.lights = {Light()};
    add_object(scene, make_sphere(0.8, 48, 32), 0);
    return scene;
}

/// Differences come near, the more so the smaller the pixel.
testing::AssertionResult errors_of_shading_fall(const Renderer& renderer) {
    const Film coarse = take_shading(renderer, bumpy_sphere(64, "h2n-patch"), "double");
    const Film fine = take_shading(renderer, bumpy_sphere(128, "h2n-patch"), "double");
    for (const std::string name :
         {"dhdx", "dhdy", "dNdx.X", "dNdy.Y", "dmirroreddx.X", "dmirroreddy.Y", "dcolordx.R"}) {
        const double gradient = median_of(coarse, "exact." + name);
        const double before = median_of(coarse, "derr." + name),
                     after = median_of(fine, "derr." + name);
        if (!(gradient > 1e-4 && before < 0.6 * gradient && after < before / 2.5))
            return testing::AssertionFailure()
                   << name << ": " << gradient << ", off by " << before << ", then " << after;
    }
    return testing::AssertionSuccess();
}

/// render() with two planes of its film exchanged.
Renderer with_exchanged(const std::string& a, const std::string& b) {
    return [=](const Scene& scene, const RenderOptions& options) {
        Film film = render(scene, options);
        std::swap(film.find(a)->bits, film.find(b)->bits);
        return film;
    };
}

TEST(ExactShading, OfARampIsItsSlope) {
    EXPECT_TRUE(has_the_slope_of_a_ramp(render));
    EXPECT_FALSE(has_the_slope_of_a_ramp(with_exchanged("exact.dhdx", "exact.dhdy")));
    EXPECT_FALSE(has_the_slope_of_a_ramp(with_exchanged("exact.dhdx", "derr.dhdx")));
    EXPECT_FALSE(has_the_slope_of_a_ramp(with_exchanged("exact.dcolordx.R", "exact.dNdx.X")));
}

TEST(ExactShading, OfMirroredDirectionsIsTheFormulas) {
    EXPECT_TRUE(mirrors_as_the_formula_says(render));
    EXPECT_FALSE(
        mirrors_as_the_formula_says(with_exchanged("exact.dmirroreddx.X", "exact.dmirroreddy.Y")));
}

TEST(ExactShading, ErrorsFallWithThePixel) {
    EXPECT_TRUE(errors_of_shading_fall(render));
    EXPECT_FALSE(errors_of_shading_fall(with_exchanged("derr.dhdx", "exact.dhdx")));
    EXPECT_FALSE(errors_of_shading_fall(with_exchanged("exact.dmirroreddx.X", "derr.dNdx.X")));
}

/// Each behind the one before.
TextureReference layers_of_noise() {
    return texture(write_texture("layers_of_noise.exr", map_texels,
                                 [](int x, int y, int c) { return (c + noise(x, y, 7)) / 4; }));
}

/// Whatever surface a scene has, and heights of noise, or none.
TEST(ExactShading, ServesEverySurface) {
    for (const StageInfo& info : all_stages()) {
        if (std::string_view(info.text.room) != "surface") continue;
        Scene scene = bumpy_sphere(12, info.text.id);
        scene.materials[0].textures["normal"] = noise_texture();
        scene.materials[0].textures["layers"] = layers_of_noise();
        EXPECT_NO_THROW(take_shading(render, scene, "float")) << info.text.id;
    }
    Scene noisy = bumpy_sphere(24, "h2n-patch");
    noisy.materials[0].trace = stage("linear", "trace");
    noisy.materials[0].textures.erase("height");
    noisy.materials[0].noise = NoiseHeights();
    const Film film = take_shading(render, noisy, "float");
    EXPECT_GT(median_of(film, "exact.dhdx"), 0);
    noisy.materials[0] = plain_material("plain");
    EXPECT_EQ(median_of(take_shading(render, noisy, "float"), "exact.dhdx"), 0);
}

/// What the judge decides does not move: it says so.
TEST(ExactShading, NamesWhatDoesNotRunOnDuals) {
    Scene scene = bumpy_sphere(12, "h2n-patch");
    scene.materials[0].trace = stage("oracle-bilinear", "trace");
    EXPECT_THROW(take_shading(render, scene, "float"), UsageError);
}

}  // namespace
}  // namespace quadrel::render_tests
