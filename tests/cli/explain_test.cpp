// quadrel explain, and lists with filters: all that has a name, from the tables that check it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "io/document/keys.hpp"
#include "quadrel/bake/bake.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/scene/presets.hpp"

namespace quadrel::cli_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using Words = std::vector<std::string>;

/// A name and what must be said of it.
struct Documented {
    std::string name, meaning;
};

std::string plain(std::string_view markdown) {
    std::string text(markdown);
    std::erase(text, '`');
    return text;
}

/// All of them by one command.
AssertionResult explains(const std::vector<Documented>& all) {
    Words words = {"explain"};
    for (const Documented& one : all) words.push_back(one.name);
    const Outcome outcome = run(words);
    if (outcome.code != 0) return AssertionFailure() << outcome.err;
    for (const Documented& one : all)
        if (outcome.out.find(one.meaning) == std::string::npos)
            return AssertionFailure() << one.name << ": " << one.meaning;
    return AssertionSuccess();
}

TEST(Explain, EverySceneKey) {
    std::vector<Documented> all;
    for (const SceneKey& row : scene_keys()) {
        const std::string name = std::string(row.section) + "." + std::string(row.key);
        all.push_back({name, plain(row.meaning)});
        all.push_back({name, plain(row.value)});
    }
    EXPECT_TRUE(explains(all));
    EXPECT_FALSE(explains({{"camera.zoom", ""}}));
    EXPECT_FALSE(explains({{"camera.fov_y", "horizontal angle"}}));
}

TEST(Explain, EveryChannelStagePresetAndKind) {
    std::vector<Documented> all;
    for (const ChannelInfo& channel : channel_table())
        if (channel.name.find('<') == std::string::npos)
            all.push_back({channel.name, channel.meaning});
    for (const StageInfo& stage : all_stages()) {
        all.push_back({stage.text.id, stage.text.summary});
        all.push_back({stage.text.id, stage.text.source});
        for (const ParameterText& p : stage.parameters) all.push_back({p.name, p.meaning});
    }
    for (const Preset& preset : all_presets()) all.push_back({preset.name, preset.summary});
    for (const BakeKindInfo& kind : bake_kinds()) all.push_back({kind.name, kind.text});
    EXPECT_TRUE(explains(all));
}

TEST(Explain, PathsAsScenesHaveThem) {
    EXPECT_TRUE(explains({{"material.relief.depth", "thickness of the relief"},
                          {"materials.wall.relief.depth", "thickness of the relief"},
                          {"objects[0].transform[1].rotate", "counter-clockwise"},
                          {"textures.bricks.mip", "how levels are made"},
                          {"material.relief.steps", "steps over the relief's depth"},
                          {"material.relief.trace", "cone-cell"},
                          {"material.relief.frag_depth", "frag-depth"},
                          {"camera", "fov_y"},
                          {"hit", "hit.status"},
                          {"shadow.2.visibility", "visibility of light"}}));
    for (const char* word : {"material.reliev", "objects[0].colour", "camera.steps", "x.y", "."})
        EXPECT_EQ(run({"explain", word}).code, 2) << word;
    // Of a trace alone, not what a shadow has under the same name.
    const std::string of_trace = run({"explain", "material.relief.steps"}).out;
    EXPECT_EQ(of_trace.find("shadow-march"), std::string::npos) << of_trace;
}

std::size_t lines_of(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(List, Filters) {
    const std::string cone = run({"list", "algorithms", "cone"}).out;
    EXPECT_NE(cone.find("cone-cell"), std::string::npos);
    EXPECT_EQ(cone.find("parallax-bias"), std::string::npos);
    EXPECT_EQ(
        run({"list", "algorithms", "CONE", "cell", "--json"}).out.find("\"id\": \"cone-step\""),
        std::string::npos);
    EXPECT_LT(lines_of(run({"list", "channels", "hit"}).out), channel_table().size());
    EXPECT_EQ(lines_of(run({"list", "presets", "Godot"}).out), 3 * 2u);
    const Outcome none = run({"list", "presets", "Quake"});
    EXPECT_EQ(none.code, 0);
    EXPECT_EQ(none.out, "");
    EXPECT_NE(none.err, "");
    EXPECT_EQ(nlohmann::json::parse(run({"list", "presets", "Quake", "--json"}).out).size(), 0u);
}

/// The reasons are those of `export --list`.
TEST(List, WhyAStageIsNoShader) {
    const std::string reason = "proves what it finds, by intervals and rationals";
    const std::string block = run({"list", "algorithms", "oracle-block"}).out;
    EXPECT_NE(block.find("not a shader: " + reason), std::string::npos) << block;
    const std::string linear = run({"list", "algorithms", "linear-thesis"}).out;
    EXPECT_EQ(linear.find("not a shader"), std::string::npos) << linear;
    for (const auto& row : nlohmann::json::parse(run({"list", "algorithms", "--json"}).out)) {
        ASSERT_TRUE(row.contains("not_a_shader")) << row["id"];
        if (row["id"] == "linear") {
            EXPECT_EQ(row["not_a_shader"], "");
        }
        if (row["id"] == "oracle-block") {
            EXPECT_EQ(row["not_a_shader"], reason);
        }
    }
    EXPECT_TRUE(explains({{"oracle-block", "not a shader: " + reason},
                          {"linear", "a shader: quadrel export --stage linear"}}));
}

TEST(List, NamesOfValues) {
    const char* const names = "mode = relief (0 basic, 1 steep, 2 occlusion, 3 relief)";
    const std::string text = run({"list", "algorithms", "three-parallax"}).out;
    EXPECT_NE(text.find(names), std::string::npos) << text;
    EXPECT_NE(text.find("max_layers = 25 (1 to "), std::string::npos) << text;
    EXPECT_TRUE(explains({{"material.relief.mode", names}, {"three-steep", "mode=steep"}}));
    const auto stages =
        nlohmann::json::parse(run({"list", "algorithms", "ParallaxShader", "basic", "--json"}).out);
    ASSERT_EQ(stages.size(), 1u);
    EXPECT_EQ(stages[0]["parameters"][0]["names"]["occlusion"], 2);
    EXPECT_EQ(stages[0]["parameters"][1]["names"].size(), 0u);
    const auto presets =
        nlohmann::json::parse(run({"list", "presets", "three-steep", "--json"}).out);
    EXPECT_EQ(presets[0]["parameters"]["mode"], "steep");
}

TEST(List, NumberTypesOfStages) {
    std::map<std::string, nlohmann::json> types;
    for (const auto& stage : nlohmann::json::parse(run({"list", "algorithms", "--json"}).out))
        types[stage["id"]] = stage["number_types"];
    EXPECT_EQ(types["frame-gram"], nlohmann::json({"float", "double", "dual"}));
    EXPECT_EQ(types["shade-thesis"], nlohmann::json({"float", "double", "dual"}));
    EXPECT_EQ(types["shadow-oracle"], nlohmann::json({"float", "double"}));
}

TEST(List, ScenesSayWhatTheyShow) {
    const auto json = nlohmann::json::parse(run({"list", "scenes", "--json"}).out);
    EXPECT_EQ(json.size(), installed_scenes().size());
    for (const auto& scene : json) EXPECT_GT(scene["description"].size(), 0u) << scene["name"];
    const std::string text = run({"list", "scenes", "brick"}).out;
    EXPECT_NE(text.find("A brick wall at 45 degrees"), std::string::npos) << text;
    EXPECT_EQ(text.find("dunes-70"), std::string::npos);
}

}  // namespace
}  // namespace quadrel::cli_tests
