// Quads as the channels show them: lanes, coverage, and derivatives as differences of neighbours.
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

/// A pixel in window coordinates, from the image's and back.
struct Rows {
    bool up;
    int height;
    int flip(int y) const { return up ? height - 1 - y : y; }
};

Rows rows_of(const Scene& scene) { return {scene.conventions == Conventions::gl, scene.height}; }

/// Whether two pixels show the same triangle (no triangle of these scenes is clipped).
bool same_triangle(const Film& film, int x0, int y0, int x1, int y1) {
    return bits(film, "id.object", x0, y0) == bits(film, "id.object", x1, y1) &&
           bits(film, "id.primitive", x0, y0) == bits(film, "id.primitive", x1, y1);
}

/// quad.lane is the parity of the window coordinates; quad.coverage has a bit for each pixel of the
/// quad that shows the same triangle.
testing::AssertionResult quads_are_aligned(const Renderer& renderer, const Scene& scene) {
    const Film film = take(renderer, scene, {"A", "id", "quad"});
    const Rows rows = rows_of(scene);
    return everywhere(film, covered(film), [&](int x, int y) {
        const int wy = rows.flip(y);
        std::uint32_t coverage = 0;
        for (int lane = 0; lane < 4; ++lane) {
            const int nx = (x & ~1) + (lane & 1), ny = (wy & ~1) + (lane >> 1);
            if (nx < scene.width && ny < scene.height &&
                same_triangle(film, x, y, nx, rows.flip(ny)))
                coverage |= 1u << lane;
        }
        return differs("quad.lane", bits(film, "quad.lane", x, y), (x & 1) + 2 * (wy & 1), 0) +
               differs("quad.coverage", bits(film, "quad.coverage", x, y), coverage, 0);
    });
}

/// In quads that one triangle covers wholly the differences can be redone from the picture.
testing::AssertionResult derivatives_are_differences(const Renderer& renderer, Scene scene,
                                                     DerivativeMode mode) {
    scene.derivatives = mode;
    const Film film = take(renderer, scene, {"A", "quad", "uv", "dUVdx", "dUVdy", "P", "dPdy"});
    const Rows rows = rows_of(scene);
    const auto whole = [&](int x, int y) { return bits(film, "quad.coverage", x, y) == 15; };
    const bool fine = mode == DerivativeMode::fine;
    return everywhere(film, whole, [&](int x, int y) {
        const int x0 = x & ~1, wy0 = rows.flip(y) & ~1;
        const int top = rows.flip(wy0), bottom = rows.flip(wy0 + 1);
        const int row = fine ? y : top, column = fine ? x : x0;
        const auto dx = [&](const char* name) {
            return value(film, name, x0 + 1, row) - value(film, name, x0, row);
        };
        const auto dy = [&](const char* name) {
            return value(film, name, column, bottom) - value(film, name, column, top);
        };
        return differs("dUVdx.U", value(film, "dUVdx.U", x, y), dx("uv.U"), 0) +
               differs("dUVdx.V", value(film, "dUVdx.V", x, y), dx("uv.V"), 0) +
               differs("dUVdy.V", value(film, "dUVdy.V", x, y), dy("uv.V"), 0) +
               differs("dPdy.Y", value(film, "dPdy.Y", x, y), dy("P.Y"), 0);
    });
}

/// lod.rho is the longer of the two footprints in texels of the height map (16 x 16), lambda its
/// logarithm.
testing::AssertionResult footprint_follows_derivatives(const Renderer& renderer, Scene scene) {
    for (Object& object : scene.objects) object.visible = object.material == 0;
    const Film film = take(renderer, scene, {"A", "dUVdx", "dUVdy", "lod"});
    return everywhere(film, covered(film), [&](int x, int y) {
        const auto at = [&](const char* name) { return double{value(film, name, x, y)}; };
        const double dx = std::sqrt(at("dUVdx.U") * at("dUVdx.U") + at("dUVdx.V") * at("dUVdx.V"));
        const double dy = std::sqrt(at("dUVdy.U") * at("dUVdy.U") + at("dUVdy.V") * at("dUVdy.V"));
        const double rho = 16 * std::max(dx, dy);
        return differs("lod.rho", at("lod.rho"), rho, 1e-6 * rho) +
               differs("lod.lambda", at("lod.lambda"), std::log2(rho), 1e-5);
    });
}

TEST(Quads, AreAlignedToTheWindow) {
    for (const Conventions conventions : {Conventions::gl, Conventions::vulkan, Conventions::d3d})
        EXPECT_TRUE(quads_are_aligned(render, varied_scene(1, conventions)));
    EXPECT_FALSE(
        quads_are_aligned(with(Planted::picture_upside_down), varied_scene(1, Conventions::d3d)));
}

TEST(Quads, DifferentiateOverNeighbours) {
    for (const Conventions conventions : {Conventions::gl, Conventions::vulkan})
        for (const DerivativeMode mode : {DerivativeMode::fine, DerivativeMode::coarse})
            EXPECT_TRUE(derivatives_are_differences(render, varied_scene(1, conventions), mode));
    EXPECT_FALSE(derivatives_are_differences(with(Planted::derivatives_of_image),
                                             varied_scene(1, Conventions::d3d),
                                             DerivativeMode::fine));
}

TEST(Quads, FootprintsComeFromDifferences) {
    EXPECT_TRUE(footprint_follows_derivatives(render, varied_scene()));
    const Renderer undifferentiated = [](const Scene& scene, const RenderOptions& options) {
        Film film = render(scene, options);
        for (Plane& plane : film.planes)
            if (plane.name == "lod.rho") plane.bits.assign(plane.bits.size(), 0x3f800000u);
        return film;
    };
    EXPECT_FALSE(footprint_follows_derivatives(undifferentiated, varied_scene()));
}

}  // namespace
}  // namespace quadrel::render_tests
