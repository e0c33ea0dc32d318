// Texels, cache lines and steps of --stats against a count by hand from what `probe` reports of
// every quad, and equal however the render is run.
#include <map>
#include <set>

#include "built_isas.hpp"
#include "quadrel/probe.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/stats.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

using Statist = std::function<RenderStats(const Scene&, const RenderOptions&)>;

RenderStats stats_of(const Scene& scene, RenderOptions options) {
    RenderStats stats;
    options.stats = &stats;
    options.touched = true;
    render(scene, options);
    return stats;
}

/// What a probe asks for: every channel that needs no light's number.
std::vector<std::string> probed_channels() {
    std::vector<std::string> names;
    for (const ChannelInfo& channel : channel_table())
        if (channel.name.find('<') == std::string::npos && !is_drawn_apart(channel.name))
            names.push_back(channel.name);
    return names;
}

/// A texel by level, row and column.
using Texel = std::array<int, 3>;

/// A look at a whole picture through its probes.
struct HandCount {
    std::map<std::pair<std::string, std::string>, std::set<Texel>> texels;  ///< material, slot
    std::uint64_t trace_steps = 0, shadow_steps = 0;
};

void add_fetches(const ProbeFragment& fragment, const ProbeStage& stage, HandCount& count) {
    for (const ProbeFetch& fetch : stage.fetches)
        for (std::size_t lane = 0; lane < 4; ++lane)
            for (const TexelTap& tap : fetch.footprint[lane].taps)
                if (fetch.active[lane] && !tap.border)
                    count.texels[{fragment.material, fetch.texture}].insert(
                        {tap.level, tap.y, tap.x});
}

void add_steps(const ProbeStage& stage, HandCount& count) {
    for (const ProbeValue& value : stage.outputs)
        for (const std::int32_t steps : value.whole) {
            const auto n = static_cast<std::uint64_t>(steps);
            if (value.name == "hit.steps") count.trace_steps += n;
            if (value.name.starts_with("shadow.") && value.name.ends_with(".steps"))
                count.shadow_steps += n;
        }
}

HandCount count_by_hand(const Scene& scene) {
    HandCount count;
    for (int y = 0; y < scene.height; y += 2)
        for (int x = 0; x < scene.width; x += 2)
            for (const ProbeFragment& fragment : probe(scene, x, y).fragments)
                for (const ProbeStage& stage : fragment.stages) {
                    add_fetches(fragment, stage, count);
                    add_steps(stage, count);
                }
    return count;
}

/// Cache lines of one level's texels: rows follow each other without a gap.
std::uint64_t lines_of(const std::set<Texel>& texels, int level, int width, int channels) {
    std::set<int> lines;
    for (const Texel& texel : texels)
        if (texel[0] == level) lines.insert((texel[1] * width + texel[2]) * channels * 4 / 64);
    return lines.size();
}

