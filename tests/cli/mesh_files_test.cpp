// What the command line says about meshes from files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "film/films.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::TemporaryFolder;
using testing_films::write_bytes;

const std::string meshes = QUADREL_DATA_DIR "/../tests/data/meshes/";

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t times = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++times;
    return times;
}

TEST(MeshFilesCli, IgnoredPartsAreNamedOnce) {
    const TemporaryFolder folder;
    const std::string scene = meshes + "view.json", note = "ignored: EXT_texture_webp\n";
    const Outcome rendered = run({"render", scene, "--size", "4x4"}, folder.path());
    EXPECT_EQ(rendered.code, 0) << rendered.err;
    EXPECT_EQ(count(rendered.err, note), 1u) << rendered.err;
    const Outcome sheet =
        run({"sheet", scene, "--each", "material.shininess=10,20", "--size", "4x4", "-o", "s.png"},
            folder.path());
    EXPECT_EQ(sheet.code, 0) << sheet.err;
    EXPECT_EQ(count(sheet.err, note), 1u) << sheet.err;
    // Commas within brackets do not separate: "[1" would be no colour.
    const auto sheet_of = [&](const std::string& each, const char* out) {
        return run({"sheet", scene, "--each", each, "--size", "4x4", "--columns", "1", "-o", out},
                   folder.path());
    };
    EXPECT_EQ(sheet_of("material.diffuse=[1,0,0,1], [0, 1, 0, 1]", "two.png").code, 0);
    const Outcome open = sheet_of("material.diffuse=[1,0,0,1],[0,1", "no.png");
    EXPECT_NE(open.err.find("found the string \"[0,1\""), std::string::npos) << open.err;
    EXPECT_EQ(sheet_of("material.diffuse=[1,0,0,1],", "no.png").code, 2);
    const Outcome probed = run({"probe", scene, "--pixel", "1,1", "--json"}, folder.path());
    EXPECT_EQ(count(probed.err, note), 1u) << probed.err;
    EXPECT_EQ(count(probed.out, "ignored"), 0u) << "data stays data";
    const Outcome silent = run(
        {"render", scene, "-D", "objects[0].mesh.file=bad.obj", "--size", "4x4"}, folder.path());
    EXPECT_EQ(count(silent.err, "ignored"), 0u) << silent.err;
}

/// Names of a file stay off the terminal's commands.
TEST(MeshFilesCli, NotesArePrintable) {
    const TemporaryFolder folder;
    write_bytes(folder / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n\x1b[2J 1\n");
    write_bytes(folder / "s.json", R"({"quadrel": 1, "objects": [{"mesh": {"file": "m.obj"}}]})");
    const Outcome rendered = run({"render", "s.json", "--size", "4x4"}, folder.path());
    EXPECT_NE(rendered.err.find("m.obj: ignored: ?[2J\n"), std::string::npos) << rendered.err;
    for (const std::vector<std::string>& form :
         {std::vector<std::string>{"info", "m.obj"}, {"info", "m.obj", "--json"}}) {
        const Outcome info = run(form, folder.path());
        EXPECT_EQ(info.code, 0) << info.err;
        EXPECT_EQ(info.out.find('\x1b'), std::string::npos);
        EXPECT_NE(info.out.find("?[2J"), std::string::npos) << info.out;
    }
}

TEST(MeshFilesCli, InfoReadsMeshes) {
    const TemporaryFolder folder;
    const auto info = [&](const std::string& file) {
        const Outcome outcome = run({"info", meshes + file, "--json"}, folder.path());
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    };
    const auto obj = info("half.obj");
    EXPECT_EQ(obj["kind"], "mesh");
    EXPECT_EQ(obj["triangles"], 4);
    EXPECT_EQ(obj["vertices"], 8);
    EXPECT_EQ(obj["uv_sets"], 1);
    EXPECT_EQ(obj["normals"], "flat");
    EXPECT_EQ(obj["bounds"]["min"], nlohmann::json({-1, -1, 0}));
    EXPECT_EQ(obj["bounds"]["max"], nlohmann::json({1, 1, 0}));
    EXPECT_EQ(obj["ignored"], nlohmann::json::array());
    const auto gltf = info("uv1.gltf");
    EXPECT_EQ(gltf["uv_sets"], 2);
    EXPECT_EQ(gltf["normals"], "from the file");
    EXPECT_EQ(gltf["ignored"], nlohmann::json::array({"TEXCOORD_1"}));
    EXPECT_EQ(run({"info", "none.obj"}, folder.path()).code, 3);
}

}  // namespace
}  // namespace quadrel::cli_tests
