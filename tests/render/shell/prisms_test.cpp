// Prisms without tetrahedra as they are drawn: without holes, equal to the mesh where there is no
// relief and to tetrahedra where both are exact; and who looks out of a shell.
#include "quadrel/error.hpp"
#include "render/shell/shell_scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr int prism_size = test::sanitized ? 32 : 96;

Scene prism_scene(const Mesh& mesh, const TextureReference& heights) {
    return scene_of_shell(mesh, "frame-prism", "prism-gs", heights, prism_size);
}

/// The mesh in place of its shell, moved along its normals.
Scene moved_mesh(Scene scene, double offset) {
    scene.materials = {plain_material("plain", {1, 1, 1})};
    Mesh& mesh = scene.meshes[0];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.positions[i] += glm::normalize(mesh.normals[i]) * static_cast<float>(offset);
    return scene;
}

/// A level surface in the shell covers what the shell's bottom does and no more than its top.
testing::AssertionResult has_no_holes(double level, double planted = 0) {
    Scene scene = prism_scene(make_sphere(1, 16, 10), even_texture(level));
    const float depth = scene.materials[0].depth;
    const Film film = take(render, scene, {"A", "Z", "hit.s"});
    const auto at = [&](double layer) {
        return take(render, moved_mesh(scene, (layer - 1) * depth), {"A"});
    };
    const Film bottom = at(0), top = at(1);
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            const bool drawn = value(film, "A", x, y) > 0;
            if (!drawn && value(bottom, "A", x, y) > 0)
                return testing::AssertionFailure() << "a hole at " << x << "," << y;
            if (drawn && value(top, "A", x, y) == 0)
                return testing::AssertionFailure() << "outside at " << x << "," << y;
            const double s = value(film, "hit.s", x, y);
            if (drawn && std::abs(1 - s - level + planted) > 0.01)
                return testing::AssertionFailure()
                       << "met at height " << 1 - s << " at " << x << "," << y;
        }
    return testing::AssertionSuccess();
}

TEST(Prisms, HaveNoHoles) {
    for (const double level : {0.0, 0.3, 0.9}) EXPECT_TRUE(has_no_holes(level)) << level;
    EXPECT_FALSE(has_no_holes(0.5, 0.05));
}

/// Pixels that one film covers alone, or where both are further apart than `near`.
int pixels_apart(const Film& a, const Film& b, double near) {
    int apart = 0;
    for (int y = 0; y < prism_size; ++y)
        for (int x = 0; x < prism_size; ++x) {
            const bool in_a = value(a, "A", x, y) > 0, in_b = value(b, "A", x, y) > 0;
            apart += in_a != in_b ||
                     (in_a && !(std::abs(value(a, "Z", x, y) - value(b, "Z", x, y)) <= near));
        }
    return apart;
}

TEST(Prisms, WithoutReliefAreTheMesh) {
    for (const Mesh& mesh : {make_sphere(1, 12, 8), make_torus(0.3, 0.7)}) {
        Scene scene = prism_scene(mesh, even_texture(1));
        const Film plain = take(render, moved_mesh(scene, 0), {"A", "Z"});
        EXPECT_EQ(pixels_apart(take(render, scene, {"A", "Z"}), plain, 1e-4), 0);
        EXPECT_GT(pixels_apart(take(render, moved_mesh(scene, -0.02), {"A", "Z"}), plain, 1e-4), 9);
        for (const float seat : {0.0f, 0.5f, 1.0f}) {
            scene.materials[0].depth = 0;
            scene.materials[0].seat = seat;
            EXPECT_EQ(pixels_apart(take(render, scene, {"A", "Z"}), plain, 1e-6), 0);
        }
    }
}

/// Over a plane a prism's texture space is affine: its ray is that of its tetrahedra.
TEST(Prisms, OverAPlaneAreTheirTetrahedra) {
    Scene scene = prism_scene(make_quad(1.5, 3, 2), bump_texture());
    scene.materials[0].trace.parameters["steps"] = 400;
    scene.materials[0].trace.parameters["most"] = 4000;
    const std::vector<std::string> channels = {"A", "Z"};
    const Film film = take(render, scene, channels);
    scene.materials[0].frame.id = "frame-shell";
    scene.materials[0].trace.id = "prism-exact";
    scene.materials[0].trace.parameters.clear();
    const Film exact = take(render, scene, channels);
    const int few = prism_size * prism_size / 200;
    EXPECT_LE(pixels_apart(film, exact, 1e-3), few);
    scene.materials[0].depth *= 1.1f;
    EXPECT_GT(pixels_apart(film, take(render, scene, channels), 1e-3), 10 * few);
}

