// What users get wrong, as the command line sees it: one line that says what is where, the right
// exit code, and nothing left behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/bad_input.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"
#include "texture/files.hpp"

namespace quadrel::cli_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

TEST(BadInputCheck, CanFail) {
    const BadInput bad{"", {}, 3, {"key", "found"}};
    EXPECT_TRUE(complains({3, "", "quadrel: key: found 1\n"}, bad));
    EXPECT_FALSE(complains({4, "", "quadrel: key: found 1\n"}, bad));
    EXPECT_FALSE(complains({3, "x", "quadrel: key: found 1\n"}, bad));
    EXPECT_FALSE(complains({3, "", "quadrel: key\n"}, bad));
    EXPECT_FALSE(complains({3, "", "key: found 1\n"}, bad));
    EXPECT_FALSE(complains({3, "", "quadrel: key: found 1\nand more\n"}, bad));
    EXPECT_FALSE(complains({3, "", "quadrel: key: found \x1b[2J\n"}, bad));
}

/// One channel "Y" of these values, row by row.
void write_heights(const std::filesystem::path& file, int width, int height,
                   const std::vector<float>& values) {
    Film film{{0, 0, width, height}, {0, 0, width, height}, {}};
    film.add("Y", ChannelType::float32);
    for (std::size_t i = 0; i < film.planes[0].bits.size(); ++i)
        film.planes[0].bits[i] = std::bit_cast<std::uint32_t>(values[i % values.size()]);
    write_exr(file, film, {});
}

const std::string corners = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
const std::string face = "f 1/1 2/2 3/3\n";

