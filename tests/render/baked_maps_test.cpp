// Maps that a stage asks for are derived from the material's heights, under the wrap modes that
// these are sampled with; what would take too long is refused.
#include <cstdlib>

#include "effort.hpp"
#include "quadrel/scene/load.hpp"
#include "render/films.hpp"
#include "scene/support.hpp"

namespace quadrel::render_tests {
namespace {

/// The scene of rows, traced by `trace` with the height map's wrap modes changed.
Scene row_scene(const std::string& trace, Wrap wrap) {
    setenv("QUADREL_CACHE_MIB", "0", 1);
    Scene scene = load_scene("rows/linear");
    if (test::sanitized) scene.width = scene.height = 32;
    Material& material = scene.materials.at(0);
    material.trace.id = trace;
    material.trace.parameters.clear();
    SamplerState& sampler = material.textures.at("height").sampler;
    sampler.wrap_u = sampler.wrap_v = wrap;
    return scene;
}

Film hits(const Scene& scene) {
    RenderOptions options;
    options.isa = "scalar";
    options.channels = {"hit.s", "hit.h", "hit.status", "hit.flags"};
    return render(scene, options);
}

/// Searches that read baked maps hit what the search without one does.
testing::AssertionResult hits_as_without_maps(const std::string& trace, Wrap wrap,
                                              Wrap wrap_without) {
    if (hits(row_scene(trace, wrap)) == hits(row_scene("texel-exact", wrap_without)))
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << trace << ", wrap mode " << static_cast<int>(wrap);
}

TEST(BakedMaps, FitTheHeightsAndTheirSampler) {
    for (const char* trace : {"max-mip", "cone-cell", "rmq-leap"}) {
        for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge,
                                Wrap::clamp_to_border, Wrap::mirror_once}) {
            EXPECT_TRUE(hits_as_without_maps(trace, wrap, wrap));
        }
        EXPECT_FALSE(hits_as_without_maps(trace, Wrap::repeat, Wrap::clamp_to_border));
    }
}

TEST(BakedMaps, ThatTakeTooLongAreRefused) {
    const auto render_cones_of = [](const char* file) {
        Scene scene = row_scene("cone-step", Wrap::repeat);
        TextureReference& height = scene.materials.at(0).textures.at("height");
        height.file = std::filesystem::path(QUADREL_DATA_DIR) / "textures" / file;
        height.key = "textures.height";
        hits(scene);
    };
    const Complaint complaint{"textures.height", "512 x 512 texels", "quadrel bake "};
    EXPECT_TRUE(complains([&] { render_cones_of("bricks_height.exr"); }, complaint));
    EXPECT_FALSE(complains([&] { render_cones_of("obstacles_height.exr"); }, complaint));
}

}  // namespace
}  // namespace quadrel::render_tests
