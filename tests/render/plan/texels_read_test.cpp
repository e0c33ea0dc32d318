// Mip levels and channels that nothing can read are not made, and no bit shows it.
#include "render/plan/texels_read.hpp"

#include "quadrel/stats.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

using testing::AssertionResult;

/// A relief whose maps are so much minified that all levels matter.
Scene far_scene(const std::string& trace, const std::string& surface) {
    Scene scene = empty_scene(24, 18);
    set_perspective_camera(scene, {0.4, 0.5, 14}, {.near = 0.5, .far = 50});
    scene.lights = {directional_light({1, 0.4f, 0.3f})};
    scene.materials = {relief_material("relief", false)};
    Material& material = scene.materials[0];
    material.textures["height"] = texture(write_texture("levels.exr", 32, noise), "g");
    material.trace = stage(trace, "trace");
    material.surface = stage(surface, "surface");
    material.shadow = stage("shadow-exact", "shadow");
    material.texture_matrix = glm::mat4(scaling({5, 4, 1}));
    add_object(scene, make_quad(9, 7), 0, rotation(-50, {1, 0, 0}));
    return scene;
}

/// Levels of the textures that a render loads, by slot.
std::map<std::string, int> levels_of(const Scene& scene, RenderOptions options) {
    RenderStats stats;
    options.stats = &stats;
    render(scene, options);
    std::map<std::string, int> levels;
    for (const TextureStats& texture : stats.textures) levels[texture.slot] = texture.levels;
    return levels;
}

/// That skipping leaves the bits as they are. `limit` changes the scene that is rendered so.
AssertionResult keeps_bits(const Scene& scene, RenderOptions options,
                           const std::function<void(Scene&)>& limit) {
    Scene limited = scene;
    limit(limited);
    const Film found = render(limited, options);
    options.skip = false;
    return same_bits(render(scene, options), found);
}

void as_it_is(Scene&) {}

/// What a wrong list would do.
void finest_level_of_heights(Scene& scene) {
    scene.materials[0].textures["height"].mip_rule = MipRule::none;
}

TEST(TexelsRead, SearchesOfTexelsHaveTheFinestAlone) {
    RenderOptions options;
    options.channels = {"hit", "N", "shadow.visibility"};
    for (const char* trace : {"texel-exact", "max-mip", "cone-cell", "rmq-leap", "ddm", "qdm"}) {
        const Scene scene = far_scene(trace, "h2n-patch");
        EXPECT_EQ(levels_of(scene, options)["height"], 1) << trace;
        EXPECT_TRUE(keeps_bits(scene, options, as_it_is)) << trace;
    }
    const Scene slopes = far_scene("texel-exact", "h2n-thesis");
    EXPECT_GT(levels_of(slopes, options)["height"], 1) << "another stage reads levels";
    EXPECT_FALSE(keeps_bits(slopes, options, finest_level_of_heights)) << "planted: it has none";
    const Scene march = far_scene("linear", "h2n-patch");
    EXPECT_GT(levels_of(march, options)["height"], 1);
    EXPECT_FALSE(keeps_bits(march, options, finest_level_of_heights)) << "planted: it has none";
    options.skip = false;
    EXPECT_GT(levels_of(far_scene("texel-exact", "h2n-patch"), options)["height"], 1);
}

TEST(TexelsRead, SamplersWithoutMipsHaveTheFinestAlone) {
    for (const int samples : {1, 4}) {
        Scene scene = varied_scene(samples);
        for (Material& material : scene.materials)
            for (auto& [slot, reference] : material.textures)
                reference.sampler.mip = MipFilter::none;
        RenderOptions options;
        options.channels = all_channels(scene);
        for (const auto& [slot, levels] : levels_of(scene, options))
            EXPECT_EQ(levels == 1, slot != "environment") << slot;
        EXPECT_TRUE(keeps_bits(scene, options, as_it_is));
    }
}

/// Channels of the gloss map that a render loads.
int gloss_channels(const Scene& scene, RenderOptions options) {
    RenderStats stats;
    options.stats = &stats;
    render(scene, options);
    for (const TextureStats& texture : stats.textures)
        if (texture.slot == "gloss") return texture.channels;
    return 0;
}

TEST(TexelsRead, AnExponentIsTheFirstChannelOfGloss) {
    RenderOptions options;
    Scene scene = far_scene("linear", "h2n-thesis");
    scene.materials[0].textures["gloss"] = texture(write_texture("gloss.exr", 8, noise));
    for (const char* shade : {"shade-phong", "shade-blinn-phong", "shade-cook-torrance"}) {
        scene.materials[0].shade = stage(shade, "shade");
        EXPECT_EQ(gloss_channels(scene, options), 1) << shade;
        EXPECT_TRUE(keeps_bits(scene, options, as_it_is)) << shade;
    }
    const auto first_channel = [](Scene& s) { s.materials[0].textures["gloss"].swizzle = "r"; };
    scene.materials[0].shade = stage("shade-thesis", "shade");
    EXPECT_EQ(gloss_channels(scene, options), 4);
    EXPECT_FALSE(keeps_bits(scene, options, first_channel)) << "planted: it reads all";
}

/// Of two materials that take one texture, one needs all levels.
TEST(TexelsRead, NoTextureIsMadeTwiceForThem) {
    Scene scene = varied_scene();
    scene.materials[3].textures["color"] = scene.materials[0].textures["color"];
    render(scene, {});
    const std::uint64_t alike = scene.texture_cache->made();
    scene.materials[3].textures["color"].sampler.mip = MipFilter::none;
    scene.texture_cache = std::make_shared<TextureCache>();
    render(scene, {});
    EXPECT_EQ(scene.texture_cache->made(), alike);
}

TEST(TexelsRead, AreSaidToBeLeftOut) {
    const Scene scene = far_scene("texel-exact", "h2n-patch");
    RenderOptions options;
    options.channels = {"hit"};
    EXPECT_NE(explain(scene, options).find("leaves out levels of height but the finest"),
              std::string::npos);
    options.skip = false;
    EXPECT_EQ(explain(scene, options).find("leaves out levels"), std::string::npos);
}

}  // namespace
}  // namespace quadrel::render_tests
