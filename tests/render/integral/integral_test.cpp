// Integrals over pixels as renders: the same bits however they are drawn, what they replace, what
// they refuse, what they tell.
#include "quadrel/error.hpp"
#include "quadrel/prepare.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/stats.hpp"
#include "render/bands/joined.hpp"
#include "render/integral/integral_scene.hpp"
#include "render/integral/integrals.hpp"

namespace quadrel::render_tests {
namespace {

RenderOptions plain_options() {
    RenderOptions options;
    options.isa = "scalar";
    options.threads = 1;
    return options;
}

/// A film of all integral channels, however it is drawn.
using Draw = std::function<Film(const Scene&, const RenderOptions&)>;

testing::AssertionResult has_equal_bits(const Draw& draw, const IntegralOptions& integral) {
    const Scene scene = varied_scene(1, Conventions::gl, 15, 11);
    RenderOptions plain = plain_options();
    plain.integral = integral;
    const Film expected = draw(scene, plain);
    for (const int tile : {2, 6, 1024}) {
        RenderOptions other;
        other.integral = integral;
        other.threads = 3;
        other.tile = tile;
        other.skip = tile != 6;
        const auto same = same_bits(expected, draw(scene, other));
        if (!same) return same;
    }
    for (const Window window : {Window{0, 0, 9, 7}, Window{7, 4, 14, 11}, Window{14, 10, 15, 11}}) {
        RenderOptions other = plain;
        other.window = window;
        const Film part = draw(scene, other);
        for (const Plane& plane : part.planes)
            for (int y = window.y0; y < window.y1; ++y)
                for (int x = window.x0; x < window.x1; ++x)
                    if (plane.bits[part.index(x, y)] != bits(expected, plane.name, x, y))
                        return testing::AssertionFailure()
                               << plane.name << " at " << x << "," << y << " in a window";
    }
    return testing::AssertionSuccess();
}

TEST(Integral, HasEqualBitsInEveryRun) {
    EXPECT_TRUE(has_equal_bits(render, {16, 0}));
    EXPECT_TRUE(has_equal_bits(render, {128, 0.02}));
    EXPECT_FALSE(has_equal_bits(
        [](const Scene& scene, const RenderOptions& options) {  // fewer samples in small tiles
            RenderOptions other = options;
            if (options.tile == 2) other.integral->samples = 16;
            return render(scene, other);
        },
        {32, 0}));
}

TEST(Integral, ComesInBandsAsWhole) {
    const Scene scene = varied_scene();
    RenderOptions options;
    options.integral = IntegralOptions{16, 0};
    options.tile = 8;
    EXPECT_TRUE(same_bits(render(scene, options), joined_bands(scene, options)));
}

/// Of one colour everywhere: the very colour, without an error, after the fewest samples.
TEST(Integral, OfOneColourIsThatColour) {
    Scene scene = empty_scene(7, 5);
    set_pixel_camera(scene);
    scene.materials = {plain_material("plain", {0.3f, 0.7f, 0.1f})};
    add_object(scene, rectangle(-20, -20, 20, 20, -5), 0);
    const Film film = integrate(scene, {512, 1e-3});
    EXPECT_TRUE(everywhere(film, {}, [&](int x, int y) -> std::string {
        if (value(film, "R", x, y) != 0.3f || value(film, "G", x, y) != 0.7f) return "colour";
        if (value(film, "A", x, y) != 1) return "coverage";
        if (value(film, "integral.error.R", x, y) != 0) return "error";
        return bits(film, "integral.samples", x, y) == 64 ? "" : "samples";
    }));
}

TEST(Integral, OfNothingIsTheBackground) {
    const Scene scene = empty_scene(5, 3);
    for (const IntegralOptions integral : {IntegralOptions{80, 0}, IntegralOptions{80, 0.1}}) {
        const Film film = integrate(scene, integral);
        EXPECT_EQ(value(film, "G", 4, 2), 0.5f);
        EXPECT_EQ(value(film, "A", 4, 2), 0);
        EXPECT_EQ(bits(film, "integral.samples", 4, 2), integral.error > 0 ? 64u : 80u);
    }
}

/// The nearer of two is seen at each sample, holes are what is behind them.
TEST(Integral, SamplesAreTestedForDepthAndHoles) {
    const auto mean_of = [](float nearer, float farther, bool holes) {
        Scene scene = empty_scene(6, 6);
        set_pixel_camera(scene);
        scene.materials = {plain_material("near", {1, 1, 1}), plain_material("far")};
        add_object(scene, rectangle(-1.5f, -9, 9, 9, nearer), 0);
        add_object(scene, rectangle(-9, -9, 9, 9, farther), 1);
        if (holes) {
            scene.materials[0].textures["color"] = holes_texture();
            scene.materials[0].discard_below = 0.5f;
        }
        const Film film = integrate(scene, {256, 0});
        EXPECT_EQ(value(film, "A", 1, 3), 1);
        return value(film, "R", 1, 3);  // from 1 to 2, the edge at 1.5
    };
    EXPECT_NEAR(mean_of(-3, -5, false), 0.5, 0.02);
    EXPECT_EQ(mean_of(-5, -3, false), 0);
    EXPECT_LT(mean_of(-3, -5, true), 0.5);
}

/// Against pictures that are 12 times as large, of what an integral takes samples of: everything
/// that there is, by another way.
testing::AssertionResult is_the_mean_of_a_finer_picture(const Integrator& integrator,
                                                        const Scene& scene) {
    constexpr int finer = 12;
    const int width = scene.width, height = scene.height;
    const Film film = integrator(scene, {128, 0});
    Scene large = integral_scene(scene);
    large.width *= finer;
    large.height *= finer;
    const Film picture = render(large, {});
    double squares = 0, sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double mean = 0;
            for (int i = 0; i < finer * finer; ++i)
                mean += value(picture, "G", finer * x + i % finer, finer * y + i / finer) /
                        (finer * finer);
            const double off = value(film, "G", x, y) - mean;
            squares += off * off / (width * height);
            sum += off / (width * height);
        }
    if (std::sqrt(squares) < 0.012 && std::abs(sum) < 0.001) return testing::AssertionSuccess();
    return testing::AssertionFailure() << std::sqrt(squares) << " off, on average " << sum;
}

TEST(Integral, IsTheMeanOfAFinerPicture) {
    const Scene scene = varied_scene(1, Conventions::gl, 16, 12);
    EXPECT_TRUE(is_the_mean_of_a_finer_picture(honest, scene));
    EXPECT_FALSE(is_the_mean_of_a_finer_picture(centres_alone, scene));
    EXPECT_FALSE(is_the_mean_of_a_finer_picture(wide_filter, scene));
    // Rows that go down, depths and silhouettes of the relief.
    Scene other = only(varied_scene(1, Conventions::vulkan, 16, 12), 0);
    other.materials[0].depth = 1;
    other.materials[0].frag_depth = stage("frag-depth", "materials.relief.relief.frag_depth");
    other.materials[0].clip = stage("clip-uv", "materials.relief.relief.clip");
    EXPECT_TRUE(is_the_mean_of_a_finer_picture(honest, other));
    EXPECT_FALSE(is_the_mean_of_a_finer_picture(  // silhouettes of the polygon
        [](Scene changed, const IntegralOptions& integral) {
            changed.materials[0].clip = {};
            return integrate(changed, integral);
        },
        other));
}

TEST(Integral, ComesFrameAfterFrame) {
    RenderOptions options;
    options.integral = IntegralOptions{16, 0};
    PreparedScene prepared(varied_scene(1, Conventions::d3d, 21, 17), options);
    EXPECT_TRUE(same_bits(render(prepared.scene(), options), prepared.draw()));
    prepared.scene().camera.view[3][0] += 0.1f;
    EXPECT_TRUE(same_bits(render(prepared.scene(), options), prepared.draw()));
    prepared.options().integral.reset();
    EXPECT_TRUE(same_bits(render(prepared.scene(), {}), prepared.draw()));
}

TEST(Integral, ReplacesWhatAFootprintDecides) {
    Scene scene = varied_scene(4);
    scene.hardware = Hardware::swiftshader;
    scene.materials[1].trace.id = "qdm";
    scene.materials[1].surface.id = "bump-blinn";
    const Scene changed = integral_scene(scene);
    EXPECT_EQ(changed.samples, 1);
    EXPECT_EQ(changed.hardware, Hardware::exact);
    EXPECT_EQ(changed.materials[0].trace.id, "oracle-bilinear");
    EXPECT_TRUE(changed.materials[0].trace.parameters.empty());
    EXPECT_EQ(changed.materials[0].surface.id, "h2n-thesis");
    EXPECT_EQ(changed.materials[1].trace.id, "oracle-block");
    EXPECT_EQ(changed.materials[1].surface.id, "h2n-patch");
    EXPECT_EQ(changed.materials[3].trace.id, "none");
    EXPECT_EQ(changed.materials[2].textures.at("color").sampler.mag, Filter::linear);
    EXPECT_EQ(changed.environment->sampler.mip, MipFilter::none);
}

TEST(Integral, RefusesSearchesThatRaysMayPass) {
    Scene scene = varied_scene();
    EXPECT_NO_THROW(integral_scene(scene));
    for (const char* trace : {"prism-free", "curved-quadric"}) {
        scene.materials[0].trace = stage(trace, "materials.stone.relief.trace");
        EXPECT_THROW(integral_scene(scene), InputError) << trace;
    }
}

/// Which levels a sampler would choose does not matter, nor how hardware filters.
TEST(Integral, DoesNotDependOnLevelsOfDetail) {
    Scene scene = varied_scene();
    const Film expected = integrate(scene, {16, 0});
    for (Material& material : scene.materials)
        for (auto& [slot, map] : material.textures) {
            map.sampler.lod_bias = 3;
            map.sampler.weight_bits = 4;
            map.sampler.lod_form = LodForm::ellipse;
        }
    scene.derivatives = DerivativeMode::coarse;
    EXPECT_TRUE(same_bits(expected, integrate(scene, {16, 0})));
}

TEST(Integral, RefusesWhatItCannot) {
    const Scene scene = varied_scene();
    for (const IntegralOptions& bad :
         {IntegralOptions{0, 0}, IntegralOptions{8, 0}, IntegralOptions{17, 0},
          IntegralOptions{65552, 0}, IntegralOptions{-16, 0}, IntegralOptions{16, -1},
          IntegralOptions{16, std::nan("")}, IntegralOptions{16, HUGE_VAL}})
        EXPECT_THROW(integrate(scene, bad), UsageError) << bad.samples << " " << bad.error;
    RenderOptions options;
    options.channels = {"R", "Z"};
    EXPECT_THROW(integrate(scene, {16, 0}, options), UsageError);
    options.channels = {"integral.samples"};
    EXPECT_THROW(render(scene, options), UsageError);
    RenderStats stats;
    options.stats = &stats;
    options.touched = true;
    EXPECT_THROW(integrate(scene, {16, 0}, options), UsageError);
    Scene noisy = scene;
    noisy.materials[0].noise = NoiseHeights();
    EXPECT_THROW(integrate(noisy, {16, 0}), InputError);
    noisy.materials[0] = plain_material("noisy");
    noisy.materials[0].noise = NoiseHeights();
    EXPECT_NO_THROW(integrate(noisy, {16, 0}));
}

TEST(Integral, TellsItsSamples) {
    const TriangleField field(3);
    RenderStats stats;
    RenderOptions options;
    options.stats = &stats;
    options.window = Window{1, 2, 17, 15};
    const Film film = integrate(field.scene, {256, 0.004}, options);
    std::uint64_t samples = 0, above = 0;
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        samples += film.find("integral.samples")->bits[i];
        above += film.find("integral.error.R")->as_float(i) > 0.004f;
    }
    EXPECT_TRUE(stats.integral.drawn);
    EXPECT_EQ(stats.integral.samples, samples);
    EXPECT_EQ(stats.integral.least, 64u);
    EXPECT_EQ(stats.integral.most, 256u);
    EXPECT_GE(stats.integral.above, above);  // coverage has an error, too
    EXPECT_GT(above, 0u);
    EXPECT_NE(to_json(stats).find("pixels_above_error"), std::string::npos);
}

/// The file says what it is, so that no integral is taken for a render.
TEST(Integral, IsNamedInTheAttributes) {
    const auto is_named = [](const RenderOptions& options) {
        const auto attributes = render_attributes(varied_scene(), options);
        return std::any_of(attributes.begin(), attributes.end(),
                           [](const auto& a) { return a.first == "quadrel:integral"; });
    };
    RenderOptions options;
    EXPECT_FALSE(is_named(options));
    options.integral = IntegralOptions{16, 0};
    EXPECT_TRUE(is_named(options));
}

}  // namespace
}  // namespace quadrel::render_tests
