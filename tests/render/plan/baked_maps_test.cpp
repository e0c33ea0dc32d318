// Maps that a stage asks for are derived from the material's heights, under the wrap modes that
// these are sampled with; what is hopeless is refused.
#include <cstdlib>

#include "effort.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/scene/load.hpp"
#include "render/films.hpp"
#include "render/plan/textures.hpp"
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
    for (const char* trace : {"max-mip", "cone-cell", "rmq-leap", "ddm"}) {
        for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge,
                                Wrap::clamp_to_border, Wrap::mirror_once}) {
            EXPECT_TRUE(hits_as_without_maps(trace, wrap, wrap));
        }
        EXPECT_FALSE(hits_as_without_maps(trace, Wrap::repeat, Wrap::clamp_to_border));
    }
}

/// A map that takes minutes on any machine is refused at once, by the name of what has to be baked.
TEST(BakedMaps, ThatAreHopelessAreRefused) {
    const testing_films::TemporaryFolder folder;
    Film heights{{0, 0, 4096, 2048}, {0, 0, 4096, 2048}, {}};
    heights.add("Y", ChannelType::float32);
    write_exr(folder / "large map.exr", heights, {});
    const auto render_cones_of = [](const std::filesystem::path& file) {
        Scene scene = row_scene("relaxed-cone", Wrap::repeat);
        TextureReference& height = scene.materials.at(0).textures.at("height");
        height.file = file;
        height.key = "textures.height";
        hits(scene);
    };
    const Complaint complaint{"textures.height", "4096 x 2048 texels", "quadrel bake '"};
    EXPECT_TRUE(complains([&] { render_cones_of(folder / "large map.exr"); }, complaint));
    const auto small = std::filesystem::path(QUADREL_DATA_DIR) / "textures/spikes_height.exr";
    EXPECT_FALSE(complains([&] { render_cones_of(small); }, complaint));
}

/// Who waits is told what for.
TEST(BakedMaps, TellHowFarTheyAre) {
    const Scene scene = row_scene("cone-cell", Wrap::repeat);
    RenderOptions options;
    options.isa = "scalar";
    options.channels = {"hit.s"};
    std::string made;
    double last = 0;
    options.baking = [&](const std::string& map, double share) {
        EXPECT_GE(share, last);
        made = map;
        last = share;
    };
    render(scene, options);
    EXPECT_EQ(made, "cone-cell map");
    EXPECT_EQ(last, 1);
}

using Slots = std::vector<TextureSlot>;
using Load = std::function<MaterialTextures(const Scene&, const Slots&, TextureCache&,
                                            const BakingListener&)>;

MaterialTextures load_at_once(const Scene& scene, const Slots& slots, TextureCache& cache,
                              const BakingListener& baking) {
    SlotSet set;
    for (const TextureSlot slot : slots) set.set(static_cast<std::size_t>(slot));
    return load_textures(scene, {set}, {TexelsRead()}, cache, baking).at(0);
}

/// Each map for itself.
MaterialTextures load_apart(const Scene& scene, const Slots& slots, TextureCache& cache,
                            const BakingListener& baking) {
    MaterialTextures all;
    for (const TextureSlot slot : slots) all = load_at_once(scene, {slot}, cache, baking);
    return all;
}

/// The file is gone as soon as the first map is being made.
testing::AssertionResult reads_heights_once(const Slots& slots, const Load& load) {
    const testing_films::TemporaryFolder folder;
    Scene scene = row_scene("cone-cell", Wrap::repeat);
    TextureReference& height = scene.materials.at(0).textures.at("height");
    std::filesystem::copy_file(height.file, folder / "h.exr");
    height.file = folder / "h.exr";
    TextureCache cache;
    try {
        load(scene, slots, cache,
             {[&](const std::string&, double) { std::filesystem::remove(folder / "h.exr"); }, {}});
    } catch (const InputError& error) {
        return testing::AssertionFailure() << error.what();
    }
    if (!std::filesystem::exists(folder / "h.exr")) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "nothing was made";
}

TEST(BakedMaps, AreMadeOfHeightsThatAreReadOnce) {
    const Slots derived = {TextureSlot::max_mip, TextureSlot::rmq};
    EXPECT_TRUE(reads_heights_once(derived, load_at_once));
    EXPECT_TRUE(reads_heights_once({TextureSlot::height, TextureSlot::max_mip, TextureSlot::rmq},
                                   load_at_once));
    EXPECT_FALSE(reads_heights_once(derived, load_apart));
    EXPECT_FALSE(reads_heights_once({TextureSlot::height}, load_at_once));
}

}  // namespace
}  // namespace quadrel::render_tests
