// What users get wrong, as the command line sees it: one line that says what is where, the right
// exit code, and nothing left behind.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/bad_input_files.hpp"

namespace quadrel::cli_tests {
namespace {

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

TEST_F(BadInputs, SceneFiles) {
    write_bytes(folder / "truncated.json", R"({"quadrel": 1, "size": [4, 4], "cam)");
    write_bytes(folder / "comma.json", "{\"quadrel\": 1,\n \"size\": [4,, 4]}");
    write_bytes(folder / "twice.json", "{\"quadrel\": 1,\n \"size\": [4, 4],\n \"size\": [4, 4]}");
    write_bytes(folder / "bytes.json", std::string("\x89PNG\r\n\x1a\n\0\0", 10));
    write_bytes(folder / "deep.json", R"({"quadrel": 1, "a": )" + std::string(5000, '['));
    write_bytes(folder / "first.json", R"({"size": [4, 4], "quadrel": 1})");
    write_bytes(folder / "newer.json", R"({"quadrel": 2})");
    std::filesystem::create_directory(folder / "folder");
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    write_bytes(folder / "s.glib", "Perspective 70\nShpere 1 2 3\n");
    const std::vector<BadInput> files = {
        {"missing", {"none.json"}, 3, {"none.json: ", "no such file"}},
        {"no such name", {"none"}, 3, {"none", "no installed scene", "`quadrel list scenes`"}},
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
        {"an image", {"bytes.json"}, 3, {"bytes.json: ", "a PNG image", "a scene"}},
        {"another image", {"h.exr"}, 3, {"h.exr: ", "an EXR image", "a scene"}},
        {"a mesh", {"good.obj"}, 3, {"good.obj: ", "a mesh", "a scene"}},
        {"a pipe by a bare name", {"pipe"}, 3, {"pipe: ", "a pipe", "./pipe"}},
        {"a folder by a bare name", {"folder"}, 3, {"folder: ", "a directory", "a scene"}},
        {"a file by a bare name", {"empty"}, 3, {"empty: ", "without extension", "./empty"}},
        {"nearly a name", {"thesis-teapo"}, 3, {"\"thesis-teapot\" (see `quadrel list scenes`)"}},
        {"part of a name", {"linear"}, 3, {"\"rows/linear\""}},
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

/// JSON has no word for them; whatever brings one, the message names it and its key.
TEST_F(BadInputs, NumbersThatAreNone) {
    for (const char* word : {"NaN", "nan", "Infinity", "-Infinity", "-inf", "-NaN"}) {
        EXPECT_TRUE(refuses(
            word, "\"camera\": {\"height\": " + std::string(word) + "}",
            {"s.json:2:22: camera.height: found " + std::string(word) + ",", "a finite number"}));
        EXPECT_TRUE(refuses(word, "\"background\": [1, " + std::string(word) + ", 0]",
                            {"s.json:2:19: background[1]: found " + std::string(word) + ","}));
    }
    EXPECT_TRUE(refuses("another word", R"("background": [1, nanny, 0])", {"s.json:2:", "JSON"}));
    EXPECT_TRUE(refuses("a key", R"(NaN: 1)", {"s.json:2:", "object key"}));
    EXPECT_TRUE(refuses("1e999", R"("background": [-1e999, 0, 0])",
                        {"s.json:2:16: background[0]: found the number -1e999,", "float64"}));
    scene("");
    const auto set = [&](const std::string& assignment, const std::string& says) {
        return refuses({assignment, {"render", "s.json", "-D", assignment}, 3, {says, "by -D"}});
    };
    EXPECT_TRUE(set("camera.fov_y=NaN", "camera.fov_y: found NaN ("));
    EXPECT_TRUE(set("camera.fov_y=-inf", "camera.fov_y: found -inf ("));
    EXPECT_TRUE(set("camera.fov_y=1e999", "camera.fov_y: found the number 1e999 ("));
    EXPECT_TRUE(set("samples=NaN", "samples: found NaN ("));
    EXPECT_TRUE(set("material.relief.steps=NaN", "material.relief.steps: found NaN ("));
    EXPECT_TRUE(set("material.relief.trace={\"id\": \"linear\", \"steps\": NaN}",
                    "material.relief.trace.steps: found NaN ("));
    EXPECT_TRUE(set("material.relief.trace={\"id\": \"linear\", \"steps\": \"many\"}",
                    "material.relief.trace.steps: found the string \"many\" ("));
    EXPECT_TRUE(set("material.relief.trce=steep", "found an unknown key ("));
    EXPECT_TRUE(set("camera.eye=[NaN,0,1]", "camera.eye[0]: found NaN ("));
    EXPECT_TRUE(
        set("camera={\"eye\": [0, 0, -1e999]}", "camera.eye[2]: found the number -1e999 ("));
    EXPECT_TRUE(set("camera={\"near\": 1, \"near\": 2}", "camera.near: found the key a second"));
    renders(R"("objects": [{"mesh": "quad"}])", {"-D", "objects[0].name=NaN"});
}

TEST_F(BadInputs, NamesThatTheSceneDoesNotHave) {
    scene("");
    EXPECT_TRUE(refuses({"none",
                         {"render", "s.json", "-D", "textures.t.file=h.exr"},
                         3,
                         {"textures.t: ", "-D 'textures={\"t\": {...}}' adds it"}}));
    renders(R"("objects": [{"mesh": "quad"}])",
            {"-D", R"(textures={"t": {"file": "h.exr"}})", "-D", "material.color=t"});
}

TEST_F(BadInputs, FilesThatAreNoImages) {
    write_bytes(folder / "a.xyz", "not an image");
    for (const char* name : {"a.xyz", "text.png", "good.obj"}) {
        const BadInput bad{name,
                           {"mips", name, "-o", "m"},
                           3,
                           {std::string(name) + ": ", "no image format that is known", "TIFF"}};
        EXPECT_TRUE(refuses(bad));
    }
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    for (const std::vector<std::string>& line : std::vector<std::vector<std::string>>{
             {"info", "pipe"}, {"mips", "pipe", "-o", "m"}, {"compare", "pipe", "pipe"}})
        EXPECT_TRUE(refuses({line[0], line, 3, {"pipe: ", "a pipe"}}));
    for (const char* name : {"pipe", "."})
        EXPECT_TRUE(refuses({"plugin",
                             {"render", scene(""), "--plugin", name},
                             3,
                             {name == std::string(".") ? "a directory" : "a pipe", "a plugin"}}));
}

TEST_F(BadInputs, SizesAndWindows) {
    for (const char* size : {"0", "65537", "-1", "1.5", "1e300", "\"8\""}) {
        write_bytes(folder / "s.json",
                    "{\"quadrel\": 1, \"size\": [8, " + std::string(size) + "]}");
        EXPECT_TRUE(refuses({size, {"render", "s.json"}, 3, {"s.json:1:", "size[1]: ", "65536"}}));
    }
    write_bytes(folder / "s.json", R"({"quadrel": 1, "size": [65536, 65536]})");
    EXPECT_TRUE(
        refuses({"17 GB", {"sheet", "s.json", "-o", "s.png"}, 3, {"size: ", "2^31 values"}}));
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

/// What could not be rendered is not described as if it could.
TEST_F(BadInputs, InfoOfAScene) {
    write_bytes(folder / "stage.json",
                R"({"quadrel": 1, "material": {"relief": {"trace": "linearr"}},
                    "objects": [{"mesh": {"shape": "quad"}}]})");
    EXPECT_TRUE(complains(run({"info", "stage.json"}, folder.path()),
                          {"", {}, 3, {"relief.trace", "unknown stage \"linearr\""}}));
}

/// Whose squares are no floats any more.
TEST_F(BadInputs, DepthsBeyondFloats) {
    const auto scene = [](const std::string& depth) {
        return R"({"quadrel": 1, "material": {"relief": {"depth": )" + depth + "}}}";
    };
    for (const char* depth : {"3e38", "1e13", R"({"thickness": 1e30, "tile": 1e-3})"}) {
        write_bytes(folder / "deep.json", scene(depth));
        EXPECT_TRUE(complains(run({"render", "deep.json"}, folder.path()),
                              {"", {}, 3, {"deep.json", "relief.depth", "expected"}}))
            << depth;
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
