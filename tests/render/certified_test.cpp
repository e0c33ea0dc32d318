// The judge's channels in renders: proven on every scene whose heights are a map, the same bits
// however they are drawn, and counted.
#include "io/document/json.hpp"
#include "quadrel/errors.hpp"
#include "quadrel/quad/value.hpp"
#include "quadrel/relief/trace/oracle/common_hit.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/stats.hpp"
#include "render/draw/shell.hpp"
#include "render/films.hpp"
#include "render/hash_file.hpp"
#include "render/planted.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

const std::vector<std::string> judged_channels = [] {
    std::vector<std::string> names{"A"};
    for (const ChannelInfo& channel : channel_table())
        if (is_judged(channel.name)) names.push_back(channel.name);
    return names;
}();

Film judged(const Scene& scene, RenderOptions options = {}) {
    options.channels = judged_channels;
    return render(scene, options);
}

bool has_heights(const Scene& scene) {
    return std::all_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
        return !m.noise && m.textures.count("height") != 0;
    });
}

/// Every covered pixel with a ray is certified, where the heights are a map.
testing::AssertionResult is_certified(const Scene& scene, const Film& film) {
    const Plane &certified = *film.find("certified"), &reason = *film.find("certified.reason");
    for (std::size_t i = 0; i < certified.bits.size(); ++i) {
        if (!(film.find("A")->as_float(i) > 0)) continue;
        const auto why = static_cast<Uncertified>(reason.bits[i]);
        const bool proven = certified.bits[i] == 1 || certified.bits[i] == 2;
        if (proven != (why == Uncertified::proven))
            return testing::AssertionFailure() << "certificate and reason differ";
        if (proven || why == Uncertified::no_ray) continue;
        if (why == Uncertified::no_height_map && !has_heights(scene)) continue;
        return testing::AssertionFailure() << "not certified: " << reason.bits[i];
    }
    return testing::AssertionSuccess();
}

TEST(Certified, EverySceneWhoseHeightsAreAMap) {
    int with_heights = 0;
    for (const std::string& name : installed_scenes()) {
        const Scene scene = load_scene(name, {size_override("14x11")});
        Film film = judged(scene);
        EXPECT_TRUE(is_certified(scene, film)) << name;
        if (std::ranges::any_of(scene.materials, draws_shell))
            continue;  // of which nothing is proven
        with_heights += has_heights(scene);
        for (std::uint32_t& bits : film.find("certified")->bits) bits = 0;
        EXPECT_TRUE(!has_heights(scene) || !is_certified(scene, film)) << name;
    }
    EXPECT_GT(with_heights, 100);
}

TEST(Certified, HasTheSameBitsInEveryRun) {
    Scene scene = load_scene("spikes-60", {size_override("26x19")});
    scene.materials[0].occlusion = stage("ao-oracle", "materials.spikes.relief.occlusion");
    scene.materials[0].occlusion.parameters["samples"] = 4;
    RenderOptions plain;
    plain.isa = "scalar";
    plain.threads = 1;
    const Film expected = judged(scene, plain);
    RenderOptions other;
    other.threads = 3;
    other.tile = 8;
    EXPECT_TRUE(same_bits(expected, judged(scene, other)));
    other.skip = false;
    EXPECT_TRUE(same_bits(expected, judged(scene, other)));
    other.window = Window{3, 2, 20, 17};
    EXPECT_FALSE(judged(scene, other).find("oracle.s")->bits.empty());
}

/// Asking for it changes nothing else, and no one pays who does not ask.
TEST(Certified, LeavesTheRestAlone) {
    const Scene scene = load_scene("bricks-45", {size_override("20x15")});
    RenderOptions options;
    RenderStats stats;
    options.stats = &stats;
    const Film without_it = render(scene, options);
    EXPECT_FALSE(stats.certified.drawn);
    for (const StageStats& ran : stats.stages) EXPECT_NE(ran.id, "oracle");
    options.channels = default_channels();
    options.channels.push_back("certified");
    options.stats = &stats;
    EXPECT_TRUE(same_bits(without_it, with_planes(render(scene, options), default_channels())));
}

