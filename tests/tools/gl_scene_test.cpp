// quadrel-gl FOLDER: what a folder says is what is drawn. The folders are made by hand, of shaders
// whose results are known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "film/films.hpp"
#include "quadrel/film/exr.hpp"
#include "tools/program.hpp"

namespace quadrel::tools_tests {
namespace {

using Json = nlohmann::json;
using testing_films::TemporaryFolder;

constexpr int width = 8, height = 6;

template <class T>
void write_values(const std::filesystem::path& file, const std::vector<T>& values) {
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(values.data()),
                 static_cast<std::streamsize>(values.size() * sizeof(T)));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

constexpr const char* manifest_text = R"({
  "quadrel-export": 1,
  "scene": {"file": "none.json", "hash": "0123", "overrides": []},
  "language": "glsl", "size": [8, 6], "samples": 1, "hardware": "exact",
  "state": {"clip_origin": "lower-left", "clip_depth": "negative-one-to-one",
            "first_row": "bottom", "depth_range": [0, 1], "depth_test": "less", "depth_clear": 1,
            "front_face": "ccw"},
  "expected": "expected.exr",
  "vertex_buffer": {"file": "vertices.bin", "stride": 16, "count": 8, "attributes": [
    {"name": "position", "location": 0, "components": 3, "offset": 0},
    {"name": "which", "location": 1, "components": 1, "offset": 12}]},
  "index_buffer": {"file": "indices.bin", "count": 12},
  "textures": [{"name": "map", "kind": "2d",
    "gl": {"internal_format": "R32F", "format": "RED", "type": "FLOAT"},
    "levels": [{"width": 2, "height": 2, "bytes": "map.0.bin"},
               {"width": 1, "height": 1, "bytes": "map.1.bin"}]}],
  "materials": [{"name": "m", "vertex": "m.vert", "fragment": "m.frag", "cull": "none",
    "samplers": [{"uniform": "map", "texture": 0, "wrap": ["repeat", "clamp-to-edge"],
                  "mag": "nearest", "min": "nearest", "mip": "nearest", "border": [0, 0, 0, 0],
                  "lod_bias": 0, "lod_min": -1000, "lod_max": 1000}],
    "uniforms": [{"name": "number", "type": "vec2", "count": 0, "values": [-0.0, null],
                  "hex": ["-0x0p+0", "inf"]}]}],
  "uniforms": [{"name": "absent", "type": "float", "count": 0, "values": [1], "hex": ["0x1p+0"]}],
  "draws": [
    {"object": "near", "material": 0, "first_index": 0, "index_count": 6, "uniforms": []},
    {"object": "far", "material": 0, "first_index": 6, "index_count": 6, "uniforms": []}],
  "passes": [
    {"targets": [
      {"clear": [0.5, 0.25, 0.125, 0], "channels": [
        {"name": "R", "type": "float"}, {"name": "G", "type": "float"},
        {"name": "B", "type": "float"}, {"name": "A", "type": "float"}]},
      {"clear": [0, 0, 0, 0], "channels": [
        {"name": "uv.U", "type": "float"}, {"name": "uv.V", "type": "float"},
        {"name": "id.object", "type": "uint"}, null]}]},
    {"targets": [
      {"clear": [0, 0, 0, 0], "channels": [
        {"name": "K.U", "type": "float"}, {"name": "K.V", "type": "float"},
        {"name": "Z", "type": "float"}, {"name": "hit.status", "type": "uint"}]}]}]
})";

constexpr const char* vertex_text = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in float which;
out float object;
void main() {
    gl_Position = vec4(position, 1.0);
    object = which;
}
)";

constexpr const char* fragment_text = R"(#version 330 core
#ifndef PASS
#define PASS 0
#endif
uniform vec2 number;
uniform sampler2D map;
in float object;
layout(location = 0) out vec4 target0;
layout(location = 1) out vec4 target1;
float texel(vec2 uv, float level) { return textureLod(map, uv, level).x; }
void main() {
    vec2 at = gl_FragCoord.xy;
#if PASS == 0
    target0 = vec4(texel(vec2(0.75, 0.25), 0.0), texel(vec2(0.25, 0.75), 0.0),
                   texel(vec2(1.25, 1.75), 0.0), 1.0);
    target1 = vec4(at, object, 0.0);
#else
    target0 = vec4(number, texel(vec2(0.5), 1.0), 5.0);
#endif
}
)";

