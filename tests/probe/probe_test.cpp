// A probe's values are those of the render, bit for bit, and its record of a look-up reproduces it.
#include "quadrel/probe.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "effort.hpp"
#include "probe/planted.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace {

using namespace quadrel;
using Planted = planted::Probe;

Scene small_scene(const std::string& name) { return load_scene(name, {"size=[48,40]"}); }

/// What a probe says of its own pixel: channel name to bits. Empty for background.
std::map<std::string, std::uint32_t> pixel_bits(const ProbeReport& report, int lane) {
    std::map<std::string, std::uint32_t> bits;
    for (const ProbeFragment& fragment : report.fragments) {
        if (fragment.visible[lane] == 0 || !bits.empty()) continue;
        for (const ProbeStage& stage : fragment.stages)
            for (const ProbeValue& value : stage.outputs)
                bits[value.name] =
                    value.integer ? static_cast<std::uint32_t>(value.whole[lane])
                                  : canonical_bits(std::bit_cast<std::uint32_t>(value.real[lane]));
    }
    return bits;
}

/// Every channel of a one-sample render at (x, y) against the probe's bits.
::testing::AssertionResult agrees(const Film& film, int x, int y,
                                  const std::map<std::string, std::uint32_t>& bits) {
    int compared = 0;
    for (const auto& [name, value] : bits) {
        const Plane* plane = film.find(name);
        if (plane == nullptr) continue;
        ++compared;
        if (plane->bits[film.index(x, y)] != value)
            return ::testing::AssertionFailure()
                   << name << " at " << x << "," << y << ": render " << std::hex
                   << plane->bits[film.index(x, y)] << ", probe " << value;
    }
    const bool covered = film.find("A")->as_float(film.index(x, y)) > 0;
    if (covered == bits.empty())
        return ::testing::AssertionFailure() << "coverage differs at " << x << "," << y;
    if (covered && compared < 40)
        return ::testing::AssertionFailure() << "only " << compared << " channels compared";
    return ::testing::AssertionSuccess();
}

Film full_render(const Scene& scene) {
    RenderOptions options;
    for (const ChannelInfo& channel : channel_table())
        if (channel.name.find('<') == std::string::npos && !is_drawn_apart(channel.name))
            options.channels.push_back(channel.name);
    return render(scene, options);
}

class EveryScene : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryScene, ProbeHasTheBitsOfTheRender) {
    const Scene scene = small_scene(GetParam());
    if (scene.samples > 1) GTEST_SKIP() << "resolved channels are not one fragment's";
    const Film film = full_render(scene);
    std::mt19937 random(7);
    for (int i = 0; i < 6; ++i) {
        const int x = static_cast<int>(random() % 48), y = static_cast<int>(random() % 40);
        const ProbeReport report = probe(scene, x, y);
        EXPECT_TRUE(agrees(film, x, y, pixel_bits(report, report.lane)));
    }
}

/// Under the sanitizers, which relief's tests run every row with, without the scenes of rows.
std::vector<std::string> probed_scenes() {
    std::vector<std::string> scenes = installed_scenes();
    if (test::sanitized)
        std::erase_if(scenes, [](const std::string& name) { return name.starts_with("rows/"); });
    return scenes;
}