class BadInputs : public testing::Test {
  protected:
    BadInputs() {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        constexpr float infinity = std::numeric_limits<float>::infinity();
        write_heights(folder / "h.exr", 4, 4, {0.5f, 0.75f, 0.25f});
        write_heights(folder / "nan.exr", 3, 2, {1, 1, 1, 1, nan, 1});
        write_heights(folder / "infinite.exr", 3, 2, {1, 1, infinity, 1, 1, 1});
        write_heights(folder / "one.exr", 1, 1, {0.5f});
        write_heights(folder / "column.exr", 1, 13, {0.5f, 0.25f});
        write_heights(folder / "odd.exr", 7, 5, {0.5f, 0.25f});
        const std::string whole = file_bytes(folder / "h.exr");
        write_bytes(folder / "truncated.exr", whole.substr(0, whole.size() / 2));
        write_bytes(folder / "header.exr", whole.substr(0, 60));
        write_bytes(folder / "empty", "");
        write_bytes(folder / "empty.exr", "");
        write_bytes(folder / "text.png", "this is no image");
        const auto png = test::make_png(8, 8, 8, test::PngColour::grey, std::string(64, 'x'));
        write_bytes(folder / "truncated.png", png.substr(0, png.size() - 30));
        write_bytes(folder / "good.obj", corners + face);
        write_bytes(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        write_bytes(folder / "nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
        write_bytes(folder / "beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
        write_bytes(folder / "none.obj", "# nothing\n");
        write_bytes(folder / "mesh.stl", "solid\n");
        write_bytes(folder / "text.glb", "not glTF");
        write_bytes(folder / "truncated.glb", std::string("glTF\2\0\0\0\xff\0\0\0", 12));
    }

    /// A scene of these members, in a file of its own.
    std::string scene(const std::string& members, const std::string& name = "s.json") const {
        const std::string rest = members.empty() ? "" : ",\n" + members;
        write_bytes(folder / name, "{\"quadrel\": 1, \"size\": [16, 16]" + rest + "}");
        return name;
    }
    static std::string relief(const std::string& texture) {
        return "\"material\": {\"height\": {" + texture + "}}, \"objects\": [{\"mesh\": \"quad\"}]";
    }
    static std::string with_mesh(const std::string& file) {
        return "\"objects\": [{\"mesh\": {\"file\": \"" + file + "\"}}]";
    }

    /// Whether `render` refuses the scene, leaving the folder as it was.
    AssertionResult refuses(const std::string& what, const std::string& members,
                            const std::vector<std::string>& says) const {
        return refuses({what, {"render", scene(members), "-o", "out.exr"}, 3, says});
    }
    AssertionResult refuses(const BadInput& bad) const {
        const std::size_t before = folder.count();
        const AssertionResult result = complains(run(bad.arguments, folder.path()), bad);
        if (result && folder.count() != before)
            return AssertionFailure() << bad.what << ": something is left behind";
        return result;
    }
    /// Renders; the output, or nothing and a failure.
    Film renders(const std::string& members, std::vector<std::string> options = {}) const {
        options.insert(options.begin(), {"render", scene(members), "-o", "out.exr"});
        const Outcome outcome = run(options, folder.path());
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.code == 0 ? read_exr(folder / "out.exr").film : Film{};
    }

    TemporaryFolder folder;
};

TEST_F(BadInputs, SceneFiles) {
    write_bytes(folder / "truncated.json", R"({"quadrel": 1, "size": [4, 4], "cam)");
    write_bytes(folder / "comma.json", "{\"quadrel\": 1,\n \"size\": [4,, 4]}");
    write_bytes(folder / "twice.json", "{\"quadrel\": 1,\n \"size\": [4, 4],\n \"size\": [4, 4]}");
    write_bytes(folder / "bytes.json", std::string("\x89PNG\r\n\x1a\n\0\0", 10));
    write_bytes(folder / "deep.json", R"({"quadrel": 1, "a": )" + std::string(5000, '['));
    write_bytes(folder / "first.json", R"({"size": [4, 4], "quadrel": 1})");
    write_bytes(folder / "newer.json", R"({"quadrel": 2})");
    write_bytes(folder / "s.glib", "Perspective 70\nShpere 1 2 3\n");
    const std::vector<BadInput> files = {
        {"missing", {"none.json"}, 3, {"none.json: ", "no such file"}},
        {"no such name", {"none"}, 3, {"none", "no installed scene"}},
        {"a long name", {std::string(300, 'n')}, 3, {"no installed scene"}},
        {"a long file", {std::string(300, 'n') + ".json"}, 3, {"no such file"}},
        {"control characters", {"a\n\x1b[2J.json"}, 3, {"a \\x1b[2J.json: ", "no such file"}},
        {"a directory", {"./"}, 3, {"a directory"}},
        {"a device", {"/dev/zero"}, 3, {"/dev/zero: ", "a device"}},
        {"empty", {"empty.exr"}, 3, {"empty.exr:1:1: "}},
        {"empty without extension", {"./empty"}, 3, {"empty:1:1: "}},
        {"truncated", {"truncated.json"}, 3, {"truncated.json:1:"}},
        {"a comma too many", {"comma.json"}, 3, {"comma.json:2:13: ", "','"}},
        {"a key twice", {"twice.json"}, 3, {"twice.json:3:2: size: ", "second time"}},
        {"an image", {"bytes.json"}, 3, {"bytes.json:1:1: "}},
        {"deep brackets", {"deep.json"}, 3, {"deep.json", "nested"}},
        {"version not first", {"first.json"}, 3, {"first.json:1:2: size: "}},
        {"another version", {"newer.json"}, 3, {"newer.json:1:2: quadrel: ", "2"}},
        {"an unknown command", {"s.glib"}, 3, {"s.glib:2:1: Shpere: ", "\"Sphere\""}},
    };
    for (BadInput bad : files)
        for (const char* verb : {"render", "probe"}) {
            bad.arguments.insert(bad.arguments.begin(), verb);
            if (std::string(verb) == "probe")
                bad.arguments.insert(bad.arguments.end(), {"--pixel", "1,1"});
            EXPECT_TRUE(refuses(bad)) << verb;
            bad.arguments = {bad.arguments[1]};
        }
}

TEST_F(BadInputs, Values) {
    EXPECT_TRUE(refuses("a string", R"("samples": "four")", {"s.json:2:1: samples: ", "\"four\""}));
    EXPECT_TRUE(refuses("an object", R"("background": {})", {"background: ", "an object"}));
    EXPECT_TRUE(refuses("null", R"("camera": null)", {"camera: ", "null"}));
    EXPECT_TRUE(refuses("1e999", R"("background": [1e999, 0, 0])", {"s.json:2:", "1e999"}));
    EXPECT_TRUE(refuses("1e39", R"("background": [1e39, 0, 0])", {"background[0]: ", "float32"}));
    EXPECT_TRUE(refuses("an unknown key", R"("sise": 1)", {"s.json:2:1: sise: ", "\"size\""}));
    const auto stage = [](const std::string& relief) {
        return "\"material\": {\"relief\": {" + relief + "}}, \"objects\": [{\"mesh\": \"quad\"}]";
    };
    EXPECT_TRUE(refuses("an unknown stage", stage(R"("trace": "liner")"),
                        {"material.relief.trace: ", "\"liner\"", "\"linear\""}));
    EXPECT_TRUE(refuses("an unknown shade",
                        R"("material": {"shade": "phong"}, "objects": [{"mesh": "quad"}])",
                        {"material.shade: ", "\"phong\""}));
    EXPECT_TRUE(refuses("an unknown mesh", R"("objects": [{"mesh": "qaud"}])",
                        {"objects[0].mesh: ", "\"qaud\"", "\"quad\""}));
    EXPECT_TRUE(refuses("an unknown material", R"("objects": [{"mesh": "quad", "material": "x"}])",
                        {"objects[0].material: ", "\"x\""}));
    EXPECT_TRUE(refuses("nine lights", R"("objects": [{"mesh": "quad"}], "lights":
        [{}, {}, {}, {}, {}, {}, {}, {}, {}])",
                        {"lights: ", "9 lights", "at most 8"}));
    EXPECT_TRUE(refuses("relief without heights", stage(R"("trace": "linear")"),
                        {"s.json: material.height: ", "nothing"}));
    EXPECT_TRUE(refuses("relief without heights, named",
                        R"("materials": {"stone": {"relief": {"trace": "linear"}}},
                           "objects": [{"mesh": "quad"}])",
                        {"s.json: materials.stone.height: ", "nothing"}));
}

TEST_F(BadInputs, SizesAndWindows) {
    for (const char* size : {"0", "65537", "-1", "1.5", "1e300", "\"8\""}) {
        write_bytes(folder / "s.json",
                    "{\"quadrel\": 1, \"size\": [8, " + std::string(size) + "]}");
        EXPECT_TRUE(refuses({size, {"render", "s.json"}, 3, {"s.json:1:", "size[1]: ", "65536"}}));
    }
    write_bytes(folder / "s.json", R"({"quadrel": 1, "size": [65536, 65536]})");
    EXPECT_TRUE(refuses({"17 GB", {"render", "s.json"}, 3, {"size: ", "2^31 values"}}));
    write_bytes(folder / "s.json", R"({"quadrel": 1, "size": [8, 8]})");
    for (const char* size : {"0x8", "8x65537", "8", "8x", "axb", "-8x8"})
        EXPECT_TRUE(refuses({size, {"render", "s.json", "--size", size}, 2, {"--size", size}}));
    for (const char* window : {"0,0,9,8", "8,0,9,8", "-1,0,4,4", "0,0,0,4", "4,4,2,2", "0,0,8"})
        EXPECT_TRUE(refuses({window, {"render", "s.json", "--window", window}, 2, {"window"}}));
    EXPECT_TRUE(refuses({"-D", {"render", "s.json", "-D", "size"}, 2, {"KEY=VALUE"}}));
    EXPECT_TRUE(refuses({"-D", {"render", "s.json", "-D", "size=[0,1]"}, 3, {"size[0]", "-D"}}));
    EXPECT_TRUE(refuses({"-D", {"render", "s.json", "-D", "sise=1"}, 3, {"sise", "\"size\""}}));
}

TEST_F(BadInputs, Cameras) {
    const auto camera = [&](const std::string& members, const std::vector<std::string>& says) {
        return refuses(members, "\"camera\": {" + members + "}", says);
    };
    EXPECT_TRUE(
        camera(R"("eye": [0, 2, 0])", {"s.json:2:", "camera: ", "along the line of sight"}));
    EXPECT_TRUE(camera(R"("up": [0, 0, 0])", {"camera: ", "another direction"}));
    EXPECT_TRUE(camera(R"("eye": [0, 0, 0])", {"camera: ", "same place"}));
    EXPECT_TRUE(camera(R"("near": 5, "far": 5)", {"camera.near: ", "near < far"}));
    EXPECT_TRUE(camera(R"("near": 9, "far": 5)", {"camera.near: ", "near < far"}));
    EXPECT_TRUE(camera(R"("near": 0)", {"camera.near: ", "> 0"}));
    EXPECT_TRUE(camera(R"("fov_y": 180)", {"camera.fov_y: ", "180"}));
    const std::string ones = "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]";
    const std::string singular = "[1,0,0,0,1,0,0,0,0,0,1,0,0,0,0,1]";
    const std::string matrices = R"("type": "matrices", )";
    EXPECT_TRUE(camera(matrices + "\"view\": " + singular + ", \"projection\": " + ones,
                       {"camera.view: ", "singular"}));
    EXPECT_TRUE(camera(matrices + "\"view\": " + ones + ", \"projection\": " + singular,
                       {"camera.projection: ", "singular"}));
    EXPECT_TRUE(refuses("a singular transform",
                        "\"objects\": [{\"mesh\": \"quad\", \"transform\": " + singular + "}]",
                        {"objects[0].transform: ", "singular"}));
    EXPECT_TRUE(refuses("scaled by 0",
                        R"("objects": [{"mesh": "quad", "transform": [{"scale": [1, 1, 0]}]}])",
                        {"objects[0].transform[0].scale: ", "other than 0"}));
}

TEST_F(BadInputs, Textures) {
    const auto file = [&](const std::string& name, const std::vector<std::string>& says) {
        return refuses(name, relief("\"file\": \"" + name + "\""), says);
    };
    EXPECT_TRUE(file("none.exr", {"s.json:2:", "material.height.file: ", "no such file"}));
    EXPECT_TRUE(file(".", {"material.height.file: ", "a directory"}));
    EXPECT_TRUE(file("/dev/zero", {"material.height.file: ", "a device"}));
    EXPECT_TRUE(file("empty.exr", {"empty.exr: material.height: ", "an empty file"}));
    EXPECT_TRUE(file("header.exr", {"header.exr: material.height: "}));
    EXPECT_TRUE(file("truncated.exr", {"truncated.exr: material.height: "}));
    EXPECT_TRUE(file("text.png", {"text.png: material.height: "}));
    EXPECT_TRUE(file("truncated.png", {"truncated.png: material.height: "}));
    EXPECT_TRUE(file("good.obj", {"good.obj: material.height: "}));
    EXPECT_TRUE(refuses("channels", relief(R"("file": "h.exr", "swizzle": "a")"),
                        {"h.exr: material.height: ", "\"a\""}));
}

TEST_F(BadInputs, TexelsThatAreNoNumbers) {
    EXPECT_TRUE(refuses(
        "NaN", relief(R"("file": "nan.exr")"),
        {"nan.exr: material.height: ", "NaN in channel 0", "column 1, row 1", "(1 such values)"}));
    EXPECT_TRUE(refuses("infinity", relief(R"("file": "infinite.exr")"),
                        {"infinite.exr: material.height: ", "infinity", "column 2, row 0"}));
    EXPECT_TRUE(refuses("allow_nan is false", relief(R"("file": "nan.exr", "allow_nan": false)"),
                        {"NaN in channel 0"}));
    EXPECT_TRUE(refuses("allow_nan is no boolean", relief(R"("file": "nan.exr", "allow_nan": 1)"),
                        {"material.height.allow_nan: ", "true or false"}));
}

TEST_F(BadInputs, TexelsThatAreNoNumbersWhereAllowed) {
    constexpr int hit = 1, nan_status = 6;
    for (const char* trace : {"linear", "linear-thesis"}) {
        const Film film =
            renders(R"("material": {"relief": {"trace": ")" + std::string(trace) +
                        R"("}, "height": {"file": "nan.exr", "allow_nan": true, "min": "nearest",
                           "mag": "nearest"}}, "objects": [{"mesh": "quad"}])",
                    {"--channels", "hit.status,A", "--stats", "stats.json"});
        const Plane* status = film.find("hit.status");
        ASSERT_NE(status, nullptr);
        const auto count = [&](std::uint32_t wanted) {
            return std::count(status->bits.begin(), status->bits.end(), wanted);
        };
        EXPECT_GT(count(nan_status), 10) << trace;
        EXPECT_GT(count(hit), 10) << trace;
        const auto stats = nlohmann::json::parse(file_bytes(folder / "stats.json"));
        EXPECT_EQ(stats["textures"][0]["non_finite"], 1) << stats;
    }
    renders(relief(R"("file": "h.exr", "allow_nan": true)"), {"--stats", "stats.json"});
    const auto stats = nlohmann::json::parse(file_bytes(folder / "stats.json"));
    EXPECT_EQ(stats["textures"][0]["non_finite"], 0);
}