/// A rectangle from the frame's lower left corner to the middle of its width and clip y `top`.
void append_rectangle(std::vector<float>& vertices, float top, float z, float which) {
    for (const auto& [x, y] : std::array<std::pair<float, float>, 4>{
             {{-1.0f, -1.0f}, {0.0f, -1.0f}, {0.0f, top}, {-1.0f, top}}})
        vertices.insert(vertices.end(), {x, y, z, which});
}

/// A folder whose triangles cover the left half of the frame: object 2, and over its lower half
/// object 1, which is nearer. Pass 0 writes places and the texture's texels, pass 1 uniforms.
class Folder {
  public:
    Folder() {
        std::vector<float> vertices;
        append_rectangle(vertices, 0, 0.25f, 1);
        append_rectangle(vertices, 1, 0.5f, 2);
        write_values(path / "vertices.bin", vertices);
        write_values(path / "indices.bin",
                     std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
        write_values(path / "map.0.bin", std::vector<float>{1, 2, 3, 4});
        // Only its bits tell it from 10.
        write_values(path / "map.1.bin", std::vector<float>{std::nextafter(10.0f, 11.0f)});
        write_text(path / "m.vert", vertex_text);
        write_text(path / "m.frag", fragment_text);
    }

    /// Draws; the exit code and what was said.
    Outcome draw(const std::string& options = "") const {
        write_text(path / "manifest.json", manifest.dump());
        return run_command("ASAN_OPTIONS=detect_leaks=0 " QUADREL_GL " --llvmpipe " +
                           path.path().string() + " -o " + output() + " " + options + " 2>&1");
    }
    std::string output() const { return (path / "out.exr").string(); }

    TemporaryFolder path;
    Json manifest = Json::parse(manifest_text);
};

class GlScene : public testing::Test {
  protected:
    /// The film, or a skipped test where there is nothing to draw with.
    Film draw(const std::string& options = "") {
        const Outcome outcome = folder.draw(options);
        if (outcome.code == 3 && outcome.out.find("EGL") != std::string::npos)
            skipped = outcome.out;
        if (!skipped.empty()) return {};
        EXPECT_EQ(outcome.code, 0) << outcome.out;
        return outcome.code == 0 ? read_exr(folder.output()).film : Film();
    }
    float at(const Film& film, const char* channel, int x, int y) const {
        return film.find(channel)->as_float(film.index(x, y));
    }
    Folder folder;
    std::string skipped;
};

TEST_F(GlScene, IsDrawnAsItsFolderSays) {
    const Film film = draw();
    if (!skipped.empty()) GTEST_SKIP() << skipped;
    ASSERT_EQ(film.window, (Window{0, 0, width, height}));
    EXPECT_EQ(film.planes.size(), 11u);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            SCOPED_TRACE(testing::Message() << x << "," << y);
            const bool covered = x < width / 2;
            const bool near = y >= height / 2;  // image rows run down
            ASSERT_EQ(at(film, "A", x, y), covered ? 1 : 0);
            EXPECT_EQ(at(film, "R", x, y), covered ? 2 : 0.5f);
            EXPECT_EQ(at(film, "G", x, y), covered ? 3 : 0.25f);
            EXPECT_EQ(at(film, "B", x, y), covered ? 3 : 0.125f);  // repeated in u, clamped in v
            EXPECT_EQ(at(film, "uv.U", x, y), covered ? static_cast<float>(x) + 0.5f : 0);
            EXPECT_EQ(at(film, "uv.V", x, y),
                      covered ? static_cast<float>(height - 1 - y) + 0.5f : 0);
            EXPECT_EQ(film.find("id.object")->bits[film.index(x, y)], !covered ? 0xffffffffu
                                                                      : near   ? 1u
                                                                               : 2u);
            EXPECT_EQ(film.find("K.U")->bits[film.index(x, y)], covered ? 0x80000000u : 0u);
            EXPECT_EQ(at(film, "K.V", x, y), covered ? INFINITY : 0);
            EXPECT_EQ(at(film, "Z", x, y), covered ? std::nextafter(10.0f, 11.0f) : INFINITY);
            EXPECT_EQ(film.find("hit.status")->bits[film.index(x, y)], covered ? 5u : 0u);
        }
}

