// Parameters whose values have names: numbers and names are one scene, other names are refused.
#include "io/document/choices.hpp"

#include "quadrel/scene/load.hpp"
#include "scene/support.hpp"

namespace quadrel {
namespace {

enum class Planted { none, defaults_unknown, presets_unknown, rooms_unknown };

std::string scene_of(const std::string& material) {
    return R"({"quadrel": 1, "material": {"height": {"file": "h.exr"}, )" + material + "}}";
}

/// A material's part of the document with names for numbers. A planted error does not see where
/// its stage is named.
std::string named(const std::string& material, Planted planted = Planted::none) {
    std::string text = scene_of(material);
    const auto erase = [&](const std::string& word) {
        const std::size_t at = text.find(word);
        if (at != std::string::npos) text.erase(at, word.size());
    };
    if (planted == Planted::defaults_unknown) erase(R"("height": {"file": "h.exr"}, )");
    if (planted == Planted::presets_unknown) erase(R"("preset": "three-steep", )");
    if (planted == Planted::rooms_unknown) erase(R"("id": "bump-blinn", )");
    SceneDocument document = parse_scene_text(text, "test.json");
    name_choices(document);
    return document.root["material"].dump();
}

struct Named {
    const char *material, *part;
};
constexpr Named rows[] = {
    {R"("relief": {"trace": "three-parallax", "mode": 1, "min_layers": 1})",
     R"("mode":"steep","min_layers":1)"},
    {R"("relief": {"trace": {"id": "babylon", "right_handed": 1.0}})", R"("right_handed":"on")"},
    {R"("relief": {"preset": "three-steep", "mode": 2})", R"("mode":"occlusion")"},
    {R"("relief": {"frame": {"split": 1}})", R"("split":"oblique")"},
    {R"("relief": {"surface": {"id": "bump-blinn", "differences": 0}})", R"("differences":"quad")"},
    {R"("shade": {"id": "shade-debug", "view": 2})", R"("view":"K")"},
    {R"("relief": {"surface": {"id": "normal-map", "green": -1}})", R"("green":"down")"},
    {R"("relief": {"trace": "three-parallax", "mode": 4})", R"("mode":4)"},
};

testing::AssertionResult are_named(Planted planted = Planted::none) {
    for (const Named& row : rows) {
        const std::string text = named(row.material, planted);
        if (text.find(row.part) == std::string::npos) return testing::AssertionFailure() << text;
    }
    return testing::AssertionSuccess();
}

TEST(Choices, NumbersGetTheirNames) {
    EXPECT_TRUE(are_named());
    for (const Planted planted :
         {Planted::defaults_unknown, Planted::presets_unknown, Planted::rooms_unknown})
        EXPECT_FALSE(are_named(planted));
}

class ChoicesOfFiles : public testing::Test {
  protected:
    Scene load(const std::string& material, const std::vector<std::string>& overrides = {}) const {
        folder.write("h.exr", "heights");
        return load_scene(folder.write("scene.json", scene_of(material)), overrides);
    }
    testing::AssertionResult refuses(const std::string& material, const Complaint& complaint,
                                     const std::vector<std::string>& overrides = {}) const {
        return complains([&] { load(material, overrides); }, complaint);
    }
    TemporaryFolder folder;
};

TEST_F(ChoicesOfFiles, ANumberAndItsNameAreOneScene) {
    const char* const number = R"("relief": {"trace": "three-parallax", "mode": 1})";
    const char* const name = R"("relief": {"trace": "three-parallax", "mode": "steep"})";
    const Scene a = load(number), b = load(name), other = load(number, {"material.relief.mode=2"});
    EXPECT_EQ(a.canonical, b.canonical);
    EXPECT_EQ(a.materials[0].trace.parameters, b.materials[0].trace.parameters);
    EXPECT_NE(a.canonical, other.canonical);
    EXPECT_EQ(other.canonical, load(name, {"material.relief.mode=occlusion"}).canonical);
    // With the stage, its parameters go.
    EXPECT_EQ(load(name, {"material.relief.trace=linear"}).materials[0].trace.parameters.size(),
              0u);
    EXPECT_EQ(load(R"("relief": {"trace": {"id": "three-parallax", "mode": "steep"}})",
                   {"material.relief.trace.id=linear"})
                  .materials[0]
                  .trace.id,
              "linear");
}

TEST_F(ChoicesOfFiles, OtherNamesAreRefused) {
    const std::string trace = R"("relief": {"trace": "three-parallax")";
    const char* const mode = "material.relief.mode";
    EXPECT_TRUE(refuses("\n" + trace + R"(, "mode": "stepe"})",
                        {mode, R"("stepe")", R"("steep", or one of basic, steep)", 2}));
    EXPECT_TRUE(
        refuses(trace + "}", {mode, "set by -D", "\"relief\""}, {"material.relief.mode=releif"}));
    EXPECT_TRUE(refuses(trace + R"(, "mode": true})", {mode, "true", "0 basic, 1 steep"}));
    EXPECT_TRUE(refuses(trace + R"(, "mode": ""})", {mode, "string", "one of basic"}));
    EXPECT_TRUE(refuses(trace + R"(, "max_layers": "many"})",
                        {"material.relief.max_layers", "many", "an integer in [1, "}));
    // Of another stage, and of none.
    EXPECT_TRUE(refuses(R"("relief": {"trace": {"id": "babylon", "right_handed": "down"}})",
                        {"material.relief.trace.right_handed", "down", "one of off, on"}));
    EXPECT_TRUE(refuses(trace + R"(, "mood": "steep"})",
                        {"material.relief.mood", "the string \"steep\"", "trace"}));
    EXPECT_FALSE(refuses(trace + R"(, "mode": "steep"})", {mode, "", ""}));
}

}  // namespace
}  // namespace quadrel
