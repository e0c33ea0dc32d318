// Discarded fragments are demoted: they take part in derivatives and write nothing.
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr glm::vec3 behind_color{0.0f, 1.0f, 0.5f};

/// A plate with holes in front of (or, at `gap` 0, in) the plane of a solid one.
Scene plate_scene(float gap, bool plate_first, int samples = 1) {
    Scene scene = empty_scene(24, 18);
    scene.samples = samples;
    set_pixel_camera(scene);
    scene.materials = {plain_material("holes", {1.0f, 0.25f, 0.0f}),
                       plain_material("solid", behind_color)};
    scene.materials[0].textures["color"] = holes_texture();
    scene.materials[0].discard_below = 0.5f;
    const Mesh plate = rectangle(-9.3f, -6.7f, 9.1f, 6.9f, -3 + gap);
    const Mesh solid = rectangle(-12, -4.6f, 12, 8.2f, -3);
    if (plate_first) add_object(scene, plate, 0);
    add_object(scene, solid, 1);
    if (!plate_first) add_object(scene, plate, 0);
    return scene;
}

Scene solid_plate(Scene scene) {
    scene.materials[0].discard_below = -1;
    return scene;
}

/// Alpha of the colour map at a texture coordinate.
bool is_hole(float u, float v) {
    const int x = static_cast<int>(std::floor(u * 16)), y = static_cast<int>(std::floor(v * 16));
    return (x / 4 + y / 4) % 2 != 0;
}

const std::vector<std::string> derived = {"uv", "dUVdx", "dUVdy", "dPdx", "lod", "P", "bary", "N"};

/// Against the same scene with nothing discarded: covered fragments outside of the holes keep their
/// bits, derivatives included, and holes show what the plate hides.
testing::AssertionResult shows_through_holes(const Renderer& renderer, const Scene& scene,
                                             std::size_t plate) {
    auto channels = derived;
    channels.insert(channels.end(), {"R", "G", "B", "A", "Z", "id.object", "depth"});
    const Film film = take(renderer, scene, channels);
    const Film solid = take(render, solid_plate(scene), channels);
    const Film behind = take(render, only(scene, 1 - plate), channels);
    const auto at_plate = [&](int x, int y) { return bits(solid, "id.object", x, y) == plate; };
    const auto hole = [&](int x, int y) {
        return at_plate(x, y) && is_hole(value(solid, "uv.U", x, y), value(solid, "uv.V", x, y));
    };
    if (auto kept = same_bits(solid, film, [&](int x, int y) { return !hole(x, y); }); !kept)
        return kept << ", outside of the holes";
    if (auto seen = same_bits(behind, film, hole); !seen) return seen << ", in a hole";
    return everywhere(film, hole, [](int, int) { return std::string(); });
}

/// The same objects in the other order; object indices follow.
testing::AssertionResult order_does_not_matter(const Renderer& renderer, float gap, int samples) {
    const auto channels = std::vector<std::string>{"R", "G", "B", "A", "Z", "uv", "depth"};
    return same_bits(take(renderer, plate_scene(gap, true, samples), channels),
                     take(renderer, plate_scene(gap, false, samples), channels));
}

/// In one plane the earlier object is seen, and a hole of an earlier plate lets the later through.
testing::AssertionResult earlier_wins_ties(const Renderer& renderer) {
    const Scene scenes[] = {plate_scene(0, true), plate_scene(0, false)};
    if (auto first = shows_through_holes(renderer, scenes[0], 0); !first) return first;
    const Film film = take(renderer, scenes[1], {"A", "id.object"});
    const Film solid = take(render, only(scenes[1], 0), {"A"});
    return everywhere(film, covered(solid), [&](int x, int y) {
        return differs("id.object", bits(film, "id.object", x, y), 0, 0);
    });
}

TEST(Discard, ShowsWhatIsBehind) {
    EXPECT_TRUE(shows_through_holes(render, plate_scene(1, true), 0));
    EXPECT_TRUE(shows_through_holes(render, plate_scene(1, false), 1));
}

TEST(Discard, OrderDoesNotMatterAtDifferentDepths) {
    for (const int samples : {1, 4}) {
        EXPECT_TRUE(order_does_not_matter(render, 1, samples));
        EXPECT_TRUE(order_does_not_matter(render, -1, samples));
    }
}

TEST(Discard, EarlierWinsAtEqualDepth) { EXPECT_TRUE(earlier_wins_ties(render)); }

TEST(Discard, ErrorsAreNoticed) {
    for (const Planted error :
         {Planted::nothing_discarded, Planted::discarded_writes_depth, Planted::discarded_helpers})
        EXPECT_FALSE(shows_through_holes(with(error), plate_scene(1, true), 0))
            << static_cast<int>(error);
    EXPECT_FALSE(earlier_wins_ties(with(Planted::later_wins_ties)));
    const Renderer order_bound = [](const Scene& scene, const RenderOptions& options) {
        return render_with(
            scene.objects[0].material == 0 ? Planted::nothing_discarded : Planted::none, scene,
            options);
    };
    EXPECT_FALSE(order_does_not_matter(order_bound, 1, 1));
}

/// Under multisampling a fragment is shaded once: all its samples go or stay.
TEST(Discard, TakesAllSamplesOfAFragment) {
    const Scene scene = only(plate_scene(1, true, 4), 0);
    const Film film = take(render, scene, {"A"});
    const Film solid = take(render, solid_plate(scene), {"A", "uv"});
    EXPECT_TRUE(everywhere(solid, covered(solid), [&](int x, int y) {
        const float u = value(solid, "uv.U", x, y), v = value(solid, "uv.V", x, y);
        if (u < 0 || v < 0 || u >= 1 || v >= 1) return std::string();  // wraps around
        const float kept = is_hole(u, v) ? 0.0f : value(solid, "A", x, y);
        return differs("A", value(film, "A", x, y), kept, 0);
    }));
}

/// Two plates with holes, one behind the other, in both orders.
TEST(Discard, PlatesBehindPlates) {
    const auto film = [](bool near_first) {
        Scene scene = plate_scene(1, true);
        scene.objects.pop_back();
        add_object(scene, rectangle(-10.1f, -7.3f, 8.7f, 7.9f, -2.5f), 0, rotation(30, {0, 0, 1}));
        if (!near_first) std::swap(scene.objects[0], scene.objects[1]);
        return take(render, scene, {"R", "A", "Z", "uv", "dUVdx", "dUVdy"});
    };
    EXPECT_TRUE(same_bits(film(true), film(false)));
}

}  // namespace
}  // namespace quadrel::render_tests