/// A triangle over a part of some pixels' samples: colour, coverage and Z are of all samples, other
/// values of the lowest covered one.
TEST_F(GlScene, SamplesAreResolved) {
    folder.manifest["samples"] = 4;
    folder.manifest["passes"][1]["targets"][0]["clear"][2] = "inf";
    // Below the diagonal, which passes through pixels; all other triangles are points.
    std::vector<float> vertices{-1, -1, 0.25f, 1, 1, -1, 0.25f, 1, 1, 1, 0.25f, 1};
    vertices.resize(32, 0);
    write_values(folder.path / "vertices.bin", vertices);
    const Film film = draw();
    if (!skipped.empty()) GTEST_SKIP() << skipped;
    int partial = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            SCOPED_TRACE(testing::Message() << x << "," << y);
            const float share = at(film, "A", x, y);
            EXPECT_EQ(share * 4, std::floor(share * 4));
            EXPECT_NEAR(at(film, "R", x, y), share * 2 + (1 - share) * 0.5f, 1e-6);
            EXPECT_EQ(film.find("id.object")->bits[film.index(x, y)], share > 0 ? 1u : 0xffffffffu);
            EXPECT_EQ(at(film, "K.V", x, y), share > 0 ? INFINITY : 0);
            EXPECT_EQ(at(film, "Z", x, y), share > 0 ? std::nextafter(10.0f, 11.0f) : INFINITY);
            partial += share > 0 && share < 1;
        }
    EXPECT_GT(partial, 5);
}

TEST_F(GlScene, TheHeaderNamesTheImplementation) {
    draw();
    if (!skipped.empty()) GTEST_SKIP() << skipped;
    const Attributes attributes = read_exr(folder.output()).attributes;
    EXPECT_NE(attributes.at("quadrel:gl.renderer").find("llvmpipe"), std::string::npos);
    EXPECT_FALSE(attributes.at("quadrel:gl.version").empty());
    EXPECT_EQ(attributes.at("quadrel:sceneHash"), "0123");
}

TEST_F(GlScene, OnePassAlone) {
    const Film film = draw("--pass 1");
    if (!skipped.empty()) GTEST_SKIP() << skipped;
    EXPECT_EQ(film.planes.size(), 4u);
    EXPECT_NE(film.find("hit.status"), nullptr);
    EXPECT_EQ(folder.draw("--pass 2").code, 2);
}

/// States that turn the picture round or leave a part of it out.
TEST_F(GlScene, StatesAreSet) {
    Json& state = folder.manifest["state"];
    state["depth_test"] = "greater";
    state["depth_clear"] = 0;
    Film film = draw();
    if (!skipped.empty()) GTEST_SKIP() << skipped;
    EXPECT_EQ(film.find("id.object")->bits[film.index(0, height - 1)], 2u);
    state["depth_test"] = "less";
    state["depth_clear"] = 1;
    state["first_row"] = "top";
    EXPECT_EQ(at(draw(), "uv.V", 0, 0), 0.5f);
    state["clip_origin"] = "upper-left";
    film = draw();
    EXPECT_EQ(film.find("id.object")->bits[film.index(0, 0)], 2u);
    state["clip_origin"] = "lower-left";
    folder.manifest["materials"][0]["cull"] = "back";
    EXPECT_EQ(at(draw(), "A", 0, 0), 1);
    state["front_face"] = "cw";
    EXPECT_EQ(at(draw(), "A", 0, 0), 0);
}

TEST_F(GlScene, AShaderThatDoesNotCompileIsShownByItsLine) {
    std::string broken = fragment_text;
    broken.replace(broken.find("vec2 at = gl_FragCoord.xy"), 25, "vec2 at = gl_FragCoord.xyw");
    write_text(folder.path / "m.frag", broken);
    const Outcome outcome = folder.draw();
    if (outcome.out.find("EGL") != std::string::npos) GTEST_SKIP() << outcome.out;
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.out.find("m.frag"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("line 12:     vec2 at = gl_FragCoord.xyw;"), std::string::npos)
        << outcome.out;
    EXPECT_FALSE(std::filesystem::exists(folder.output()));
}

