// exact.* and derr.*: exact derivatives beside what stages take for them.
#include <gtest/gtest.h>

#include "render/films.hpp"
#include "render/plan/prepared.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

using Names = std::vector<std::string>;

/// The names without exact or derr, for each axis.
const Names derivatives{"dUVdx.U", "dUVdx.V", "dUVdy.U", "dUVdy.V", "dPdx.X",
                        "dPdx.Y",  "dPdx.Z",  "dPdy.X",  "dPdy.Y",  "dPdy.Z"};

Names exact_channels() {
    Names names{"A", "lod.rho", "lod.lambda", "hit.U", "hit.V"};
    for (const std::string& name : derivatives) names.push_back(name);
    names.insert(names.end(), {"exact", "derr"});
    return names;
}

Film take_in(const Renderer& renderer, const Scene& scene, const std::string& number,
             const Names& channels = exact_channels()) {
    RenderOptions options;
    options.channels = channels;
    options.number = number;
    options.isa = "scalar";
    options.tile = 16;
    return renderer(scene, options);
}

/// A textured square in parallel view, 1 unit per pixel, parallel to the picture.
Scene aligned_scene() {
    Scene scene = empty_scene(40, 32);
    set_pixel_camera(scene);
    scene.materials = {plain_material("plain")};
    scene.materials[0].textures["color"] = noise_texture();
    add_object(scene, rectangle(-17.3f, -11.1f, 16.2f, 12.4f, -5), 0);
    return scene;
}

/// Relief in perspective.
Scene tilted_scene(int size, const std::string& trace = "texel-exact") {
    Scene scene = empty_scene(size, size);
    set_perspective_camera(scene, {0.3, -1.4, 1.6}, {.near = 0.5, .far = 50});
    scene.materials = {relief_material("relief", false)};
    scene.materials[0].trace = stage(trace, "materials.relief.relief.trace");
    scene.materials[0].depth = 0.05f;
    add_object(scene, make_quad(2), 0);
    return scene;
}

/// Look(x, y) at every covered pixel.
template <class Look>
void each_covered(const Film& film, const Look& look) {
    for (int y = film.window.y0; y < film.window.y1; ++y)
        for (int x = film.window.x0; x < film.window.x1; ++x)
            if (value(film, "A", x, y) > 0) look(x, y);
}

double largest(const Film& film, const std::string& channel) {
    double most = 0;
    each_covered(film, [&](int x, int y) {
        most = std::max(most, std::abs(static_cast<double>(value(film, channel, x, y))));
    });
    return most;
}

double mean(const Film& film, const std::string& channel) {
    double sum = 0;
    int count = 0;
    each_covered(film, [&](int x, int y) {
        sum += std::abs(static_cast<double>(value(film, channel, x, y)));
        ++count;
    });
    return sum / count;
}

/// Where nothing curves, differences are exact but for the rounding of what is subtracted.
testing::AssertionResult constant_gradients_have_no_error(const Renderer& renderer) {
    for (const char* number : {"float", "double"}) {
        const Film film = take_in(renderer, aligned_scene(), number);
        const double rounding = number == std::string("float") ? 0x1p-23 : 0x1p-40;
        for (const std::string& name : derivatives) {
            const double size = name.starts_with("dUV") ? 1 : 20;
            if (largest(film, "derr." + name) > size * rounding)
                return testing::AssertionFailure() << number << " " << name;
        }
        if (std::abs(largest(film, "exact.dUVdx.U") - 1 / 33.5) > 1e-6 ||
            std::abs(largest(film, "exact.dPdx.X") - 1) > 1e-6 ||
            std::abs(largest(film, "exact.dPdy.Y") - 1) > 1e-6)
            return testing::AssertionFailure() << "another gradient";
    }
    return testing::AssertionSuccess();
}