INSTANTIATE_TEST_SUITE_P(Installed, EveryScene, ::testing::ValuesIn(probed_scenes()),
                         [](const auto& instance) {
                             std::string name = instance.param;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

TEST(Probe, PlantedErrorsAreCaught) {
    const Scene scene = small_scene("bricks-45");
    const Film film = full_render(scene);
    const int x = 17, y = 23;
    const auto caught = [&](Planted error) {
        const ProbeReport report = probe(scene, x, error == Planted::other_row ? 39 - y : y);
        const int lane = error == Planted::neighbour_lane ? report.lane ^ 1 : report.lane;
        auto bits = pixel_bits(report, lane);
        if (error == Planted::one_bit) bits["hit.U"] ^= 1u;
        return !agrees(film, x, y, bits);
    };
    for (const Planted error : {Planted::neighbour_lane, Planted::other_row, Planted::one_bit})
        EXPECT_TRUE(caught(error)) << static_cast<int>(error);
}

/// Weighted taps give the value that the look-up gave, up to rounding.
TEST(Probe, TapsReproduceTheirLookUp) {
    const ProbeReport report = probe(small_scene("bricks-45"), 20, 20);
    ASSERT_FALSE(report.fragments.empty());
    int looked_up = 0;
    for (const ProbeStage& stage : report.fragments[0].stages) {
        for (const ProbeFetch& fetch : stage.fetches) {
            for (int lane = 0; lane < 4; ++lane) {
                if (!fetch.active[lane] || fetch.footprint[lane].taps.empty()) continue;
                double sum = 0;
                for (const TexelTap& tap : fetch.footprint[lane].taps)
                    sum += tap.weight * tap.value[0];
                EXPECT_NEAR(sum, fetch.value[lane][0], 1e-5);
                ++looked_up;
            }
        }
    }
    EXPECT_GT(looked_up, 10);
}

TEST(Probe, EveryStepOfTheMarchIsThere) {
    const ProbeReport report = probe(small_scene("bricks-45"), 20, 20);
    ASSERT_FALSE(report.fragments.empty());
    for (const ProbeStage& stage : report.fragments[0].stages) {
        if (stage.id != "linear") continue;
        const auto steps = std::find_if(stage.outputs.begin(), stage.outputs.end(),
                                        [](const auto& v) { return v.name == "hit.steps"; });
        ASSERT_NE(steps, stage.outputs.end());
        for (int lane = 0; lane < 4; ++lane) {
            int active = 0;
            for (const ProbeStep& step : stage.steps) active += step.active[lane];
            EXPECT_EQ(active, steps->whole[lane]);
        }
        EXPECT_EQ(stage.steps.size(), stage.fetches.size());
        return;
    }
    FAIL() << "no linear stage";
}

TEST(Probe, BackgroundAndOutsideArePlain) {
    const Scene scene = small_scene("thesis-quad");
    EXPECT_TRUE(probe(scene, 0, 0).fragments.empty());
    EXPECT_NE(to_text(probe(scene, 0, 0)).find("background"), std::string::npos);
    EXPECT_THROW(probe(scene, 48, 0), UsageError);
    EXPECT_THROW(probe(scene, 0, -1), UsageError);
}

TEST(Probe, JsonHoldsTheSameBits) {
    const ProbeReport report = probe(small_scene("thesis-sphere"), 24, 20);
    ASSERT_FALSE(report.fragments.empty());
    const auto json = nlohmann::json::parse(to_json(report));
    for (std::size_t s = 0; s < report.fragments[0].stages.size(); ++s) {
        for (const ProbeValue& value : report.fragments[0].stages[s].outputs) {
            const auto& entry = json["fragments"][0]["stages"][s]["outputs"][value.name];
            if (value.integer) continue;
            for (int lane = 0; lane < 4; ++lane)
                EXPECT_EQ(std::stoul(entry["bits"][lane].get<std::string>(), nullptr, 16),
                          std::bit_cast<std::uint32_t>(value.real[lane]));
        }
    }
}

/// The exact derivatives beside the finite ones have the bits of the channels.
TEST(Probe, ExactDerivativesAreThoseOfTheChannels) {
    const Scene scene = small_scene("thesis-quad");
    RenderOptions options;
    options.channels = {"exact.dPdx", "exact.dPdy", "exact.dUVdx", "exact.dUVdy"};
    const Film film = render(scene, options);
    const ProbeReport report = probe(scene, 24, 20);
    ASSERT_EQ(report.fragments.size(), 1u);
    int compared = 0;
    for (const ProbeValue& value : report.fragments[0].derivatives) {
        if (!value.name.starts_with("exact d/d")) continue;
        const std::string axis(1, value.name[9]);
        const std::string component(1, value.name.back());
        const bool of_uv = value.name.find("uv") != std::string::npos;
        const Plane* plane =
            film.find((of_uv ? "exact.dUVd" : "exact.dPd") + axis + "." + component);
        ASSERT_NE(plane, nullptr) << value.name;
        EXPECT_EQ(plane->as_float(film.index(24, 20)), value.real[std::size_t(report.lane)]);
        ++compared;
    }
    EXPECT_EQ(compared, 10);
}

}  // namespace
