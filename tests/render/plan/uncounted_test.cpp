// Exact searches take other steps where no one counts them; only the counts may show it.
#include <random>

#include "built_isas.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

constexpr std::array searches{"max-mip",  "qdm", "pyramid",    "cone-cell",
                              "rmq-leap", "ddm", "texel-exact"};

/// A relief seen at an angle, its map of some size, wrap modes and range of heights.
Scene exact_scene(std::mt19937& random) {
    Scene scene = empty_scene(18, 12);
    set_perspective_camera(scene, {0.4, 0.5, 2.5}, {.near = 0.5, .far = 50});
    scene.lights = {directional_light({1, 0.4f, 0.3f})};
    scene.materials = {relief_material("relief", false)};
    Material& material = scene.materials[0];
    material.trace = stage(searches[random() % searches.size()], material.trace.key);
    material.shadow = stage("shadow-exact", material.shadow.key);
    material.seat = static_cast<float>(random() % 5) / 4;
    const int side = std::array{1, 2, 7, 16, 32, 19}[random() % 6];
    const double top = random() % 3 ? 1 : 0.4;
    TextureReference& map = material.textures["height"];
    map = texture(write_texture(fmt::format("exact{}_{}.exr", side, top), side,
                                [&](int x, int y, int) { return top * noise(x, y, 3); }),
                  "r");
    map.sampler.wrap_u = static_cast<Wrap>(random() % 5);
    map.sampler.wrap_v = random() % 2 ? map.sampler.wrap_u : static_cast<Wrap>(random() % 5);
    map.sampler.border[0] = static_cast<float>(random() % 3) / 2;
    add_object(scene, make_quad(3), 0, rotation(-double(random() % 85), {1, 0, 0}));
    return scene;
}

/// The `i`th of the lane sets, or doubles.
RenderOptions options_for(int i, std::vector<std::string> channels) {
    const std::vector<std::string> isas = built_isas();
    RenderOptions options;
    options.channels = std::move(channels);
    options.number = i % 5 == 4 ? "double" : "float";
    options.isa = i % 5 == 4 ? "scalar" : isas[unsigned(i) % isas.size()];
    return options;
}

testing::AssertionResult is_as_without_skipping(const Renderer& renderer, bool counts) {
    std::mt19937 random(21);
    for (int i = 0; i < 36; ++i) {
        const Scene scene = exact_scene(random);
        RenderOptions options =
            options_for(i, counts ? std::vector<std::string>{"hit.s", "hit.steps", "hit.fetches"}
                                  : channels_without_counts(scene));
        const Film found = renderer(scene, options);
        options.skip = false;
        auto same = same_bits(render(scene, options), found);
        if (!same) return same << ", " << scene.materials[0].trace.id << ", round " << i;
    }
    return testing::AssertionSuccess();
}

TEST(Uncounted, ExactSearchesHaveTheSameHits) {
    EXPECT_TRUE(is_as_without_skipping(render, false));
    EXPECT_FALSE(is_as_without_skipping(
        [](Scene scene, const RenderOptions& options) {
            scene.materials[0].depth *= 1 + 0x1p-20f;
            return render(scene, options);
        },
        false));
}

TEST(Uncounted, CountsThatAreAskedForAreTheSources) {
    EXPECT_TRUE(is_as_without_skipping(render, true));
    // As if steps were asked for and not counted.
    EXPECT_FALSE(is_as_without_skipping(
        [](const Scene& scene, RenderOptions options) {
            Film film = render(scene, options);
            std::ranges::fill(film.planes[1].bits, 0u);
            return film;
        },
        true));
}

}  // namespace
}  // namespace quadrel::render_tests