/// In perspective differences come near, by a quarter of the error at half the pixel.
testing::AssertionResult errors_fall_with_the_pixel(const Renderer& renderer) {
    const Film coarse = take_in(renderer, tilted_scene(48), "double");
    const Film fine = take_in(renderer, tilted_scene(96), "double");
    for (const std::string& name : derivatives) {
        const double gradient = mean(coarse, "exact." + name);
        if (gradient < 1e-4) continue;  // of an axis that lies in the picture's
        const double before = mean(coarse, "derr." + name), after = mean(fine, "derr." + name);
        if (!(before < 0.1 * gradient && after < before / 3 && after > before / 6))
            return testing::AssertionFailure()
                   << name << ": " << gradient << ", off by " << before << ", then " << after;
    }
    return testing::AssertionSuccess();
}

double median(const Film& film, const std::string& channel) {
    std::vector<float> all;
    each_covered(film, [&](int x, int y) { all.push_back(std::abs(value(film, channel, x, y))); });
    std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
    return all[all.size() / 2];
}

/// Differences of the displaced coordinates come near where no patch ends between the pixels.
testing::AssertionResult errors_of_hits_fall(const Renderer& renderer) {
    const Film coarse = take_in(renderer, tilted_scene(64), "double");
    const Film fine = take_in(renderer, tilted_scene(128), "double");
    for (const std::string name : {"dhitUVdx.U", "dhitUVdy.V"}) {
        const double gradient = median(coarse, "exact." + name);
        const double before = median(coarse, "derr." + name), after = median(fine, "derr." + name);
        if (!(before < 0.2 * gradient && after < before / 3))
            return testing::AssertionFailure()
                   << name << ": " << gradient << ", off by " << before << ", then " << after;
    }
    return testing::AssertionSuccess();
}

/// What is drawn is the exact derivative and its error.
testing::AssertionResult add_up(const Film& film) {
    testing::AssertionResult result = testing::AssertionSuccess();
    Names names = derivatives;
    names.insert(names.end(), {"lod.rho", "lod.lambda"});
    each_covered(film, [&](int x, int y) {
        for (const std::string& name : names) {
            const float drawn = value(film, name, x, y), exact = value(film, "exact." + name, x, y),
                        error = value(film, "derr." + name, x, y);
            if (!(std::abs(drawn - exact - error) <= 1e-6f * (0.01f + std::abs(drawn))))
                result = testing::AssertionFailure() << name << " at " << x << "," << y;
        }
    });
    return result;
}

/// render() with two planes of its film exchanged.
Renderer exchanged(const std::string& a, const std::string& b) {
    return [=](const Scene& scene, const RenderOptions& options) {
        Film film = render(scene, options);
        Plane *first = nullptr, *second = nullptr;
        for (Plane& plane : film.planes) {
            if (plane.name == a) first = &plane;
            if (plane.name == b) second = &plane;
        }
        std::swap(first->bits, second->bits);
        return film;
    };
}

TEST(ExactChannels, ConstantGradientsHaveNoError) {
    EXPECT_TRUE(constant_gradients_have_no_error(render));
    EXPECT_FALSE(constant_gradients_have_no_error(exchanged("exact.dPdx.X", "exact.dPdy.X")));
    EXPECT_FALSE(constant_gradients_have_no_error(exchanged("derr.dUVdx.U", "dUVdx.U")));
}

TEST(ExactChannels, ErrorsFallWithThePixel) {
    EXPECT_TRUE(errors_fall_with_the_pixel(render));
    EXPECT_FALSE(errors_fall_with_the_pixel(exchanged("derr.dUVdx.U", "dUVdx.U")));
    EXPECT_TRUE(errors_of_hits_fall(render));
    EXPECT_FALSE(errors_of_hits_fall(exchanged("derr.dhitUVdx.U", "exact.dhitUVdx.U")));
}

TEST(ExactChannels, ErrorsAreWhatIsDrawnLessTheExact) {
    for (const DerivativeMode mode : {DerivativeMode::fine, DerivativeMode::coarse})
        for (const char* number : {"float", "double"}) {
            Scene scene = tilted_scene(40);
            scene.derivatives = mode;
            EXPECT_TRUE(add_up(take_in(render, scene, number))) << number;
            EXPECT_FALSE(
                add_up(take_in(exchanged("exact.dUVdx.U", "exact.dUVdy.U"), scene, number)));
        }
}

