// What the plan leaves out was not needed: a channel has the same bits whatever else is asked for,
// and as when nothing is left out.
#include "quadrel/error.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

testing::AssertionResult same_within(const Renderer& renderer, const Scene& scene, const Film& all,
                                     const std::vector<std::string>& channels) {
    return same_bits(with_planes(all, channels), take(renderer, scene, channels))
           << ", asked for with " << channels.size() - 1 << " others";
}

/// A render that computes and loads everything.
Film take_without_skipping(const Renderer& renderer, const Scene& scene,
                           const std::vector<std::string>& channels) {
    RenderOptions options;
    options.channels = channels;
    options.isa = "scalar";
    options.skip = false;
    return renderer(scene, options);
}

/// Against a render of everything: all channels, each alone, each with its neighbour in the data
/// flow, the default set.
testing::AssertionResult plan_leaves_no_trace(const Renderer& renderer, const Scene& scene) {
    const auto names = all_channels(scene);
    const Film all = take_without_skipping(render, scene, names);
    if (auto same = same_within(renderer, scene, all, names); !same) return same;
    for (const std::string& name : names)
        if (auto same = same_within(renderer, scene, all, {name}); !same) return same;
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
        if (auto same = same_within(renderer, scene, all, {names[i + 1], names[i]}); !same)
            return same;
    return same_within(renderer, scene, all, default_channels());
}

TEST(Plan, LeavesNoTrace) {
    EXPECT_TRUE(plan_leaves_no_trace(render, varied_scene(1, Conventions::gl, 17, 13)));
    EXPECT_TRUE(plan_leaves_no_trace(render, varied_scene(4, Conventions::vulkan, 12, 10)));
}

/// Without skipping, what is asked for makes no difference either.
TEST(Plan, ComputesEverythingOnRequest) {
    const Scene scene = varied_scene(1, Conventions::d3d, 21, 15);
    const Film all = take_without_skipping(render, scene, all_channels(scene));
    for (const char* name : {"R", "Z", "uv.U", "hit.steps", "lod.rho", "shadow.1.visibility"})
        EXPECT_TRUE(
            same_bits(with_planes(all, {name}), take_without_skipping(render, scene, {name})));
}

/// Textures that nothing asks for are not opened, nor those of materials that are not in view.
TEST(Plan, LoadsWhatIsNeeded) {
    Scene scene = varied_scene();
    for (const char* map : {"color", "gloss", "emissive", "height"})
        scene.materials[0].textures[map].file = texture_folder() / "missing.exr";
    EXPECT_NO_THROW(take(render, scene, {"uv", "K", "depth"}));
    EXPECT_THROW(take(render, scene, {"hit.s"}), InputError);
    EXPECT_THROW(take(render, scene, {"R"}), InputError);
    EXPECT_THROW(take_without_skipping(render, scene, {"uv"}), InputError);
    for (Object& object : scene.objects) object.visible = object.material != 0;
    EXPECT_NO_THROW(take(render, scene));
}

TEST(Plan, AForgottenInputIsNoticed) {
    const Scene scene = varied_scene(1, Conventions::gl, 17, 13);
    EXPECT_FALSE(plan_leaves_no_trace(with(Planted::needs_forgotten), scene));
}

/// Every channel of the table has values somewhere in the varied scene, so that the tests above
/// compare more than zeros.
TEST(Plan, EveryChannelSaysSomething) {
    const Scene scene = varied_scene();
    const Film film = take(render, scene, all_channels(scene));
    for (const Plane& plane : film.planes) {
        if (plane.name == "hit.flags") continue;  // set by degenerate maps only
        EXPECT_TRUE(std::any_of(plane.bits.begin(), plane.bits.end(), [&](std::uint32_t b) {
            return b != plane.bits[0];
        })) << plane.name;
    }
}

TEST(Progress, RisesToOne) {
    RenderOptions options;
    options.tile = 8;
    options.threads = 2;
    std::vector<double> reports;
    options.progress = [&](double done) { reports.push_back(done); };
    render(varied_scene(), options);
    ASSERT_FALSE(reports.empty());
    EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
    EXPECT_GT(reports.front(), 0);
    EXPECT_EQ(reports.back(), 1);
}

}  // namespace
}  // namespace quadrel::render_tests
