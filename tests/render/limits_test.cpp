// What a GPU may give: renders of other implementations lie within the ranges, mistakes do not, and
// the ranges are narrow enough to say so.
#include <fmt/format.h>

#include <optional>

#include "effort.hpp"
#include "quadrel/error.hpp"
#include "quadrel/scene/load.hpp"
#include "render/films.hpp"

namespace quadrel::render_tests {
namespace {

const std::vector<std::string> limited_channels = {
    "P", "uv", "dUVdx", "dUVdy", "K", "r", "N", "hit.U", "hit.V", "R", "G", "B", "hit.s"};

struct LimitedScene {
    std::string scene;
    Window window;
    std::vector<std::string> overrides = {};
    std::vector<std::string> channels = limited_channels;
};

Film render_limited(const LimitedScene& what, const std::string& limits,
                    std::vector<std::string> more = {}) {
    more.insert(more.end(), what.overrides.begin(), what.overrides.end());
    RenderOptions options;
    options.channels = what.channels;
    options.channels.push_back("A");
    options.window = what.window;
    options.limits = limits;
    return render(load_scene(what.scene, more), options);
}

/// What a film's float channels are beside the ranges of another.
struct RangeVerdict {
    std::size_t values = 0, outside = 0;
    /// Of values that differ from the reference's by more than their range is wide.
    std::size_t changed = 0, found = 0;
    std::string first;
};

RangeVerdict verdict_of(const Film& ranges, const Film& film) {
    RangeVerdict verdict;
    const Plane& covered = *ranges.find("A");
    for (const Plane& plane : film.planes) {
        const Plane* const low = ranges.find("gpu.lo." + plane.name);
        const Plane* const high = ranges.find("gpu.hi." + plane.name);
        if (low == nullptr) continue;
        const Plane& reference = *ranges.find(plane.name);
        for (std::size_t i = 0; i < plane.bits.size(); ++i) {
            if (!(covered.as_float(i) > 0)) continue;
            ++verdict.values;
            const float x = plane.as_float(i), lo = low->as_float(i), hi = high->as_float(i);
            const float gap_lo = ranges.find("gpu.gap.lo." + plane.name)->as_float(i);
            const float gap_hi = ranges.find("gpu.gap.hi." + plane.name)->as_float(i);
            const bool beyond = !(x >= lo && x <= hi) && lo > -INFINITY;
            const bool outside = beyond || (x > gap_lo && x < gap_hi);
            const bool changed = std::abs(x - reference.as_float(i)) > hi - lo;
            verdict.outside += outside;
            verdict.changed += changed;
            verdict.found += changed && outside;
            if (outside && verdict.first.empty())
                verdict.first =
                    fmt::format("{} of pixel {}: {} is not in {} to {}", plane.name, i, x, lo, hi);
        }
    }
    return verdict;
}

/// Pixels of a channel by what can be said of them, as shares of those that are covered.
struct RangeShares {
    double ambiguous = 0, unbounded = 0;
};
RangeShares range_shares_of(const Film& ranges, const std::string& channel) {
    RangeShares shares;
    double covered = 0;
    for (std::size_t i = 0; i < ranges.planes[0].bits.size(); ++i) {
        if (!(ranges.find("A")->as_float(i) > 0)) continue;
        ++covered;
        shares.ambiguous += ranges.find("gpu.paths." + channel)->bits[i] > 1;
        shares.unbounded += !std::isfinite(ranges.find("gpu.hi." + channel)->as_float(i));
    }
    return {shares.ambiguous / covered, shares.unbounded / covered};
}

const LimitedScene plain_texture{"sampler-mag-linear", {40, 40, 56, 48}};
const LimitedScene thesis_quad_part{"thesis-quad", {200, 200, 204, 202}};
const LimitedScene level_0_part{
    "thesis-quad", {200, 200, 208, 204}, {"textures.bricks-height.lod_max=0"}};
const LimitedScene bricks_part{"bricks-45", {300, 300, 304, 302}};
const LimitedScene offset_part{"rows/offset-limit", {40, 40, 56, 48}};
const LimitedScene binary_part{"rows/relief-binary", {40, 40, 42, 42}};

/// Of what nothing covers there is no doubt.
TEST(Limits, HoldTheBackground) {
    RenderOptions options;
    options.channels = {"R", "G", "B", "A", "Z", "uv"};
    options.limits = "gl";
    const Film film = render(
        load_scene("sampler-min-linear", {"size=[12,12]", "background=[0.25,0.5,0.75]"}), options);
    std::size_t empty = 0;
    for (std::size_t i = 0; i < film.planes[0].bits.size(); ++i) {
        if (film.find("A")->as_float(i) > 0) continue;
        ++empty;
        for (const char* name : {"R", "G", "B", "Z", "uv.U", "uv.V"}) {
            const std::uint32_t bits = film.find(name)->bits[i];
            EXPECT_EQ(film.find(std::string("gpu.lo.") + name)->bits[i], bits) << name;
            EXPECT_EQ(film.find(std::string("gpu.hi.") + name)->bits[i], bits) << name;
            EXPECT_EQ(film.find(std::string("gpu.paths.") + name)->bits[i], 1u) << name;
        }
    }
    EXPECT_GT(empty, 0u);
}

TEST(Limits, HoldWhatOtherImplementationsGive) {
    for (const LimitedScene& what :
         {plain_texture, thesis_quad_part, bricks_part, offset_part, binary_part})
        for (const std::string limits : {"gl", "vulkan", "d3d"}) {
            if (test::sanitized && (limits != "d3d" || what.scene == bricks_part.scene)) continue;
            const Film ranges = render_limited(what, limits);
            for (const std::string hardware : {"exact", "d3d", "llvmpipe", "swiftshader"}) {
                if ((limits == "d3d") != (hardware == "d3d") && hardware != "exact") continue;
                const RangeVerdict verdict =
                    verdict_of(ranges, render_limited(what, "", {"hardware=\"" + hardware + "\""}));
                EXPECT_GT(verdict.values, 50u);
                EXPECT_EQ(verdict.outside, 0u) << what.scene << ", limits " << limits << ", "
                                               << hardware << ": " << verdict.first;
            }
        }
}

void expect_found(const RangeVerdict& verdict, const char* what) {
    EXPECT_GT(verdict.changed, 0u) << what;
    EXPECT_GT(verdict.outside, 0u) << what;
    EXPECT_GE(2 * verdict.found, verdict.changed) << what;
}

struct Preset {
    const char *hardware, *limits;
};
/// With the sub-pixel bits that the implementation has.
const Preset presets[] = {{"d3d", "d3d"},
                          {"vulkan-min", "vulkan,snapping=0.0625"},
                          {"llvmpipe", "gl"},
                          {"swiftshader", "gl"},
                          {"chromium", "gl,snapping=0.0625"}};

/// The ground of bricks-45 reaches behind the eye.
RangeVerdict verdict_of_cut_triangles(const std::string& hardware, const std::string& limits) {
    RangeVerdict all;
    for (const Window& window :
         {Window{224, 256, 288, 258}, {0, 100, 32, 102}, {40, 440, 72, 442}, {470, 2, 502, 4}}) {
        const LimitedScene what{
            "bricks-45", window, {}, {"P", "uv", "dUVdx", "dUVdy", "dPdx", "dPdy"}};
        const RangeVerdict verdict =
            verdict_of(render_limited(what, limits),
                       render_limited(what, "", {"hardware=\"" + hardware + "\""}));
        all.values += verdict.values;
        all.outside += verdict.outside;
        if (all.first.empty()) all.first = verdict.first;
    }
    return all;
}

TEST(Limits, HoldWhatEveryPresetMakesOfTrianglesThatAreCut) {
    for (const Preset& preset : presets) {
        const RangeVerdict verdict = verdict_of_cut_triangles(preset.hardware, preset.limits);
        EXPECT_GT(verdict.values, 2000u);
        EXPECT_EQ(verdict.outside, 0u) << preset.hardware << ": " << verdict.first;
    }
}

Plane& plane_of(Film& film, const std::string& name) {
    return *std::ranges::find(film.planes, name, &Plane::name);
}

/// Of a pixel's range, less its widest gap.
float width_of(const Film& ranges, const std::string& channel, std::size_t i) {
    const auto end = [&](const char* prefix) { return ranges.find(prefix + channel)->as_float(i); };
    return end("gpu.hi.") - end("gpu.lo.") - std::max(end("gpu.gap.hi.") - end("gpu.gap.lo."), 0.f);
}

/// Searches whose hits are known without following them, and those that stay within a bracket;
/// these read levels that are free.
TEST(Limits, BoundSearchesThatTheyDoNotFollow) {
    for (const std::string row : {"texel-exact",
                                  "max-mip",
                                  "rmq-leap",
                                  "cone-cell",
                                  "qdm",
                                  "pyramid",
                                  "ddm",
                                  "oracle-bilinear",
                                  "oracle-block",
                                  "oracle-tri-min",
                                  "steep-maxmip",
                                  "cone-step",
                                  "cone-aniso",
                                  "cone-robust",
                                  "cone-robust-exact",
                                  "relaxed-cone",
                                  "sphere-3d",
                                  "gdm",
                                  "vdm",
                                  "dual-depth-exact",
                                  "multilayer-exact",
                                  "prism-exact",
                                  "secant",
                                  "interval"}) {
        if (test::sanitized && row != "max-mip" && row != "secant" && row != "cone-step") continue;
        const LimitedScene what{
            "rows/" + row, {40, 60, 46, 62}, {}, {"K", "hit.s", "hit.U", "hit.V"}};
        const bool exact = row != "secant" && row != "interval";
        const float widest = exact && row != "relaxed-cone" ? 0.25f : 0.5f;
        const Film ranges = render_limited(what, "gl");
        const RangeShares shares = range_shares_of(ranges, "hit.s");
        EXPECT_EQ(shares.unbounded, 0) << row;
        EXPECT_LE(shares.ambiguous, exact ? 0.25 : 0.5) << row;
        for (std::size_t i = 0; i < ranges.planes[0].bits.size(); ++i)
            EXPECT_LE(width_of(ranges, "hit.s", i), widest) << row;
        for (const std::string hardware : {"exact", "llvmpipe", "swiftshader"}) {
            const RangeVerdict verdict =
                verdict_of(ranges, render_limited(what, "", {"hardware=\"" + hardware + "\""}));
            EXPECT_EQ(verdict.outside, 0u) << row << ", " << hardware << ": " << verdict.first;
        }
        const RangeVerdict flatter =
            verdict_of(ranges, render_limited(what, "", {"material.relief.depth=0.1"}));
        expect_found(flatter, row.c_str());
    }
}

/// Lights behind an exact search are mostly known to be hidden or not; a search that lets every
/// light through is found.
TEST(Limits, BoundLightsThatTheyDoNotFollow) {
    for (const std::string row : {"shadow-exact", "shadow-oracle"}) {
        if (test::sanitized && row != "shadow-exact") continue;
        const LimitedScene what{
            "rows/" + row, {40, 56, 56, 60}, {}, {"shadow.visibility", "hit.s"}};
        const Film ranges = render_limited(what, "gl");
        EXPECT_LE(range_shares_of(ranges, "shadow.visibility").ambiguous, 0.5) << row;
        for (const std::string hardware : {"exact", "llvmpipe", "swiftshader"}) {
            const RangeVerdict verdict =
                verdict_of(ranges, render_limited(what, "", {"hardware=\"" + hardware + "\""}));
            EXPECT_EQ(verdict.outside, 0u) << row << ", " << hardware << ": " << verdict.first;
        }
        const RangeVerdict unhidden = verdict_of(
            ranges, render_limited(what, "", {"material.relief.shadow=\"shadow-none\""}));
        expect_found(unhidden, row.c_str());
    }
}

/// Whatever level of detail rho's forms permit: half a level above the reference's, for one.
TEST(Limits, HoldEveryLevelThatIsPermitted) {
    for (const std::string bias : {"-0.0625", "0.25", "0.5"}) {
        const LimitedScene& what = bricks_part;
        std::vector<std::string> overrides;
        for (const char* map : {"color", "height", "gloss"})
            overrides.push_back(fmt::format("textures.bricks-{}.lod_bias={}", map, bias));
        const RangeVerdict verdict =
            verdict_of(render_limited(what, "gl"), render_limited(what, "", overrides));
        EXPECT_EQ(verdict.outside, 0u) << bias << ": " << verdict.first;
    }
}

/// Light or shadow, and nothing between: what is neither is found.
TEST(Limits, LeaveAGapBetweenRangesToMistakes) {
    const LimitedScene what{"bricks-45", {160, 320, 164, 322}, {}, {"R"}};
    const Film ranges = render_limited(what, "gl");
    for (const std::string hardware : {"exact", "llvmpipe", "swiftshader"}) {
        const RangeVerdict verdict =
            verdict_of(ranges, render_limited(what, "", {"hardware=\"" + hardware + "\""}));
        EXPECT_EQ(verdict.outside, 0u) << hardware << ": " << verdict.first;
    }
    Film between = ranges;
    std::size_t gaps = 0;
    const Plane &low = plane_of(between, "gpu.gap.lo.R"), &high = plane_of(between, "gpu.gap.hi.R");
    for (std::size_t i = 0; i < low.bits.size(); ++i) {
        const float lo = low.as_float(i), hi = high.as_float(i);
        if (!(lo < hi)) continue;
        ++gaps;
        EXPECT_GT(ranges.find("gpu.paths.R")->bits[i], 1u);
        plane_of(between, "R").bits[i] = std::bit_cast<std::uint32_t>((lo + hi) / 2);
    }
    EXPECT_GT(gaps, 0u);
    EXPECT_EQ(verdict_of(ranges, between).outside, gaps);
}

/// Renders of a scene within its ranges; empty where a stage of it does not run on ranges.
std::optional<RangeVerdict> verdict_of_row(const std::string& name) {
    const Scene scene = load_scene(name);
    const int x = scene.width / 2, y = scene.height / 2;
    const LimitedScene what{name, {x, y, x + 2, y + 2}, {"samples=1"}};
    try {
        return verdict_of(render_limited(what, "gl"),
                          render_limited(what, "", {"hardware=\"llvmpipe\""}));
    } catch (const UsageError&) {
        return std::nullopt;
    }
}

TEST(Limits, HoldEveryRowThatRunsOnRanges) {
    int rows = 0, scenes = 0;
    for (const std::string& name : installed_scenes()) {
        if (!name.starts_with("rows/") || (test::sanitized && ++scenes % 24 != 0)) continue;
        const auto verdict = verdict_of_row(name);
        if (!verdict) continue;
        ++rows;
        EXPECT_EQ(verdict->outside, 0u) << name << ": " << verdict->first;
    }
    EXPECT_GT(rows, test::sanitized ? 1 : 165);
}

const std::vector<std::string> bounded_channels = {"uv.U",  "uv.V",  "K.U", "K.V", "hit.s",
                                                   "hit.U", "hit.V", "N.X", "N.Y", "N.Z"};

/// Values in double that lie outside of what exact arithmetic may make of the same inputs, in the
/// middle of a scene; nothing where a stage does not run on ranges. Presets interpolate by floats
/// of their own. `planted`: the relief of doubles is deeper.
std::optional<std::size_t> doubles_out_of_bounds(const std::string& name, std::size_t& values,
                                                 bool planted = false) {
    Scene scene = load_scene(name, {"samples=1", "hardware=exact"});
    const int x = scene.width / 2, y = scene.height / 2;
    RenderOptions options;
    options.window = {x, y, x + 2, y + 2};
    options.channels = {"A"};
    for (const std::string& channel : bounded_channels)
        for (const char* end : {"bound.lo.", "bound.hi."})
            options.channels.push_back(end + channel);
    Film bounds;
    try {
        bounds = render(scene, options);
    } catch (const UsageError&) {
        return std::nullopt;
    }
    options.number = "double";
    options.channels = bounded_channels;
    options.channels.push_back("A");
    if (planted)
        for (Material& material : scene.materials) material.depth *= 1.001f;
    const Film doubles = render(scene, options);
    std::size_t outside = 0;
    for (const std::string& channel : bounded_channels)
        for (std::size_t i = 0; i < doubles.window.area(); ++i) {
            if (!(bounds.find("A")->as_float(i) > 0 && doubles.find("A")->as_float(i) > 0))
                continue;
            const float value = doubles.find(channel)->as_float(i);
            ++values;
            outside += value < bounds.find("bound.lo." + channel)->as_float(i) ||
                       value > bounds.find("bound.hi." + channel)->as_float(i);
        }
    return outside;
}

TEST(Limits, OfExactArithmeticHoldDoublesInEveryScene) {
    int scenes = 0, number = 0;
    std::size_t values = 0;
    for (const std::string& name : installed_scenes()) {
        if (test::sanitized && ++number % 24 != 0) continue;
        const auto outside = doubles_out_of_bounds(name, values);
        if (!outside) continue;
        ++scenes;
        EXPECT_EQ(*outside, 0u) << name;
    }
    EXPECT_GT(scenes, test::sanitized ? 2 : 190);
    EXPECT_GT(values, test::sanitized ? 40u : 4000u);
    EXPECT_GT(doubles_out_of_bounds("bricks-45", values, true).value_or(0), 0u);
}

TEST(Limits, HoldTheLeastThatVulkanAllows) {
    const std::string same_snapping = "hardware=\"vulkan-min\"";
    for (const LimitedScene& what : {plain_texture, thesis_quad_part, offset_part}) {
        const RangeVerdict verdict = verdict_of(render_limited(what, "vulkan", {same_snapping}),
                                                render_limited(what, "", {same_snapping}));
        EXPECT_EQ(verdict.outside, 0u) << what.scene << ": " << verdict.first;
    }
}

/// What a shader that exchanges x and y has for the derivatives of UV.
Film with_swapped_derivatives(Film film) {
    for (const char axis : {'U', 'V'})
        std::swap(plane_of(film, std::string("dUVdx.") + axis).bits,
                  plane_of(film, std::string("dUVdy.") + axis).bits);
    return film;
}

/// What a shader that does not normalise has for the normal of a relief on a flat face that looks
/// at +z: the face's normal less what lies in the face.
Film with_normal_of_any_length(Film film) {
    Plane* const n[3] = {&plane_of(film, "N.X"), &plane_of(film, "N.Y"), &plane_of(film, "N.Z")};
    for (std::size_t i = 0; i < n[0]->bits.size(); ++i) {
        const float z = n[2]->as_float(i);
        for (Plane* const plane : n)
            plane->bits[i] = std::bit_cast<std::uint32_t>(plane->as_float(i) / z);
    }
    return film;
}

/// What a march has that leaves out the step at which it would have ended: the next one.
Film with_missing_step(Film film, int steps) {
    Plane &s = plane_of(film, "hit.s"), &u = plane_of(film, "hit.U"), &v = plane_of(film, "hit.V");
    const auto add = [](Plane& plane, std::size_t i, float by) {
        plane.bits[i] = std::bit_cast<std::uint32_t>(plane.as_float(i) + by);
    };
    const float step = 1.0f / static_cast<float>(steps);
    for (std::size_t i = 0; i < s.bits.size(); ++i) {
        add(s, i, step);
        add(u, i, step * plane_of(film, "K.U").as_float(i));
        add(v, i, step * plane_of(film, "K.V").as_float(i));
    }
    return film;
}

/// Mistakes that shaders are made with, as scenes over the same maps.
struct ShaderMistake {
    const char* what;
    std::vector<std::string> overrides;
};
const ShaderMistake shader_mistakes[] = {
    {"a texture upside down", {"textures.bricks-color.flip_v=true"}},
    {"a colour that is not decoded", {"textures.bricks-color.format=\"unorm8\""}},
    {"light from the wrong point",
     {"lights=[{\"type\":\"point\",\"space\":\"eye\",\"position\":[-10,10,10]}]"}},
    {"a texel beside", {"material.texture_matrix.offset=[0.00390625,0]"}},
    {"a level that is four off", {"textures.bricks-color.lod_bias=4"}},
    {"few steps", {"material.relief.steps=24"}},
    {"a relief without its depth", {"material.relief.depth=0.035"}},
};

void expect_mistakes_found(const LimitedScene& scene, int steps) {
    SCOPED_TRACE(scene.scene);
    const Film ranges = render_limited(scene, "gl");
    for (const ShaderMistake& mistake : shader_mistakes)
        expect_found(verdict_of(ranges, render_limited(scene, "", mistake.overrides)),
                     mistake.what);
    expect_found(verdict_of(ranges, with_missing_step(ranges, steps)), "a missing step");
    expect_found(verdict_of(ranges, with_swapped_derivatives(ranges)), "swapped derivatives");
    expect_found(verdict_of(ranges, with_normal_of_any_length(ranges)), "a normal of any length");
}

TEST(Limits, FindMistakes) { expect_mistakes_found(level_0_part, 128); }

/// Also where the level of detail is anything that OpenGL permits.
TEST(Limits, FindMistakesAtFreeLevels) {
    if (test::sanitized) GTEST_SKIP() << "as above";
    expect_mistakes_found(bricks_part, 256);
}

/// Shares of pixels whose range of a channel is wider than `most`.
double wide_share(const Film& ranges, const std::string& channel, float most) {
    const Plane &low = *ranges.find("gpu.lo." + channel), &high = *ranges.find("gpu.hi." + channel);
    double wide = 0;
    for (std::size_t i = 0; i < low.bits.size(); ++i)
        wide += !(high.as_float(i) - low.as_float(i) <= most);
    return wide / static_cast<double>(low.bits.size());
}

TEST(Limits, AreMostlyDecided) {
    const Film ranges = render_limited(bricks_part, "gl");
    const RangeShares shares = range_shares_of(ranges, "R");
    EXPECT_LE(shares.ambiguous, 0.25);  // of few pixels; over whole scenes, less
    EXPECT_LE(shares.unbounded, 0.01);
    EXPECT_LE(wide_share(ranges, "N.X", 0.2f), 0.25);
    EXPECT_LE(wide_share(ranges, "R", 0.1f), 0.25);
}

/// Where slopes change around a hit, as in most of these pixels, its normal is known by parts of
/// the place.
TEST(Limits, OfNormalsAreNarrowWhereSlopesChange) {
    const Film ranges = render_limited({"stones-45", {160, 320, 168, 322}}, "gl,rho=exact");
    EXPECT_LE(wide_share(ranges, "N.Y", 0.14f), 0.6);
}

TEST(Limits, OfExactArithmeticAreNarrowAndWithinThose) {
    RenderOptions options;
    options.channels = {"bound.lo.uv.U", "bound.hi.uv.U", "bound.lo.K.U", "bound.hi.K.U",
                        "gpu.lo.K.U",    "gpu.hi.K.U",    "K.U"};
    options.window = bricks_part.window;
    options.limits = "gl";
    const Film film = render(load_scene(bricks_part.scene), options);
    for (std::size_t i = 0; i < film.planes[0].bits.size(); ++i) {
        const auto value = [&](const char* name) { return film.find(name)->as_float(i); };
        EXPECT_LE(value("bound.hi.uv.U") - value("bound.lo.uv.U"), 1e-6);
        EXPECT_LE(value("gpu.lo.K.U"), value("bound.lo.K.U"));
        EXPECT_GE(value("gpu.hi.K.U"), value("bound.hi.K.U"));
        EXPECT_NEAR(value("K.U"), value("bound.lo.K.U"), 1e-4);
    }
}

TEST(Limits, AreTheSameOnAnyThreads) {
    RenderOptions options;
    options.channels = {"R", "undecided"};
    options.window = bricks_part.window;
    options.limits = "gl";
    options.threads = 1;
    const Scene scene = load_scene(bricks_part.scene);
    const Film one = render(scene, options);
    options.threads = 3;
    options.tile = 4;
    EXPECT_EQ(one, render(scene, options));
}

TEST(Limits, AreRefusedWhereThereAreNone) {
    const Scene scene = load_scene("rows/qdm-published");
    RenderOptions options;
    options.window = Window{0, 0, 8, 8};
    options.channels = {"R"};
    const auto refuses = [&](const Scene& of) {
        try {
            render(of, options);
        } catch (const UsageError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    options.limits = "gl";
    EXPECT_NE(refuses(scene).find("\"qdm@published\""), std::string::npos);
    options.limits = "metal";
    EXPECT_NE(refuses(scene).find("vulkan, d3d, gl or webgpu"), std::string::npos);
    options.limits = "gl,planes=1";
    EXPECT_NE(refuses(scene).find("plane="), std::string::npos);
    for (const char* const open : {"gl,", "gl,plane=1e-6,", "gl,,plane=1e-6"}) {
        options.limits = open;
        EXPECT_NE(refuses(scene).find("found \"\""), std::string::npos) << open;
    }
    options.limits = "gl,derivatives=some";
    EXPECT_NE(refuses(scene).find("derivatives=quad"), std::string::npos);
    options.limits = "gl,srgb=2";
    EXPECT_NE(refuses(scene).find("number from 0 to 1"), std::string::npos);
    options.limits = "gl,plane=much";
    EXPECT_NE(refuses(scene).find("number"), std::string::npos);
    options.limits = "";
    options.channels = {"gpu.lo.R"};
    EXPECT_NE(refuses(scene).find("--limits"), std::string::npos);
    options.channels = {"gpu.lo.A"};
    EXPECT_NE(refuses(scene).find("channels: found"), std::string::npos);
    options.channels = {"bound.lo"};
    EXPECT_NE(refuses(scene).find("channels: found"), std::string::npos);
    options.channels = {"R"};
    options.limits = "gl";
    EXPECT_NE(refuses(load_scene("msaa-4")).find("one sample"), std::string::npos);
}

}  // namespace
}  // namespace quadrel::render_tests
