// Culling, mirroring, flat meshes, cameras, several objects.
#include <glm/geometric.hpp>

#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

Scene cube_scene(Cull cull, double mirror = 1) {
    Scene scene = empty_scene(32, 24);
    set_perspective_camera(scene, {0, 0, 4}, {.near = 0.5, .far = 50});
    scene.materials = {plain_material("plain")};
    scene.materials[0].cull = cull;
    scene.lights = {directional_light({0, 0, 1})};
    Mesh mesh = make_cube(1.3);
    mesh.normals.clear();
    add_object(scene, mesh, 0,
               scaling({mirror, 1, 1}) * translation({0.13, 0.07, 0}) * rotation(33, {1, 2, 3}));
    return scene;
}

glm::vec3 vector_at(const Film& film, const std::string& name, int x, int y) {
    return {value(film, name + ".X", x, y), value(film, name + ".Y", x, y),
            value(film, name + ".Z", x, y)};
}

/// Front faces turn their normal to the viewer: Ng . P < 0 in eye space.
testing::AssertionResult faces(const Renderer& renderer, const Scene& scene, bool front) {
    const Film film = take(renderer, scene, {"A", "P", "Ng"});
    return everywhere(film, covered(film), [&](int x, int y) -> std::string {
        const float cosine = glm::dot(vector_at(film, "Ng", x, y), vector_at(film, "P", x, y));
        return (cosine < 0) == front ? "" : "the other side is seen";
    });
}

/// Of a closed body, culling one side shows the other, and culling the back changes nothing.
testing::AssertionResult culls(const Renderer& renderer, double mirror) {
    if (auto front = faces(renderer, cube_scene(Cull::back, mirror), true); !front) return front;
    if (auto back = faces(renderer, cube_scene(Cull::front, mirror), false); !back) return back;
    const auto channels = without(all_channels(cube_scene(Cull::none)), {});
    return same_bits(take(renderer, cube_scene(Cull::none, mirror), channels),
                     take(renderer, cube_scene(Cull::back, mirror), channels));
}

/// Mirrored in x before a camera on the z axis: the mirrored picture.
testing::AssertionResult mirrors(const Renderer& renderer) {
    const Film film = take(renderer, cube_scene(Cull::back), {"A", "id"});
    const Film mirrored = take(renderer, cube_scene(Cull::back, -1), {"A", "id"});
    return everywhere(film, {}, [&](int x, int y) {
        return differs("id.primitive", bits(mirrored, "id.primitive", 31 - x, y),
                       bits(film, "id.primitive", x, y), 0);
    });
}

TEST(Culling, ShowsTheOtherSide) {
    EXPECT_TRUE(culls(render, 1));
    EXPECT_TRUE(culls(render, -1));
    EXPECT_FALSE(culls(with(Planted::nothing_culled), 1));
    EXPECT_FALSE(culls(with(Planted::mirror_turns_inside_out), -1));
}

TEST(Mirroring, GivesTheMirroredPicture) {
    EXPECT_TRUE(mirrors(render));
    EXPECT_FALSE(mirrors(with(Planted::mirror_turns_inside_out)));
}

/// The shading normal of every fragment is its triangle's, up to the rounding of the interpolation.
testing::AssertionResult shades_flat(const Renderer& renderer) {
    const Film film = take(renderer, cube_scene(Cull::back), {"A", "N", "Ng"});
    return everywhere(film, covered(film), [&](int x, int y) -> std::string {
        const float d = glm::distance(vector_at(film, "N", x, y), vector_at(film, "Ng", x, y));
        return d <= 4e-7f ? "" : fmt::format("N is {} off Ng", d);
    });
}

TEST(FlatMeshes, ShadeWithTheFaceNormal) {
    EXPECT_TRUE(shades_flat(render));
    EXPECT_FALSE(shades_flat(with(Planted::flat_as_smooth)));
}

/// Under a parallel projection every point of a plane sees along one direction: K is constant, and
/// for a plane seen head-on it is 0.
testing::AssertionResult parallel_rays(const Renderer& renderer, double tilt) {
    Scene scene = empty_scene(20, 14);
    set_pixel_camera(scene);
    scene.materials = {relief_material("relief", false)};
    add_object(scene, make_quad(9), 0, translation({0, 0, -5}) * rotation(tilt, {0, 1, 0}));
    const Film film = take(renderer, scene, {"A", "K", "P"});
    const float expected = value(film, "K.U", 10, 7);
    if ((std::abs(expected) > 1e-6f) != (tilt != 0))
        return testing::AssertionFailure() << "K.U is " << expected;
    return everywhere(film, covered(film), [&](int x, int y) {
        return differs("K.U", value(film, "K.U", x, y), expected, 1e-5) +
               differs("K.V", value(film, "K.V", x, y), 0, 1e-6) +
               // The corners are snapped to 1/256 pixel, and the plane with them.
               differs("P.X", value(film, "P.X", x, y), x + 0.5 - 10, 1.0 / 256);
    });
}