testing::AssertionResult same_touched(const TextureStats& row, const std::set<Texel>& texels) {
    if (static_cast<int>(row.touched.size()) != row.levels)
        return testing::AssertionFailure() << row.touched.size() << " levels of " << row.levels;
    for (int level = 0; level < row.levels; ++level) {
        const TouchedStats& found = row.touched[static_cast<std::size_t>(level)];
        const auto expected = static_cast<std::uint64_t>(std::count_if(
            texels.begin(), texels.end(), [&](const Texel& t) { return t[0] == level; }));
        const std::uint64_t lines =
            lines_of(texels, level, std::max(1, row.width >> level), row.channels);
        if (found.texels != expected || found.lines != lines)
            return testing::AssertionFailure()
                   << row.material << " " << row.slot << " level " << level << ": " << found.texels
                   << " texels in " << found.lines << " lines, by hand " << expected << " in "
                   << lines;
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult agrees_with_probes(const Statist& statist, const Scene& scene) {
    RenderOptions options;
    options.channels = probed_channels();
    const RenderStats stats = statist(scene, options);
    HandCount count = count_by_hand(scene);
    TouchedStats sum;
    for (const TextureStats& row : stats.textures) {
        if (auto same = same_touched(row, count.texels[{row.material, row.slot}]); !same)
            return same;
        for (const TouchedStats& level : row.touched) sum += level;
    }
    if (stats.trace_steps != count.trace_steps || stats.shadow_steps != count.shadow_steps)
        return testing::AssertionFailure()
               << stats.trace_steps << " and " << stats.shadow_steps << " steps, by hand "
               << count.trace_steps << " and " << count.shadow_steps;
    if (sum.texels != stats.touched.texels || sum.lines != stats.touched.lines)
        return testing::AssertionFailure() << "the sum is not the sum";
    return testing::AssertionSuccess();
}

/// Reliefs with every map a texture of its own, each under another sampler.
Scene sampled_scene() {
    Scene scene = empty_scene(22, 16);
    set_perspective_camera(scene, {0.6, 0.9, 3}, {.near = 0.5, .far = 50});
    scene.lights = {Light(), directional_light({0.3f, -0.2f, 1})};
    scene.materials = {relief_material("relief", false), relief_material("other", false)};
    int number = 0;
    for (Material& material : scene.materials)
        for (auto& [slot, reference] : material.textures) {
            const int n = number++;
            const int size = 8 << (n % 3);
            // Equal texels would make one texture of two.
            const auto texel = [&](int x, int y, int c) { return noise(x + 64 * n, y, c); };
            reference = texture(write_texture("touched" + std::to_string(n) + ".exr", size, texel),
                                slot == "height" ? "r"
                                : n % 2          ? ""
                                                 : "rg");
            SamplerState& sampler = reference.sampler;
            sampler.wrap_u = static_cast<Wrap>(n % 5);
            sampler.wrap_v = static_cast<Wrap>((n + 3) % 5);
            sampler.mag = n % 4 == 1 ? Filter::nearest : Filter::linear;
            sampler.min = n % 4 == 2 ? Filter::nearest : Filter::linear;
            sampler.mip = static_cast<MipFilter>((n + 2) % 3);
        }
    add_object(scene, make_quad(3, 2, 3), 0, translation({-0.9, 0, 0}) * rotation(40, {0, 1, 0}));
    add_object(scene, make_quad(2), 1, translation({0.9, 0.1, 0.3}) * rotation(-35, {1, 0, 0}));
    return scene;
}

TEST(Touched, IsWhatProbesReport) { EXPECT_TRUE(agrees_with_probes(stats_of, sampled_scene())); }

TEST(Touched, PlantedErrorsAreCaught) {
    const auto with_samplers = [](const std::function<void(SamplerState&)>& change) {
        return [change](Scene scene, const RenderOptions& options) {
            for (Material& material : scene.materials)
                for (auto& [slot, reference] : material.textures) change(reference.sampler);
            return stats_of(scene, options);
        };
    };
    const Scene scene = sampled_scene();
    EXPECT_FALSE(agrees_with_probes(
        with_samplers([](SamplerState& s) { s.min = s.mag = Filter::nearest; }), scene));
    EXPECT_FALSE(agrees_with_probes(
        with_samplers([](SamplerState& s) { s.mip = MipFilter::nearest; }), scene));
    const auto with_stats = [](const std::function<void(RenderStats&)>& change) {
        return [change](const Scene& s, const RenderOptions& options) {
            RenderStats stats = stats_of(s, options);
            change(stats);
            return stats;
        };
    };
    for (const auto& change : std::vector<std::function<void(RenderStats&)>>{
             [](RenderStats& s) { ++s.textures[1].touched[0].texels; },
             [](RenderStats& s) { --s.textures[2].touched[0].lines; },
             [](RenderStats& s) { ++s.touched.lines; }, [](RenderStats& s) { --s.trace_steps; },
             [](RenderStats& s) { ++s.shadow_steps; }})
        EXPECT_FALSE(agrees_with_probes(with_stats(change), scene));
}

/// Everything of a RenderStats that marking finds.
std::vector<std::uint64_t> marked(const RenderStats& stats) {
    std::vector<std::uint64_t> all{stats.touched.texels, stats.touched.lines, stats.trace_steps,
                                   stats.shadow_steps};
    for (const TextureStats& texture : stats.textures)
        for (const TouchedStats& level : texture.touched) {
            all.push_back(level.texels);
            all.push_back(level.lines);
        }
    return all;
}

/// And the look-ups of all steps.
std::vector<std::uint64_t> marked_and_looked_up(const RenderStats& stats) {
    std::vector<std::uint64_t> all = marked(stats);
    all.push_back(stats.fetches.fetches);
    for (const auto& [kind, look_ups] : stats.fetches_by_kind) all.push_back(look_ups);
    return all;
}

/// Discards, a cube map and textures that materials share come up in the varied scene.
testing::AssertionResult same_however_run(const Statist& statist) {
    const Scene scene = varied_scene();
    RenderOptions options;
    options.isa = "scalar";
    options.threads = 1;
    const auto expected = marked_and_looked_up(statist(scene, options));
    std::vector<RenderOptions> others(2, options);
    others[0].threads = 3;
    others[1].tile = 6;
    for (const std::string& isa : built_isas()) {
        others.push_back(options);
        others.back().isa = isa;
    }
    for (const RenderOptions& other : others)
        if (marked_and_looked_up(statist(scene, other)) != expected)
            return testing::AssertionFailure()
                   << other.isa << ", " << other.threads << " threads, tiles of " << other.tile;
    return testing::AssertionSuccess();
}

TEST(Touched, DoesNotDependOnHowTheRenderIsRun) {
    EXPECT_TRUE(same_however_run(stats_of));
    EXPECT_FALSE(same_however_run([](const Scene& scene, const RenderOptions& options) {
        RenderStats stats = stats_of(scene, options);
        if (options.threads > 1) ++stats.touched.lines;
        return stats;
    }));
}

/// Drawing looks ahead, and learns whether that pays: what it leaves out, and what it has learnt,
/// is in no count.
TEST(Touched, LookUpsAreThoseOfEveryStep) {
    const Scene scene = load_scene("rows/linear", {"size=[24,20]"});
    RenderOptions options;
    options.channels = {"R", "G", "B", "A"};
    RenderStats every;
    options.stats = &every;
    options.skip = false;
    render(scene, options);
    options.skip = true;
    bool leaves_out = false;
    for (const std::string& isa : built_isas())
        for (int drawn_before = 0; drawn_before < 3; ++drawn_before) {
            options.isa = isa;
            const RenderStats counted = stats_of(scene, options);
            EXPECT_EQ(counted.fetches_by_kind, every.fetches_by_kind) << isa << drawn_before;
            RenderStats drawn;
            options.stats = &drawn;
            render(scene, options);
            leaves_out |= drawn.fetches.fetches < every.fetches.fetches;
        }
    EXPECT_TRUE(leaves_out);
}

/// What is not asked for is neither counted nor in the JSON. Look-ups are those of every step then,
/// which drawing need not make.
TEST(Touched, OnlyWhereItIsAskedFor) {
    const Scene scene = varied_scene();
    RenderStats with = stats_of(scene, {}), without;
    RenderOptions options;
    options.stats = &without;
    render(scene, options);
    EXPECT_TRUE(with.has_touched);
    EXPECT_FALSE(without.has_touched);
    EXPECT_EQ(without.mark.wall_ms, 0);
    EXPECT_EQ(marked(without), std::vector<std::uint64_t>(4, 0));
    EXPECT_GT(without.fetches.fetches, 0u);
    EXPECT_LE(without.fetches.fetches, with.fetches.fetches);
    for (const auto& [kind, look_ups] : without.fetches_by_kind)
        EXPECT_LE(look_ups, with.fetches_by_kind.at(kind)) << kind;
    for (const char* key : {"\"touched\"", "\"steps\"", "\"mark\""}) {
        EXPECT_NE(to_json(with).find(key), std::string::npos) << key;
        EXPECT_EQ(to_json(without).find(key), std::string::npos) << key;
    }
}

/// Asking for statistics changes no bit, and what is touched is never more than there is, nor less
/// than nothing.
TEST(Touched, LeavesTheImageAlone) {
    const Scene scene = varied_scene();
    RenderOptions options;
    const Film film = render(scene, options);
    RenderStats stats;
    options.stats = &stats;
    options.touched = true;
    EXPECT_TRUE(same_bits(film, render(scene, options)));
    ASSERT_FALSE(stats.textures.empty());
    for (const TextureStats& texture : stats.textures) {
        ASSERT_EQ(texture.touched.size(), static_cast<std::size_t>(texture.levels));
        std::uint64_t sum = 0;
        for (int level = 0; level < texture.levels; ++level) {
            const auto& touched = texture.touched[static_cast<std::size_t>(level)];
            sum += touched.texels;
            EXPECT_LE(touched.texels,
                      static_cast<std::uint64_t>(texture.faces) *
                          static_cast<std::uint64_t>(std::max(1, texture.width >> level)) *
                          static_cast<std::uint64_t>(std::max(1, texture.height >> level)));
            EXPECT_LE(touched.lines, touched.texels);
        }
        EXPECT_GT(sum, 0u) << texture.material << " " << texture.slot;
    }
    EXPECT_GT(stats.draw.cpu_ms, 0);
    EXPECT_GT(stats.draw.wall_ms, 0);
}

}  // namespace
}  // namespace quadrel::render_tests
