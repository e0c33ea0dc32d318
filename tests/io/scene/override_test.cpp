#include "io/document/override.hpp"

#include "io/document/value.hpp"
#include "scene/support.hpp"

namespace quadrel {
namespace {

SceneDocument document() {
    return parse_scene_text(R"({"quadrel": 1, "size": [4, 4],
        "textures": {"bricks": {"file": "b.exr"}},
        "materials": {"wood": {"relief": {"trace": "linear"}}, "stone": {}},
        "objects": [{"mesh": "quad"}]})",
                            "test.json");
}

std::string after(const std::string& assignment) {
    SceneDocument scene = document();
    apply_override(scene, assignment);
    check_scene_keys(scene);
    return scene.root.dump();
}

/// The text of the document after the assignment contains `expected`.
testing::AssertionResult sets(const std::string& assignment, const std::string& expected) {
    const std::string text = after(assignment);
    if (text.find(expected) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << text;
}

testing::AssertionResult refuses(const std::string& assignment, const Complaint& complaint) {
    return complains([&] { after(assignment); }, complaint);
}

TEST(Override, SetsValuesOfEveryKind) {
    EXPECT_TRUE(sets("size=[64,64]", R"("size":[64,64])"));
    EXPECT_TRUE(sets("size[1]=9", R"("size":[4,9])"));
    EXPECT_TRUE(sets("conventions=d3d", R"("conventions":"d3d")"));
    EXPECT_TRUE(sets("camera.fov_y=33", R"("camera":{"fov_y":33})"));
    EXPECT_TRUE(sets("objects[0].mesh=cube", R"("objects":[{"mesh":"cube"}])"));
    EXPECT_TRUE(sets("textures.bricks.mip=none", R"("file":"b.exr","mip":"none")"));
    EXPECT_TRUE(sets("objects[0].name=a=b", R"("name":"a=b")"));
    EXPECT_FALSE(sets("size=[64,64]", R"("size":[4,4])"));
}

TEST(Override, MaterialReachesTheFirstOneWritten) {
    EXPECT_TRUE(
        sets("material.relief.steps=256", R"("wood":{"relief":{"trace":"linear","steps":256}})"));
    EXPECT_TRUE(
        sets("materials.stone.relief.trace=none", R"("stone":{"relief":{"trace":"none"}})"));
}

TEST(Override, AStagesParameterKeepsItsId) {
    EXPECT_TRUE(sets("material.relief.trace.steps=7", R"("trace":{"id":"linear","steps":7})"));
}

TEST(Override, NullRemovesAKey) {
    EXPECT_TRUE(sets("size=null", R"({"quadrel":1,"textures")"));
    EXPECT_TRUE(sets("material.relief.trace=null", R"("wood":{"relief":{}})"));
    EXPECT_TRUE(
        sets("materials.stone=null", R"("materials":{"wood":{"relief":{"trace":"linear"}}})"));
    // What is not there stays away, and nothing is made on the way to it.
    EXPECT_EQ(after("camera.eye=null"), document().root.dump());
    EXPECT_EQ(after("material.relief.trace.steps=null"), document().root.dump());
    EXPECT_TRUE(refuses("sise=null", {"sise", "unknown key", "\"size\""}));
    EXPECT_TRUE(refuses("materials.woood=null", {"materials.woood", "unknown name", "\"wood\""}));
    EXPECT_TRUE(refuses("size[0]=null", {"size[0]", "null for an element", "a key"}));
}

TEST(Override, UnknownPathsAreErrors) {
    EXPECT_TRUE(refuses("sise=3", {"sise", "unknown key", "\"size\""}));
    EXPECT_TRUE(refuses("camera.fov=3", {"camera.fov", "unknown key", "\"fov_y\""}));
    EXPECT_TRUE(
        refuses("textures.brick.mip=none", {"textures.brick", "unknown name", "\"bricks\""}));
    EXPECT_TRUE(refuses("objects[1].mesh=quad", {"objects[1]", "index 1", "less than 1"}));
    EXPECT_TRUE(refuses("size.width=1", {"size.width", "below", ""}));
    EXPECT_TRUE(refuses("camera[0]=1", {"camera[0]", "index", "array"}));
    EXPECT_TRUE(refuses("material.relief.trcae=linear",
                        {"materials.wood.relief.trcae", "unknown", "\"trace\""}));
}

TEST(Override, MalformedAssignmentsAreUsageErrors) {
    for (const char* text : {"size", "=3", "a..b=3", "size[=1", "size[x]=1", "size[1=1", ".a=1"}) {
        SceneDocument scene = document();
        EXPECT_THROW(apply_override(scene, text), UsageError) << text;
    }
}

TEST(Override, ErrorsSayThatTheOptionIsToBlame) {
    SceneDocument scene = document();
    apply_override(scene, "size=[0,4]");
    const SceneValue value(scene, scene.root["size"][0], "size[0]");
    EXPECT_TRUE(complains([&] { value.integer(1, 9); }, {"size[0]", "set by -D", "[1, 9]"}));
    const SceneValue other(scene, scene.root["quadrel"], "quadrel");
    EXPECT_FALSE(complains([&] { other.string(); }, {"quadrel", "set by -D", ""}));
}

}  // namespace
}  // namespace quadrel