/// Over a curved mesh a straight chord is off by less the finer the mesh.
TEST(Prisms, ComeNearTetrahedraOnFineMeshes) {
    if (test::sanitized) GTEST_SKIP() << "of so few pixels none tells";
    const auto apart = [](int slices) {
        const Mesh mesh = make_sphere(1, slices, slices * 2 / 3);
        const std::vector<std::string> channels = {"A", "Z"};
        Scene scene = prism_scene(mesh, bump_texture());
        scene.materials[0].trace.parameters["steps"] = 200;
        const Film film = take(render, scene, channels);
        scene = scene_of_shell(mesh, "frame-shell", "prism-exact", bump_texture(), prism_size);
        return pixels_apart(film, take(render, scene, channels), 0.01);
    };
    const int coarse = apart(9), fine = apart(36);
    EXPECT_LT(2 * fine, coarse);
}

// ---- The listing --------------------------------------------------------------------------------

/// A cube whose sides are the whole texture, as in the source: where the listing is right, the
/// corrected search is near it.
TEST(Prisms, OfTheListingStandOnTheMesh) {
    Scene scene = scene_of_shell(make_cube(1), "frame-prism@published", "prism-gs@published",
                                 even_texture(0.5), prism_size);
    scene.materials[0].seat = 0;
    const Film listed = take(render, scene, {"A", "Z", "hit.s"});
    scene.materials[0].frame.id = "frame-prism";
    scene.materials[0].trace.id = "prism-gs";
    const Film corrected = take(render, scene, {"A", "Z", "hit.s"});
    int both = 0, near = 0;
    for (int y = 0; y < prism_size; ++y)
        for (int x = 0; x < prism_size; ++x) {
            if (value(listed, "A", x, y) == 0 || value(corrected, "A", x, y) == 0) continue;
            ++both;
            near += std::abs(value(listed, "Z", x, y) - value(corrected, "Z", x, y)) < 0.01;
        }
    EXPECT_GT(both, prism_size * prism_size / 12);
    EXPECT_GT(near, both * 3 / 4);
}

// ---- From within --------------------------------------------------------------------------------

/// What rendering is refused with, or nothing.
std::string refusal_of(const Scene& scene) {
    try {
        take(render, scene, {"A"});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Prisms, AreNotSeenFromWithin) {
    for (const auto& [frame, trace] :
         {std::pair("frame-shell", "prism-exact"), std::pair("frame-prism", "prism-gs")}) {
        Scene scene = scene_of_shell(make_sphere(1, 16, 10), frame, trace, bump_texture(), 16);
        EXPECT_EQ(refusal_of(scene), "");
        for (const double height : {0.85, 0.95}) {
            set_perspective_camera(scene, {0, 0, height}, {.near = 1e-3, .far = 20});
            const std::string refusal = refusal_of(scene);
            EXPECT_NE(refusal.find("camera"), std::string::npos) << refusal;
            EXPECT_NE(refusal.find("object 0"), std::string::npos) << refusal;
            EXPECT_NE(refusal.find("outside of shells"), std::string::npos) << refusal;
        }
        // Outside, and with a near plane that cuts the shell in half.
        set_perspective_camera(scene, {0, 0, 1.2}, {.near = 1e-3, .far = 20});
        EXPECT_EQ(refusal_of(scene), "");
        set_perspective_camera(scene, {0, 0, 1.2}, {.near = 0.3, .far = 20});
        EXPECT_NE(refusal_of(scene), "");
        // Within the hollow that the shell encloses, and behind it.
        set_perspective_camera(scene, {0, 0, 0.1}, {.near = 1e-3, .far = 20});
        EXPECT_EQ(refusal_of(scene), "");
        set_perspective_camera(scene, {0, 0, 9}, {.near = 7, .far = 20});
        EXPECT_EQ(refusal_of(scene), "");
        scene.materials[0].depth = 0;
        set_perspective_camera(scene, {0, 0, 0.95}, {.near = 1e-3, .far = 20});
        EXPECT_EQ(refusal_of(scene), "");
    }
}

}  // namespace
}  // namespace quadrel::render_tests
