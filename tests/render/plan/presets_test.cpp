// Presets: what they choose exists, and a scene that names one is the scene that makes its choices.
#include "quadrel/scene/presets.hpp"

#include <set>

#include "io/document/stage_parameters.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

testing::AssertionResult is_stage(const std::string& id, std::string_view room) {
    const StageInfo* stage = find_stage(id);
    if (stage && stage->text.room == room) return testing::AssertionSuccess();
    return testing::AssertionFailure() << id << " is no stage of the room " << room;
}

/// Stages of the right rooms, parameters that the trace has, values that it takes.
testing::AssertionResult can_be_planned(const Preset& preset) {
    const auto frame = is_stage(preset.frame, "frame"), trace = is_stage(preset.trace, "trace");
    if (!frame) return frame;
    if (!trace) return trace;
    for (const auto& [name, value] : preset.parameters) {
        const ParameterText* parameter = find_parameter(preset.trace, name);
        if (parameter == nullptr) return testing::AssertionFailure() << name;
        if (!number_of(*parameter, value))
            return testing::AssertionFailure() << name << " = " << text_of(value);
    }
    return testing::AssertionSuccess();
}

TEST(Presets, NameWhatExists) {
    std::set<std::string> names;
    for (const Preset& preset : all_presets()) {
        EXPECT_TRUE(can_be_planned(preset)) << preset.name;
        EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
        EXPECT_EQ(find_preset(preset.name), &preset);
        EXPECT_FALSE(preset.summary.empty() || preset.map.empty() || preset.source.empty());
    }
    EXPECT_EQ(find_preset("godot"), nullptr);
    Preset flawed = *find_preset("unity-standard");
    flawed.parameters = {{"scael", 1}};
    EXPECT_FALSE(can_be_planned(flawed));
    flawed.parameters = {{"scale", 1e9}};
    EXPECT_FALSE(can_be_planned(flawed));
    flawed = *find_preset("three-steep");
    flawed.parameters = {{"mode", "stepe"}};
    EXPECT_FALSE(can_be_planned(flawed));
    flawed = {"", "", "", "", "offset-limit", "offset-limit"};
    EXPECT_FALSE(can_be_planned(flawed));
}

Scene preset_scene(const std::string& name, std::vector<std::string> more = {}) {
    more.insert(more.begin(), "material.relief.preset=" + name);
    more.insert(more.begin(), "size=[24, 20]");
    return load_scene("preset", more);
}

testing::AssertionResult shows_the_same(const Scene& a, const Scene& b) {
    const Film of_a = take(render, a, {"hit.U", "hit.V", "hit.steps", "R"}),
               of_b = take(render, b, {"hit.U", "hit.V", "hit.steps", "R"});
    for (std::size_t i = 0; i < of_a.planes.size(); ++i)
        if (of_a.planes[i].bits != of_b.planes[i].bits)
            return testing::AssertionFailure() << of_a.planes[i].name;
    return testing::AssertionSuccess();
}

TEST(Presets, AreTheirChoices) {
    for (const Preset& preset : all_presets()) {
        const Scene named = preset_scene(preset.name);
        Scene chosen = preset_scene("unity-standard");
        Material& material = chosen.materials.front();
        material.frame = {preset.frame, {}, ""};
        material.trace = {preset.trace, preset.parameters, ""};
        EXPECT_TRUE(shows_the_same(named, chosen)) << preset.name;
        material.trace = {"trace-none", {}, ""};
        EXPECT_FALSE(shows_the_same(named, chosen)) << preset.name;
    }
}

TEST(Presets, KeysOfTheSceneReplaceThem) {
    const Material trace =
        preset_scene("unity-standard", {"material.relief.trace=linear"}).materials.front();
    EXPECT_EQ(trace.trace.id, "linear");
    EXPECT_TRUE(trace.trace.parameters.empty());
    EXPECT_EQ(trace.frame.id, find_preset("unity-standard")->frame);
    EXPECT_EQ(trace.shadow.id, "none");
    const Material scale =
        preset_scene("unity-standard", {"material.relief.scale=0.07"}).materials.front();
    EXPECT_EQ(scale.trace.id, find_preset("unity-standard")->trace);
    EXPECT_EQ(scale.trace.parameters.at("scale"), 0.07);
    const Material mapped =
        preset_scene("unity-standard",
                     {R"(material={"normal": {"file": "../textures/obstacles_color.exr"},)"
                      R"( "relief": {"preset": "unity-standard"}})"})
            .materials.front();
    EXPECT_EQ(mapped.surface.id, "normal-map");
}

/// What a film records of the search, in the names that scenes have.
std::string recorded_search(const Scene& scene) {
    for (const auto& [name, text] : render_attributes(scene, {}))
        if (name == "quadrel:algorithm") return text;
    return "";
}

TEST(Presets, FilmsHaveTheNamesOfValues) {
    const char* const named = R"(.mode":"occlusion")";
    EXPECT_NE(recorded_search(preset_scene("three-occlusion")).find(named), std::string::npos);
    const Scene numbered = preset_scene("three-steep", {"material.relief.mode=2"});
    EXPECT_NE(recorded_search(numbered).find(named), std::string::npos)
        << recorded_search(numbered);
    EXPECT_EQ(recorded_search(preset_scene("three-steep")).find(named), std::string::npos);
}

TEST(Presets, UnknownNamesAreRefused) {
    try {
        preset_scene("unity-standart");
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_EQ(error.key, "material.relief.preset");
        EXPECT_NE(error.expected.find("\"unity-standard\""), std::string::npos);
    }
}

}  // namespace
}  // namespace quadrel::render_tests