TEST(Certified, IsCounted) {
    const Scene scene = load_scene("bricks-45", {size_override("20x15")});
    RenderOptions options;
    RenderStats stats;
    options.stats = &stats;
    options.channels = {"certified"};
    const Film film = render(scene, options);
    EXPECT_TRUE(stats.certified.drawn);
    EXPECT_EQ(stats.certified.share(), 1);
    EXPECT_EQ(stats.certified.by_bounds + stats.certified.exactly, stats.covered_lanes);
    EXPECT_NE(to_json(stats).find("\"certified\""), std::string::npos);
    Scene noise = load_scene("rows/heights-noise", {size_override("20x15")});
    RenderStats other;
    options.stats = &other;
    render(noise, options);
    EXPECT_EQ(other.certified.share(), 0);
    EXPECT_EQ(other.certified.not_proven, other.covered_lanes);
    RenderStats flat;  // neither a frame nor heights
    options.stats = &flat;
    render(load_scene("sampler-lod-bias", {size_override("20x15")}), options);
    EXPECT_EQ(flat.certified.not_proven, 0u);
    EXPECT_EQ(flat.certified.without_ray, flat.covered_lanes);
    // A share of no rays is none.
    EXPECT_TRUE(Json::parse(to_json(flat))["certified"]["share"].is_null());
    EXPECT_EQ(Json::parse(to_json(stats))["certified"]["share"], 1);
    EXPECT_EQ(Json::parse(to_json(other))["certified"]["share"], 0);
    options.channels = {"certified.pixel"};
    RenderStats pixels;
    options.stats = &pixels;
    render(load_scene("sampler-lod-bias", {size_override("20x15")}), options);
    EXPECT_TRUE(Json::parse(to_json(pixels))["certified_pixel"]["share"].is_null());
}

/// Where there is nothing to judge by, nothing is said to have been met.
TEST(Certified, NoiseHasNoHitOfTheJudge) {
    RenderOptions options;
    options.channels = {"A", "oracle.status", "certified.reason", "err.kind", "hit.status"};
    const Film noise = render(load_scene("rows/heights-noise", {size_override("20x15")}), options);
    for (std::size_t i = 0; i < noise.window.area(); ++i) {
        const bool covered = noise.find("A")->as_float(i) > 0;
        EXPECT_EQ(noise.find("oracle.status")->bits[i], 0u);
        EXPECT_EQ(noise.find("certified.reason")->bits[i],
                  covered ? static_cast<std::uint32_t>(Uncertified::no_height_map) : 0u);
        if (covered) {
            EXPECT_NE(noise.find("hit.status")->bits[i], 0u);
            EXPECT_EQ(noise.find("err.kind")->bits[i],
                      static_cast<std::uint32_t>(ErrorKind::not_judged));
        }
    }
}

/// The second level is counted as the film has it, and only where it is asked for.
TEST(Certified, PixelsAreCountedAsTheyAreDrawn) {
    constexpr const char* far = R"(material.texture_matrix={"offset":[40000.3,0.7]})";
    const Scene scene = load_scene("bricks-45", {size_override("20x15"), far});
    RenderOptions options;
    RenderStats stats;
    options.stats = &stats;
    options.threads = 2;
    options.channels = {"A", "certified.pixel.reason"};
    const Film film = render(scene, options);
    std::map<std::uint32_t, std::uint64_t> reasons;
    for (std::size_t i = 0; i < film.window.area(); ++i)
        if (film.find("A")->as_float(i) > 0)
            ++reasons[film.find("certified.pixel.reason")->bits[i]];
    const CertifiedPixelStats& pixels = stats.certified_pixels;
    EXPECT_TRUE(pixels.drawn);
    EXPECT_EQ(pixels.proven, reasons[static_cast<std::uint32_t>(Uncertified::proven)]);
    EXPECT_EQ(pixels.open, reasons[static_cast<std::uint32_t>(oracle::pixel_open)]);
    EXPECT_EQ(pixels.apart, reasons[static_cast<std::uint32_t>(oracle::pixel_apart)]);
    EXPECT_GT(pixels.apart, 0u);
    EXPECT_EQ(
        pixels.proven + pixels.open + pixels.apart + pixels.ray_not_proven + pixels.without_ray,
        stats.covered_lanes);
    EXPECT_LT(pixels.share(), 1);
    EXPECT_NE(to_json(stats).find("\"certified_pixel\""), std::string::npos);
    options.channels = {"certified"};
    RenderStats other;
    options.stats = &other;
    render(scene, options);
    EXPECT_FALSE(other.certified_pixels.drawn);
    EXPECT_EQ(to_json(other).find("\"certified_pixel\""), std::string::npos);
}

