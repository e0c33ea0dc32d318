// Depth written by relief, and hits that are clipped away.
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

/// A plate of relief, seen at an angle, and a plain one that cuts through its slab.
Scene cut_scene(bool relief_first, int samples = 1, bool reversed_z = false) {
    Scene scene = empty_scene(33, 27);
    scene.samples = samples;
    set_perspective_camera(scene, {0.3, 0.5, 4}, {.near = 1, .far = 20, .reversed_z = reversed_z});
    scene.materials = {relief_material("relief", false), plain_material("plain", {0, 1, 0.5f})};
    scene.materials[0].frag_depth = stage("frag-depth", "materials.relief.relief.frag_depth");
    scene.lights = {Light()};
    const glm::dmat4 turned = rotation(25, {1, 0, 0});
    if (relief_first) add_object(scene, make_quad(2), 0, turned);
    add_object(scene, make_quad(1.5), 1, turned * translation({0.1, 0.1, -0.15}));
    if (!relief_first) add_object(scene, make_quad(2), 0, turned);
    return scene;
}

/// Every pixel shows the object whose depth, drawn alone, is nearer; the relief's depth is the one
/// of its hits.
testing::AssertionResult nearer_hit_wins(const Renderer& renderer, const Scene& scene) {
    const std::vector<std::string> channels{"A", "depth", "frag.depth", "id.object", "R", "Z"};
    const Film film = take(renderer, scene, channels);
    const Film first = take(render, only(scene, 0), channels);
    const Film second = take(render, only(scene, 1), channels);
    const bool reversed = scene.camera.reversed_z;
    const auto depth = [&](const Film& of, int x, int y) {
        if (value(of, "A", x, y) == 0) return reversed ? -1.0f : 2.0f;
        const std::size_t object = bits(of, "id.object", x, y);
        return value(of, scene.objects[object].material == 0 ? "frag.depth" : "depth", x, y);
    };
    const auto either = [&](int x, int y) {
        return value(first, "A", x, y) > 0 || value(second, "A", x, y) > 0;
    };
    return everywhere(film, either, [&](int x, int y) {
        const float a = depth(first, x, y), b = depth(second, x, y);
        const bool first_wins = reversed ? a >= b : a <= b;
        const auto shown =
            differs("id.object", bits(film, "id.object", x, y), first_wins ? 0 : 1, 0);
        return shown.empty() ? differs("depth", value(film, "depth", x, y), first_wins ? a : b, 0)
                             : shown;
    });
}

/// render() that forgets the relief's depth.
Film without_depth(Scene scene, const RenderOptions& options) {
    for (Material& material : scene.materials) material.frag_depth = {};
    return render(scene, options);
}

TEST(FragDepth, TheNearerHitIsSeen) {
    for (const bool relief_first : {true, false})
        for (const bool reversed : {true, false})
            EXPECT_TRUE(nearer_hit_wins(render, cut_scene(relief_first, 1, reversed)));
    EXPECT_FALSE(nearer_hit_wins(without_depth, cut_scene(true)));
}

TEST(FragDepth, OrderDoesNotMatter) {
    const std::vector<std::string> channels{"R", "G", "B", "A", "Z", "uv", "depth", "dPdx"};
    for (const int samples : {1, 4})
        EXPECT_TRUE(same_bits(take(render, cut_scene(true, samples), channels),
                              take(render, cut_scene(false, samples), channels)));
}

/// Inset relief is never nearer than its polygon.
TEST(FragDepth, InsetReliefIsBehindItsPolygon) {
    const Scene scene = only(cut_scene(true), 0);
    const Film film = take(render, scene, {"A", "depth"});
    const Film polygon = take(without_depth, scene, {"A", "depth"});
    EXPECT_TRUE(everywhere(film, covered(film), [&](int x, int y) {
        const float hit = value(film, "depth", x, y), plane = value(polygon, "depth", x, y);
        return hit >= plane - 1e-6f ? std::string() : fmt::format("{} before {}", hit, plane);
    }));
}