TEST_F(BadInputs, Meshes) {
    const auto file = [&](const std::string& name, const std::vector<std::string>& says) {
        return refuses(name, with_mesh(name), says);
    };
    EXPECT_TRUE(file("none/x.obj", {"objects[0].mesh.file: ", "no such file"}));
    EXPECT_TRUE(file("mesh.stl", {"mesh.stl: ", "\".stl\"", ".obj"}));
    EXPECT_TRUE(file("none.obj", {"none.obj: ", "no faces"}));
    EXPECT_TRUE(file("nan.obj", {"nan.obj:2:1: ", "\"nan\"", "a finite number"}));
    EXPECT_TRUE(file("beyond.obj", {"beyond.obj:4:1: ", "position index 4", "of the 3"}));
    EXPECT_TRUE(file("text.glb", {"text.glb: ", "glTF 2.0"}));
    EXPECT_TRUE(file("truncated.glb", {"truncated.glb: ", "glTF 2.0"}));
    EXPECT_TRUE(refuses("no uvs",
                        R"("material": {"color": {"file": "h.exr"}}, )" + with_mesh("bare.obj"),
                        {"objects[0].mesh: ", "without texture coordinates"}));
}

/// Whether something was drawn, finite but for Z beyond it.
AssertionResult draws(const Film& film) {
    const Plane* alpha = film.find("A");
    const Plane* red = film.find("R");
    if (!alpha || !red) return AssertionFailure() << "no film";
    std::size_t covered = 0;
    for (std::size_t i = 0; i < red->bits.size(); ++i) {
        if (!std::isfinite(std::bit_cast<float>(red->bits[i])))
            return AssertionFailure() << "not finite at " << i;
        covered += alpha->bits[i] != 0;
    }
    return covered > 0 ? AssertionSuccess() : AssertionFailure() << "nothing is drawn";
}