/// Without a frame or heights there is nothing to prove; noise has heights, and no proof.
TEST(Certified, PixelsWithoutARayAreCountedApart) {
    const auto counted = [](const char* name) {
        RenderOptions options;
        RenderStats stats;
        options.stats = &stats;
        options.channels = {"certified.pixel"};
        render(load_scene(name, {size_override("20x15")}), options);
        EXPECT_GT(stats.covered_lanes, 0u) << name;
        return std::pair(stats.certified_pixels, stats.covered_lanes);
    };
    const auto [noise, noisy] = counted("rows/heights-noise");
    EXPECT_EQ(noise.ray_not_proven, noisy);
    EXPECT_EQ(noise.share(), 0);
    const auto [flat, lanes] = counted("sampler-lod-bias");
    EXPECT_EQ(flat.without_ray, lanes);
    EXPECT_EQ(flat.share(), 1);
}

/// Of the pixels whose drawn ray is proven, those whose exact ray is shown to end in its cell.
struct PixelShares {
    double covered = 0, pixel = 0;
    std::map<std::uint32_t, int> reasons;
};
PixelShares pixel_shares(const std::string& name, const std::vector<std::string>& changes = {}) {
    std::vector<std::string> overrides{size_override("32x24")};
    overrides.insert(overrides.end(), changes.begin(), changes.end());
    RenderOptions options;
    options.channels = {"A", "certified", "certified.reason", "certified.pixel",
                        "certified.pixel.reason"};
    const Film film = render(load_scene(name, overrides), options);
    PixelShares shares;
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        if (!(film.find("A")->as_float(i) > 0)) continue;
        const std::uint32_t pixel = film.find("certified.pixel")->bits[i],
                            reason = film.find("certified.pixel.reason")->bits[i];
        shares.covered += 1;
        shares.pixel += pixel;
        ++shares.reasons[reason];
        EXPECT_EQ(pixel == 1, reason == 0);
        EXPECT_TRUE(pixel == 0 || film.find("certified")->bits[i] != 0);
    }
    return shares;
}

TEST(Certified, PixelsAreNearlyAllProven) {
    const PixelShares bricks = pixel_shares("bricks-45");
    EXPECT_GT(bricks.pixel, 0.98 * bricks.covered);
    const PixelShares blocks = pixel_shares("rows/qdm");
    EXPECT_GT(blocks.pixel, 0.9 * blocks.covered);
    const PixelShares noise = pixel_shares("rows/heights-noise");
    EXPECT_EQ(noise.pixel, 0);
    EXPECT_EQ(noise.reasons.size(), 1u);
    EXPECT_TRUE(noise.reasons.contains(static_cast<std::uint32_t>(Uncertified::no_height_map)));
}

/// Planted: coordinates so far out that floats are a tenth of a texel apart. The pixel's exact ray,
/// which is made of the same vertices, then often ends in another cell than the drawn one.
TEST(Certified, PixelsWhoseRayIsRoundedElsewhereAreNot) {
    const PixelShares far =
        pixel_shares("bricks-45", {R"(material.texture_matrix={"offset":[40000.3,0.7]})"});
    EXPECT_GT(far.reasons.at(static_cast<std::uint32_t>(oracle::pixel_apart)), 0.02 * far.covered);
}

/// Blocks judge what searches blocks.
TEST(Certified, JudgesTheSurfaceThatTheTraceSearches) {
    const auto of = [](const std::string& name, const std::vector<std::string>& channels) {
        RenderOptions options;
        options.channels = channels;
        return render(load_scene(name, {size_override("24x18")}), options);
    };
    const Film blocks = of("rows/oracle-block", {"oracle", "certified"});
    EXPECT_TRUE(same_bits(blocks, of("rows/qdm", {"oracle", "certified"})));
    EXPECT_TRUE(same_bits(blocks, of("rows/pyramid", {"oracle", "certified"})));
    EXPECT_FALSE(same_bits(blocks, of("rows/linear", {"oracle", "certified"})));
    EXPECT_TRUE(same_bits(of("rows/oracle-bilinear", {"oracle", "certified"}),
                          of("rows/linear", {"oracle", "certified"})));
}

}  // namespace
}  // namespace quadrel::render_tests
