// What -D leaves of a stage that it replaces.
#include "io/document/replaced.hpp"

#include "io/document/override.hpp"
#include "quadrel/scene/load.hpp"
#include "scene/support.hpp"

namespace quadrel {
namespace {

struct After {
    std::string text;
    std::vector<std::string> notes;
};

/// A material of `relief` after the assignments.
After after(const std::string& relief, const std::vector<std::string>& assignments) {
    SceneDocument document =
        parse_scene_text(R"({"quadrel": 1, "material": {"relief": )" + relief + "}}", "test.json");
    const Json before = document.root;
    for (const std::string& assignment : assignments) apply_override(document, assignment);
    After result;
    result.notes = drop_replaced_parameters(before, document);
    result.text = document.root["material"]["relief"].dump();
    return result;
}

TEST(Replaced, ParametersOfTheOldStageAloneAreDropped) {
    // `iterations` is secant's, `steps` both stages'.
    const After result = after(R"({"trace": "secant", "steps": 9, "iterations": 3, "depth": 1})",
                               {"material.relief.trace=steep"});
    EXPECT_EQ(result.text, R"({"trace":"steep","steps":9,"depth":1})");
    ASSERT_EQ(result.notes.size(), 1u);
    EXPECT_NE(result.notes[0].find("iterations"), std::string::npos);
    EXPECT_EQ(result.notes[0].find("steps"), std::string::npos);
    EXPECT_NE(result.notes[0].find("steep"), std::string::npos);
}

TEST(Replaced, InEachOfTheirPlaces) {
    EXPECT_EQ(
        after(R"({"trace": {"id": "secant", "iterations": 3}})", {"material.relief.trace.id=steep"})
            .text,
        R"({"trace":{"id":"steep"}})");
    EXPECT_EQ(after(R"({"trace": "secant", "iterations": 3})", {"material.relief.trace=none"}).text,
              R"({"trace":"none"})");
    EXPECT_EQ(after(R"({"preset": "unity-hdrp", "lod_threshold": 3})",
                    {"material.relief.preset=godot-deep"})
                  .text,
              R"({"preset":"godot-deep"})");
    EXPECT_EQ(after(R"({"steps": 3})", {"material.relief.trace=offset-limit"}).text,
              R"({"trace":"offset-limit"})");
}

TEST(Replaced, MistakesStay) {
    // Of neither stage, set by -D itself, or beside an unknown stage.
    const std::string file = R"({"trace": "secant", "iterations": 3, "stepz": 9})";
    EXPECT_NE(after(file, {"material.relief.trace=steep"}).text.find("stepz"), std::string::npos);
    EXPECT_NE(after(file, {"material.relief.iterations=4", "material.relief.trace=steep"})
                  .text.find("iterations"),
              std::string::npos);
    EXPECT_NE(after(file, {"material.relief.trace=step"}).text.find("iterations"),
              std::string::npos);
    // Nothing is replaced.
    EXPECT_EQ(after(file, {"material.relief.trace=secant"}).text,
              R"({"trace":"secant","iterations":3,"stepz":9})");
    EXPECT_TRUE(after(file, {"material.relief.steps=4"}).notes.empty());
}

TEST(Replaced, ScenesSayWhatTheyLost) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.json", R"({"quadrel": 1, "materials": {
        "a": {"relief": {"trace": "secant", "iterations": 3}}, "b": {"relief": {"trace": "secant", "iterations": 4}}}})");
    EXPECT_TRUE(load_scene(file).notes.empty());
    const Scene scene = load_scene(file, {"material.relief.trace=steep"});
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_NE(scene.notes[0].find("materials.a.relief"), std::string::npos) << scene.notes[0];
    EXPECT_TRUE(scene.materials[0].trace.parameters.empty());
    EXPECT_EQ(scene.materials[1].trace.parameters.count("iterations"), 1u);
}

}  // namespace
}  // namespace quadrel