TEST(OrthographicCamera, SeesAlongParallelRays) {
    EXPECT_TRUE(parallel_rays(render, 0));
    EXPECT_TRUE(parallel_rays(render, 30));
    EXPECT_FALSE(parallel_rays(with(Planted::viewer_at_origin), 30));
}

Scene seen_through(const DepthAndShift& lens) {
    Scene scene = varied_scene();
    set_perspective_camera(scene, {0.6, 0.9, 4}, lens);
    return scene;
}

/// Where planes of depth lie does not matter to anything but depth, as long as nothing is cut.
testing::AssertionResult same_picture_through(const Renderer& renderer, const DepthAndShift& lens) {
    const Scene usual = seen_through({.near = 0.5, .far = 50});
    const auto channels = without(all_channels(usual), {"depth", "frag.depth"});
    return same_bits(take(renderer, usual, channels), take(renderer, seen_through(lens), channels));
}

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(DepthRange, DoesNotChangeThePicture) {
    EXPECT_TRUE(same_picture_through(render, {.near = 0.5, .far = 50, .reversed_z = true}));
    EXPECT_TRUE(same_picture_through(render, {.near = 0.5, .far = infinite}));
    EXPECT_TRUE(same_picture_through(render, {.near = 0.25, .far = infinite, .reversed_z = true}));
    EXPECT_FALSE(same_picture_through(with(Planted::reversed_z_less),
                                      {.near = 0.5, .far = 50, .reversed_z = true}));
}

TEST(DepthRange, IsReversed) {
    const Film usual = take(render, seen_through({.near = 0.5, .far = 50}), {"A", "depth"});
    const Film reversed =
        take(render, seen_through({.near = 0.5, .far = 50, .reversed_z = true}), {"depth"});
    EXPECT_TRUE(everywhere(usual, covered(usual), [&](int x, int y) {
        return differs("depth", value(reversed, "depth", x, y), 1.0 - value(usual, "depth", x, y),
                       1e-5);
    }));
}

/// A plane that runs to the horizon: beyond the far plane nothing is drawn, with an infinite one
/// all of it is.
testing::AssertionResult far_plane_cuts(const Renderer& renderer, double far) {
    Scene scene = empty_scene(24, 24);
    set_perspective_camera(scene, {0, 0.001, 4}, {.near = 0.5, .far = far});
    scene.materials = {plain_material("plain")};
    add_object(scene, make_quad(20000), 0, translation({0, -1, 0}) * rotation(-90, {1, 0, 0}));
    const Film film = take(renderer, scene, {"A", "Z", "P"});
    if (value(film, "A", 12, 23) != 1) return testing::AssertionFailure() << "nothing is near";
    double farthest = 0;
    for (int y = 0; y < 24; ++y)
        if (value(film, "A", 12, y) > 0)
            farthest = std::max(farthest, static_cast<double>(value(film, "Z", 12, y)));
    return farthest <= far && farthest > std::min(far, 25.0) / 2
               ? testing::AssertionSuccess()
               : testing::AssertionFailure() << "the farthest point lies at " << farthest;
}

TEST(FarPlane, CutsUnlessItIsInfinite) {
    EXPECT_TRUE(far_plane_cuts(render, 9));
    EXPECT_TRUE(far_plane_cuts(render, infinite));
    EXPECT_FALSE(far_plane_cuts(with(Planted::far_plane_ignored), 9));
}

/// Where an object is seen its values are those that it has alone in the scene.
testing::AssertionResult objects_are_independent(const Renderer& renderer, const Scene& scene) {
    const auto channels = without(all_channels(scene), {"quad.coverage"});
    const Film all = take(renderer, scene, channels);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        Scene alone = scene;
        for (std::size_t j = 0; j < scene.objects.size(); ++j) alone.objects[j].visible = i == j;
        const auto here = [&](int x, int y) { return bits(all, "id.object", x, y) == i; };
        if (auto seen = everywhere(all, here, [](int, int) { return std::string(); }); !seen)
            return seen << ": object " << i << " is not seen";
        if (auto same = same_bits(take(renderer, alone, channels), all, here); !same)
            return same << " (object " << i << ")";
    }
    return testing::AssertionSuccess();
}

TEST(Objects, DoNotInfluenceEachOther) {
    EXPECT_TRUE(objects_are_independent(render, varied_scene()));
    EXPECT_FALSE(objects_are_independent(with(Planted::neighbour_bleeds), varied_scene()));
}

}  // namespace
}  // namespace quadrel::render_tests