/// Flat relief of height h lies where a plate (1 - h) D further down lies.
testing::AssertionResult flat_relief_is_a_plate(const Renderer& renderer) {
    Scene scene = only(cut_scene(true), 0);
    scene.materials[0].textures["height"] =
        texture(write_texture("flat-quarter.exr", 4, [](int, int, int) { return 0.25; }));
    scene.materials[0].textures["height"].swizzle = "r";
    scene.materials[0].trace.parameters["steps"] = 16;
    Scene plate = scene;
    plate.materials[0] = plain_material("plate");
    plate.objects[0].transform =
        plate.objects[0].transform * glm::mat4(translation({0, 0, -0.75 * 0.3}));
    const Film film = take(renderer, scene, {"A", "depth"});
    const Film expected = take(render, plate, {"A", "depth"});
    const auto both = [&](int x, int y) {
        return value(film, "A", x, y) > 0 && value(expected, "A", x, y) > 0;
    };
    return everywhere(film, both, [&](int x, int y) {
        return differs("depth", value(film, "depth", x, y), value(expected, "depth", x, y), 3e-5);
    });
}

TEST(FragDepth, FlatReliefIsAPlateFurtherDown) {
    EXPECT_TRUE(flat_relief_is_a_plate(render));
    EXPECT_FALSE(flat_relief_is_a_plate(without_depth));
}

// ---- Clipping -----------------------------------------------------------------------------------

/// `whole`: clipped to the polygon's own footprint, else to a part of it.
Scene clipped_scene(const std::string& id, bool whole, float seat = 1) {
    Scene scene = cut_scene(true);
    scene.materials[0].frag_depth = {};
    scene.materials[0].seat = seat;
    scene.materials[0].clip = stage(id, "materials.relief.relief.clip");
    if (!whole) scene.materials[0].clip.parameters = {{"u_min", 0.1}, {"v_max", 0.8}};
    return scene;
}

Film without_clip(Scene scene, const RenderOptions& options) {
    for (Material& material : scene.materials) material.clip = {};
    return render(scene, options);
}

/// Fragments whose hit is outside of the rectangle are gone, the others keep their bits.
testing::AssertionResult clips_hits(const Renderer& renderer, const Scene& scene, bool whole) {
    const float u_min = whole ? 0.0f : 0.1f, v_max = whole ? 1.0f : 0.8f;
    const std::vector<std::string> channels{"R", "A", "hit", "dUVdx", "id.object"};
    const Film film = take(renderer, scene, channels);
    const Film all = take(without_clip, only(scene, 0), channels);
    const Film behind = take(render, only(scene, 1), channels);
    const auto outside = [&](int x, int y) {
        return value(all, "A", x, y) > 0 &&
               (value(all, "hit.U", x, y) < u_min || value(all, "hit.U", x, y) > 1 ||
                value(all, "hit.V", x, y) < 0 || value(all, "hit.V", x, y) > v_max);
    };
    const auto inside = [&](int x, int y) { return value(all, "A", x, y) > 0 && !outside(x, y); };
    if (auto kept = same_bits(all, film, inside); !kept) return kept << ", inside";
    if (auto seen = same_bits(behind, film, outside); !seen) return seen << ", outside";
    return everywhere(film, outside, [](int, int) { return std::string(); });
}

TEST(Clip, HitsOutsideOfTheRectangleAreGone) {
    EXPECT_TRUE(clips_hits(render, clipped_scene("clip-uv", false), false));
    EXPECT_TRUE(clips_hits(render, clipped_scene("clip-uv", true), true));
    EXPECT_TRUE(clips_hits(render, clipped_scene("clip-path", true), true));
    EXPECT_FALSE(clips_hits(without_clip, clipped_scene("clip-uv", false), false));
}

/// Above its polygon a ray that enters through the side is clipped by its path alone.
TEST(Clip, ThePathCountsWhereReliefRises) {
    const auto covered_pixels = [](const std::string& id, float seat) {
        Scene scene = only(clipped_scene(id, true, seat), 0);
        scene.materials[0].depth = 1.5f;
        const Film film = take(render, scene, {"A"});
        int count = 0;
        for (int y = 0; y < film.window.y1; ++y)
            for (int x = 0; x < film.window.x1; ++x) count += value(film, "A", x, y) > 0;
        return count;
    };
    EXPECT_EQ(covered_pixels("clip-path", 1), covered_pixels("clip-uv", 1));
    EXPECT_LT(covered_pixels("clip-path", 0), covered_pixels("clip-uv", 0));
}

}  // namespace
}  // namespace quadrel::render_tests