TEST_F(BadInputs, SmallAndOddTexturesAreFine) {
    EXPECT_FALSE(draws(Film{}));
    EXPECT_FALSE(draws(renders(R"("objects": [])"))) << "nothing to draw";
    for (const char* name : {"one.exr", "column.exr", "odd.exr"})
        EXPECT_TRUE(draws(renders(relief("\"file\": \"" + std::string(name) + "\"")))) << name;
}

TEST_F(BadInputs, DegenerateTrianglesAreDrawnOrCounted) {
    const auto with = [&](const std::string& faces) {
        write_bytes(folder / "d.obj", corners + face + faces);
        return R"("material": {"height": {"file": "h.exr"}}, )" + with_mesh("d.obj");
    };
    const auto zero_area = [&] {
        return nlohmann::json::parse(file_bytes(folder / "stats.json"))["primitives"]["zero_area"];
    };
    EXPECT_TRUE(draws(renders(with(""), {"--stats", "stats.json"})));
    EXPECT_EQ(zero_area(), 0);
    EXPECT_TRUE(draws(renders(with("f 1/1 1/1 2/2\nf 1/1 2/2 1/3\n"), {"--stats", "stats.json"})));
    EXPECT_EQ(zero_area(), 2);
    // All uvs equal, or on a line: no frame can be made of them, yet something is there.
    for (const char* faces : {"f 1/1 2/1 3/1\n", "vt 2 0\nf 1/1 2/2 3/4\n"}) {
        write_bytes(folder / "d.obj", corners + faces);
        EXPECT_TRUE(
            draws(renders(R"("material": {"height": {"file": "h.exr"}}, )" + with_mesh("d.obj"))))
            << faces;
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