Film with_exact_alone(const Film& film) {
    Film out{film.frame, film.window, {}};
    for (const Plane& plane : film.planes)
        if (plane.name.starts_with("exact.")) out.planes.push_back(plane);
    return out;
}

TEST(ExactChannels, DependOnNeitherNumberNorTilesNorShortcuts) {
    const Scene scene = tilted_scene(40, "linear");
    const Film film = take_in(render, scene, "float");
    RenderOptions options;
    options.channels = exact_channels();
    options.tile = 64;
    options.skip = false;
    EXPECT_TRUE(same_bits(with_exact_alone(film), take_in(render, scene, "double")));
    EXPECT_TRUE(same_bits(film, render(scene, options)));
    EXPECT_TRUE(same_bits(take(render, scene, {"A", "hit.U", "hit.V", "dUVdx"}), film));
}

/// A camera rolled by a right angle: the picture turns, and its axes with it. Vertices snap to
/// their nearest subpixel either way.
testing::AssertionResult turns_with_the_camera(const Renderer& renderer) {
    constexpr int size = 40;
    Scene scene = tilted_scene(size);
    const Film film = take_in(renderer, scene, "double");
    scene.camera.view = glm::mat4(rotation(90, {0, 0, 1})) * scene.camera.view;
    const Film rolled = take_in(renderer, scene, "double");
    int pixels = 0, off = 0;
    each_covered(film, [&](int x, int y) {
        // Counter-clockwise: what was right is up, and what was up is left.
        const int rx = y, ry = size - 1 - x;
        if (value(rolled, "A", rx, ry) == 0) return;
        const auto near = [&](const std::string& a, const std::string& b, float sign) {
            const float expected = value(film, a, x, y);
            return std::abs(sign * value(rolled, b, rx, ry) - expected) <=
                   1e-3f * (0.01f + std::abs(expected));
        };
        ++pixels;
        off += !near("exact.dUVdx.U", "exact.dUVdy.U", 1) ||
               !near("exact.dUVdy.V", "exact.dUVdx.V", -1) ||
               !near("exact.dPdx.Z", "exact.dPdy.Z", 1) ||
               !near("exact.lod.rho", "exact.lod.rho", 1);
    });
    if (pixels > 200 && 50 * off <= pixels) return testing::AssertionSuccess();
    return testing::AssertionFailure() << off << " of " << pixels;
}

TEST(ExactChannels, TurnWithTheCamera) {
    EXPECT_TRUE(turns_with_the_camera(render));
    EXPECT_FALSE(turns_with_the_camera([](const Scene& scene, const RenderOptions& options) {
        Film film = render(scene, options);
        for (Plane& plane : film.planes)  // differences as of images, whose rows go down
            if (plane.name == "exact.dUVdy.U")
                for (std::uint32_t& bits : plane.bits) bits ^= 0x80000000u;
        return film;
    }));
}

TEST(ExactChannels, CostNothingUnlessAskedFor) {
    const Scene scene = tilted_scene(16);
    RenderOptions options;
    const auto plans = [&] {
        return plan_render(scene, options, scalar_float_kernels()).plan.exact.size();
    };
    EXPECT_EQ(plans(), 0u);
    options.channels = {"dUVdx", "lod"};
    EXPECT_EQ(plans(), 0u);
    options.channels = {"exact.dUVdx.U"};
    EXPECT_EQ(plans(), 1u);
}

/// Other samples, centroids and attribute set-ups have derivatives of their own.
TEST(ExactChannels, ServeEveryWayToShadeAFragment) {
    for (const Hardware hardware : {Hardware::exact, Hardware::llvmpipe, Hardware::swiftshader})
        for (const int samples : {1, 4}) {
            Scene scene = tilted_scene(32);
            scene.hardware = hardware;
            scene.samples = samples;
            scene.centroid = samples > 1;
            const Film film = take_in(render, scene, "float");
            EXPECT_LT(mean(film, "derr.dUVdx.U"), 0.1 * mean(film, "exact.dUVdx.U"));
            EXPECT_LT(mean(film, "derr.dPdy.Y"), 0.1 * mean(film, "exact.dPdy.Y"));
        }
}

}  // namespace
}  // namespace quadrel::render_tests
