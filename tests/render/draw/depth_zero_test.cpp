// Relief of depth 0. The corrected stages leave plain texturing, bit for bit. The published march
// does not: its test is strict, so that over a flat top every ray takes one step of 1/128 world
// unit before it stops.
#include "quadrel/scene/load.hpp"
#include "render/planted.hpp"

namespace quadrel::render_tests {
namespace {

Scene small_scene(const std::string& name) { return load_scene(name, {"size=[26,19]"}); }

void set_depth_zero(Scene& scene) {
    for (Material& material : scene.materials) material.depth = 0;
}

void remove_relief(Scene& scene) {
    for (Material& material : scene.materials)
        for (StageChoice* choice :
             {&material.frame, &material.trace, &material.surface, &material.shadow}) {
            choice->id = "none";
            choice->parameters.clear();
        }
}

const std::vector<std::string> shown_channels = {"R", "G", "B",  "A",     "Z",     "depth",
                                                 "N", "P", "uv", "hit.P", "hit.U", "hit.V"};

testing::AssertionResult is_plain_texturing(const Renderer& renderer, const std::string& name) {
    Scene relief = small_scene(name), plain = relief;
    set_depth_zero(relief);
    remove_relief(plain);
    return same_bits(take(render, plain, shown_channels), take(renderer, relief, shown_channels))
           << ", " << name;
}

TEST(DepthZero, IsPlainTexturing) {
    for (const char* name : {"thesis-quad", "thesis-sphere", "thesis-torus", "thesis-teapot"})
        EXPECT_TRUE(is_plain_texturing(render, name));
    EXPECT_FALSE(is_plain_texturing(with(Planted::depth_zero_moves), "thesis-quad"));
}

/// The quad faces the camera, so its normal is +z in eye space.
testing::AssertionResult published_moves_one_step(const Renderer& renderer) {
    Scene scene = small_scene("thesis-quad-published");
    set_depth_zero(scene);
    const Film film = take(renderer, scene, {"A", "P", "uv", "K", "hit"});
    return everywhere(film, covered(film), [&](int x, int y) {
        const float step = 1.0f / 128;
        const auto at = [&](const char* channel) { return value(film, channel, x, y); };
        // Along the view ray until it is 1/128 below the plane; uv are 1/2 a unit of length.
        const float slope_x = at("P.X") / -at("P.Z"), slope_y = at("P.Y") / -at("P.Z");
        return differs("hit.P.Z", at("hit.P.Z"), at("P.Z") - step, 1e-6) +
               differs("hit.P.X", at("hit.P.X"), at("P.X") + slope_x * step, 1e-6) +
               differs("hit.U", at("hit.U"), at("uv.U") + slope_x * step / 2, 1e-4) +
               differs("hit.V", at("hit.V"), at("uv.V") + slope_y * step / 2, 1e-4) +
               differs("hit.steps", bits(film, "hit.steps", x, y), 2, 0) +
               differs("hit.s", at("hit.s"), std::numeric_limits<double>::infinity(), 0) +
               differs("K.U", at("K.U"), 0, 0);
    });
}

TEST(DepthZero, PublishedMarchMovesOneStep) {
    EXPECT_TRUE(published_moves_one_step(render));
    const Renderer corrected = [](Scene scene, const RenderOptions& options) {
        scene.materials[0].trace.id = "linear";
        return render(scene, options);
    };
    EXPECT_FALSE(published_moves_one_step(corrected));
}

}  // namespace
}  // namespace quadrel::render_tests
