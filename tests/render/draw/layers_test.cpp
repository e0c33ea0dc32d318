// Searches of depth layers in a scene: a ray that meets nothing leaves its fragment to what is
// behind.
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr glm::vec3 layered_color{1.0f, 0.25f, 0.0f}, wall_color{0.0f, 1.0f, 0.5f};

bool is_empty_texel(int x, int y) { return (((x % 16) / 4) + ((y % 16) / 4)) % 2 != 0; }

/// Front and back of one solid, which every other square of 4 x 4 texels lacks.
TextureReference squares_texture() {
    TextureReference reference = texture(write_texture("squares.exr", 16, [](int x, int y, int c) {
        const double half = is_empty_texel(x, y) ? 0 : 0.25;
        return c == 0 ? 0.5 - half : c == 1 ? 0.5 + half : 1.0;
    }));
    reference.sampler.mip = MipFilter::none;
    return reference;
}

/// A plate of layers before a wall, both seen from the front.
Scene layered_scene(const std::string& trace, int samples = 1) {
    Scene scene = empty_scene(24, 18);
    scene.samples = samples;
    set_pixel_camera(scene);
    scene.materials = {plain_material("layered", layered_color),
                       plain_material("wall", wall_color)};
    Material& layered = scene.materials[0];
    layered.frame.id = "frame-gram";
    layered.trace.id = trace;
    layered.depth = 0.5f;
    layered.textures["layers"] = squares_texture();
    add_object(scene, rectangle(-9.3f, -6.7f, 9.1f, 6.9f, -2), 0);
    add_object(scene, rectangle(-12, -4.6f, 12, 8.2f, -3), 1);
    return scene;
}

/// Whether a ray straight down at a texture coordinate meets nothing: none of the texels around has
/// any thickness.
bool is_empty_place(float u, float v) {
    const int x = static_cast<int>(std::floor(u * 16 - 0.5f)) + 16;
    const int y = static_cast<int>(std::floor(v * 16 - 0.5f)) + 16;
    return is_empty_texel(x, y) && is_empty_texel(x + 1, y) && is_empty_texel(x, y + 1) &&
           is_empty_texel(x + 1, y + 1);
}

/// `whole`: the search finds all that is not empty, however thin.
testing::AssertionResult misses_show_what_is_behind(const Renderer& renderer,
                                                    const std::string& trace, bool whole = true) {
    const std::vector<std::string> channels = {"R", "G", "B", "A", "Z", "id.object"};
    const Film film = take(renderer, layered_scene(trace), channels);
    const Film plate = take(render, only(layered_scene("none"), 0), {"A", "uv"});
    const Film behind = take(render, only(layered_scene(trace), 1), channels);
    const auto at_plate = covered(plate);
    const auto empty = [&](int x, int y) {
        return at_plate(x, y) &&
               is_empty_place(value(plate, "uv.U", x, y), value(plate, "uv.V", x, y));
    };
    if (auto seen = same_bits(behind, film, empty); !seen) return seen << ", where nothing is";
    const auto solid = [&](int x, int y) { return at_plate(x, y) && !empty(x, y); };
    if (!whole) return testing::AssertionSuccess();
    return everywhere(film, solid, [&](int x, int y) {
        return differs("R", value(film, "R", x, y), layered_color.x, 0) +
               differs("id.object", bits(film, "id.object", x, y), 0, 0);
    });
}

TEST(Layers, MissesShowWhatIsBehind) {
    for (const char* trace : {"dual-depth-exact", "multilayer-exact"})
        EXPECT_TRUE(misses_show_what_is_behind(render, trace)) << trace;
    for (const char* trace : {"dual-depth", "multilayer", ""})
        EXPECT_TRUE(misses_show_what_is_behind(render, trace, false)) << trace;
    EXPECT_FALSE(misses_show_what_is_behind(render, "dual-depth")) << "thin rims";
    EXPECT_FALSE(misses_show_what_is_behind(render, "none")) << "nothing discarded";
    EXPECT_FALSE(misses_show_what_is_behind(render, "dual-depth@published")) << "has no misses";
}

/// A clipping stage of the material's own takes nothing from that, nor adds to it here.
TEST(Layers, ClippingGoesTogetherWithMisses) {
    Scene scene = layered_scene("multilayer-exact");
    const Film plain = take(render, scene, {"R", "A", "id.object"});
    scene.materials[0].clip = stage("clip-uv", "clip");
    EXPECT_TRUE(same_bits(plain, take(render, scene, {"R", "A", "id.object"})));
}

/// All samples of a fragment go or stay, with the depth of the hit where that is written.
TEST(Layers, SamplesAndDepths) {
    Scene scene = only(layered_scene("multilayer-exact", 4), 0);
    scene.materials[0].frag_depth = stage("frag-depth", "frag_depth");
    const Film film = take(render, scene, {"A", "Z"});
    const Film whole = take(render, only(layered_scene("none", 4), 0), {"A", "uv"});
    int hits = 0;
    EXPECT_TRUE(everywhere(whole, covered(whole), [&](int x, int y) {
        const float u = value(whole, "uv.U", x, y), v = value(whole, "uv.V", x, y);
        if (u < 0 || v < 0 || u >= 1 || v >= 1) return std::string();  // wraps around
        const bool empty = is_empty_place(u, v);
        hits += !empty;
        return differs("A", value(film, "A", x, y), empty ? 0.0f : value(whole, "A", x, y), 0);
    }));
    EXPECT_GT(hits, 50);
}

/// Drawn by chains and shortcuts or without them.
TEST(Layers, SkippingKeepsTheBits) {
    for (const char* trace : {"dual-depth", "multilayer-exact"}) {
        Scene scene = layered_scene(trace);
        scene.lights = {Light()};
        scene.materials[0].surface.id = "h2n-layers";
        scene.materials[0].shadow.id = "shadow-layers-exact";
        RenderOptions every_step;
        every_step.skip = false;
        EXPECT_TRUE(same_bits(render(scene, {}), render(scene, every_step))) << trace;
    }
}

}  // namespace
}  // namespace quadrel::render_tests