/// Each mistake in a folder is named by the place that it stands in.
TEST_F(GlScene, WhatIsWrongWithAFolderIsNamed) {
    const Json good = folder.manifest;
    const auto refuses = [&](const char* pointer, const Json& value, const std::string& says) {
        folder.manifest = good;
        folder.manifest[Json::json_pointer(pointer)] = value;
        const Outcome outcome = folder.draw();
        if (outcome.out.find("EGL") != std::string::npos) return testing::AssertionSuccess();
        if (outcome.code != 3 || outcome.out.find(says) == std::string::npos)
            return testing::AssertionFailure() << pointer << ": " << outcome.code << outcome.out;
        return std::filesystem::exists(folder.output()) ? testing::AssertionFailure() << "output"
                                                        : testing::AssertionSuccess();
    };
    EXPECT_TRUE(refuses("/quadrel-export", 2, "quadrel-export"));
    EXPECT_TRUE(refuses("/language", "hlsl", "language"));
    EXPECT_TRUE(refuses("/samples", 3, "samples"));
    EXPECT_TRUE(refuses("/vertex_buffer/count", 7, "vertices.bin"));
    EXPECT_TRUE(refuses("/textures/0/levels/1/bytes", "map.0.bin", "map.0.bin: found 16 bytes"));
    EXPECT_TRUE(refuses("/textures/0/levels/1/bytes", "none.bin", "none.bin"));
    EXPECT_TRUE(refuses("/materials/0/fragment", "../m.frag", "materials[0].fragment"));
    EXPECT_TRUE(
        refuses("/materials/0/uniforms/0/hex/1", "0x1p", "materials[0].uniforms[0].hex[1]"));
    EXPECT_TRUE(refuses("/materials/0/samplers/0/texture", 1, "materials[0].samplers[0].texture"));
    EXPECT_TRUE(refuses("/draws/1/index_count", 7, "draws[1].index_count"));
    EXPECT_TRUE(refuses("/draws/1/index_count", 5, "draws[1].index_count"));
    EXPECT_TRUE(refuses("/index_buffer/count", 13, "indices.bin"));
    EXPECT_TRUE(refuses("/vertex_buffer/stride", 2, "vertex_buffer.stride"));
    EXPECT_TRUE(refuses("/vertex_buffer/stride", 18, "vertex_buffer.stride"));
    EXPECT_TRUE(refuses("/vertex_buffer/attributes/0/components", 5,
                        "vertex_buffer.attributes[0].components"));
    EXPECT_TRUE(refuses("/passes/0/targets/0/channels", Json::array(), "passes[0].targets[0]"));
    EXPECT_TRUE(refuses("/passes", Json::array(), "passes"));
    EXPECT_TRUE(refuses("/passes/1/targets", Json::array(), "passes[1].targets"));
    EXPECT_TRUE(refuses("/passes/1/targets", Json(40, good["passes"][1]["targets"][0]),
                        "found 40 targets, expected 8 at most"));
    EXPECT_TRUE(refuses("/materials", Json::array(), "draws[0].material"));
    EXPECT_TRUE(refuses("/textures", Json::array(), "materials[0].samplers[0].texture"));
    Json levels = good["textures"][0]["levels"];
    levels.push_back(levels[1]);
    levels[2]["width"] = 2;
    EXPECT_TRUE(refuses("/textures/0/levels", levels, "map.1.bin"));
    folder.manifest = good;
    folder.manifest["vertex_buffer"]["count"] = 4;
    std::filesystem::resize_file(folder.path / "vertices.bin", 64);
    const Outcome beyond = folder.draw();
    if (beyond.out.find("EGL") == std::string::npos) {
        EXPECT_EQ(beyond.code, 3);
        EXPECT_NE(beyond.out.find("indices.bin: found index 6 of vertex 4"), std::string::npos)
            << beyond.out;
    }
    folder.manifest = good;
    EXPECT_EQ(run_command(QUADREL_GL " /nowhere -o /tmp/none.exr 2>&1").code, 3);
    EXPECT_EQ(run_command(QUADREL_GL " " + folder.path.path().string() + " 2>&1").code, 2);
}

/// Nothing of the folder is written over, also what the program itself does not read.
TEST_F(GlScene, FilesOfTheFolderAreKept) {
    folder.manifest["files"] = {"manifest.json", "expected.exr"};
    write_text(folder.path / "manifest.json", folder.manifest.dump());
    const std::string file = (folder.path / "expected.exr").string();
    write_text(file, fragment_text);
    const Outcome png =
        run_command(QUADREL_GL " --llvmpipe " + folder.path.path().string() + " -o x.png 2>&1");
    EXPECT_EQ(png.code, 2) << png.out;
    const Outcome outcome = run_command(QUADREL_GL " --llvmpipe " + folder.path.path().string() +
                                        " -o " + file + " 2>&1");
    if (outcome.out.find("EGL") != std::string::npos) GTEST_SKIP() << outcome.out;
    EXPECT_EQ(outcome.code, 2) << outcome.out;
    EXPECT_EQ(testing_films::file_bytes(file), fragment_text);
}

}  // namespace
}  // namespace quadrel::tools_tests
