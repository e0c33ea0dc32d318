// Scenes whose relief is warped: one warp a view; fragments show the warped image; what cannot be
// warped is refused.
#include "render/prewarp/prewarp.hpp"

#include <cmath>

#include "quadrel/error.hpp"
#include "quadrel/errors.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

Scene warped_scene() {
    Scene scene = empty_scene(32, 24);
    set_perspective_camera(scene, {0.3, -1.5, 2.5}, {});
    scene.materials = {relief_material("warped", false)};
    scene.materials[0].trace = stage("relief-prewarp", "materials.warped.relief.trace");
    scene.materials[0].depth = 0.2f;
    scene.materials[0].textures["height"].sampler.mip = MipFilter::none;
    scene.lights = {directional_light({1, 1, 2})};
    add_object(scene, make_quad(2, 3, 2), 0);
    return scene;
}

std::shared_ptr<const Texture> warp_of(const Scene& scene) {
    const TextureReference& height = scene.materials[0].textures.at("height");
    TextureOptions options;
    options.swizzle = height.swizzle;
    options.mip_rule = MipRule::none;
    return prewarp_for_view(scene, 0, *scene.texture_cache->load(height.file, options),
                            height.sampler, *scene.texture_cache);
}

TEST(Prewarp, IsMadeOnceAView) {
    Scene scene = warped_scene();
    const auto first = warp_of(scene);
    EXPECT_EQ(warp_of(scene), first);
    scene.lights[0].intensity = 2;
    EXPECT_EQ(warp_of(scene), first);
    scene.camera.view = glm::mat4(translation({0.01, 0, 0})) * scene.camera.view;
    const auto moved = warp_of(scene);
    EXPECT_NE(moved, first);
    scene.materials[0].depth = 0.21f;
    EXPECT_NE(warp_of(scene), moved);
}

/// Why a scene is refused; empty if it is not.
std::string refusal(const Scene& scene) {
    RenderOptions options;
    options.channels = {"hit.status"};
    try {
        render(scene, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Prewarp, TakesOnePlane) {
    EXPECT_EQ(refusal(warped_scene()), "");
    Scene scene = warped_scene();
    add_object(scene, make_quad(2), 0, translation({2, 0, 0.1}));
    EXPECT_NE(refusal(scene).find("several planes"), std::string::npos);
    scene.objects[1].visible = false;
    EXPECT_EQ(refusal(scene), "");
    scene = warped_scene();
    scene.meshes[0] = make_sphere();
    EXPECT_NE(refusal(scene).find("several planes"), std::string::npos);
    scene = warped_scene();
    scene.meshes[0].uvs[5].x += 0.1f;
    EXPECT_NE(refusal(scene).find("several planes or UV"), std::string::npos);
    scene = warped_scene();
    for (glm::vec2& uv : scene.meshes[0].uvs) uv = {0.5f, 0.5f};
    EXPECT_NE(refusal(scene).find("without"), std::string::npos);
    scene = warped_scene();
    scene.materials[0].fade_from = 10;
    EXPECT_NE(refusal(scene).find("grazing_fade"), std::string::npos);
    scene = warped_scene();
    scene.materials[0].texture_matrix[0][0] = 1e6f;
    EXPECT_NE(refusal(scene).find("at most 16777216"), std::string::npos);
}

/// Hits are those of the warped image at the fragment's place, and lie where they say.
TEST(Prewarp, FragmentsShowTheWarpedImage) {
    const Scene scene = warped_scene();
    const Film film = take(render, scene, {"A", "uv", "hit.s"});
    const auto warped = warp_of(scene);
    const TextureView& view = warped->view();
    int hits = 0;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            if (value(film, "A", x, y) == 0) continue;
            const double a = value(film, "uv.U", x, y) * view.width[0] - 0.5;
            const double b = value(film, "uv.V", x, y) * (view.height[0] - 1) - 0.5;
            const int i = static_cast<int>(std::floor(a)), j = static_cast<int>(std::floor(b));
            if (i < 0 || j < 0 || i + 1 >= view.width[0] || j + 2 >= view.height[0]) continue;
            double s = 0, weight = 0;
            for (int tap = 0; tap < 4; ++tap) {
                const double share = (tap % 2 ? a - i : i + 1 - a) * (tap / 2 ? b - j : j + 1 - b);
                const float* const texel =
                    view.texels + 4 * ((j + tap / 2) * view.width[0] + i + tap % 2);
                s += share * texel[2] * texel[3];
                weight += share * texel[3];
            }
            if (weight < 0.5) continue;
            ++hits;
            EXPECT_NEAR(value(film, "hit.s", x, y), s / weight, 1e-4);
        }
    EXPECT_GT(hits, 50);
}

/// The mean distance from the true hits, in texels, of pixels that are covered and judged; how many
/// there are.
std::pair<double, int> distance_from_the_truth(const Scene& scene) {
    const Film film = take(render, scene, {"A", "err.search.uv", "err.search.kind"});
    double sum = 0;
    int judged = 0;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            const auto kind = static_cast<ErrorKind>(bits(film, "err.search.kind", x, y));
            if (value(film, "A", x, y) == 0 || kind == ErrorKind::not_judged) continue;
            const float texels = value(film, "err.search.uv", x, y);
            if (!std::isfinite(texels)) continue;
            sum += texels;
            ++judged;
        }
    return {judged > 0 ? sum / judged : 0, judged};
}

/// What is covered is judged by the exact search of the same view.
TEST(Prewarp, IsJudgedByTheTruth) {
    Scene scene = warped_scene();
    const auto [warped, judged] = distance_from_the_truth(scene);
    EXPECT_GT(judged, 100);
    scene.materials[0].trace.id = "trace-none";
    const double undisplaced = distance_from_the_truth(scene).first;
    EXPECT_LT(warped, undisplaced / 3);
}

}  // namespace
}  // namespace quadrel::render_tests
