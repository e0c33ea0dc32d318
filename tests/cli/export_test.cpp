// quadrel export as a command.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/process.hpp"
#include "film/films.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using Words = std::vector<std::string>;

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(ExportCommand, WritesAFunctionWithItsParametersByName) {
    const Outcome outcome = run({"export", "--stage", "trace/linear", "-D", "steps=64"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.out, "#version 330 core\n"));
    EXPECT_TRUE(says(outcome.out, "// Source: "));
    EXPECT_TRUE(says(outcome.out, "uniform sampler2D height_map;\n"));
    EXPECT_TRUE(says(outcome.out, "const int steps = 64;"));
    EXPECT_TRUE(says(outcome.out, "for (int i = 0; i <= steps; ++i) {")) << outcome.out;
    EXPECT_EQ(run({"export", "--stage", "linear", "-D", "steps=64"}).out, outcome.out);
    const std::string hlsl = run({"export", "--stage", "linear", "--language", "hlsl"}).out;
    EXPECT_TRUE(says(hlsl, "height_map.SampleGrad(height_map_sampler, ")) << hlsl;
    const std::string wgsl = run({"export", "--stage", "linear", "--language", "wgsl"}).out;
    EXPECT_TRUE(says(wgsl, "textureSampleGrad(height_map, height_map_sampler, ")) << wgsl;
    EXPECT_TRUE(says(wgsl, ") -> TraceLinear {")) << wgsl;
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

/// What a text computes by a function of its own is one in the shader, under its name.
TEST(ExportCommand, HelpersAreFunctions) {
    const std::string text = run({"export", "--stage", "max-mip"}).out;
    EXPECT_EQ(count_of(text, "\nfloat max_mip_exit("), 1u) << text;
    EXPECT_GE(count_of(text, " = max_mip_exit("), 2u) << text;
    const std::string wgsl = run({"export", "--stage", "max-mip", "--language", "wgsl"}).out;
    EXPECT_EQ(count_of(wgsl, "\nfn max_mip_exit("), 1u) << wgsl;
}

TEST(ExportCommand, UniformsStandForParameters) {
    for (const char* const stage : {"linear", "steep", "pom", "relief-binary"}) {
        const std::string text = run({"export", "--stage", stage, "--uniforms"}).out;
        EXPECT_TRUE(says(text, "uniform int ")) << text;
        EXPECT_FALSE(says(text, "const int steps")) << text;
    }
    // Their values are no part of the text, but said beside it.
    const std::string plain = run({"export", "--stage", "linear", "--uniforms"}).out;
    std::string with = run({"export", "--stage", "linear", "--uniforms", "-D", "steps=77"}).out;
    const std::size_t at = with.find(", here 77\n");
    ASSERT_NE(at, std::string::npos) << with;
    EXPECT_EQ(with.erase(at, 9), plain);
}

/// Uniforms of two functions are one where they mean the same alone.
TEST(ExportCommand, UniformsOfTwoStagesStayTwo) {
    const auto of_both = [](const char* language) {
        return run({"export", "--stage", "linear", "--stage", "steep", "--uniforms", "--language",
                    language})
            .out;
    };
    const std::string glsl = of_both("glsl"), wgsl = of_both("wgsl");
    for (const char* const stage : {"linear", "steep"}) {
        const std::string name = std::string("trace_") + stage + "_steps";
        EXPECT_EQ(count_of(glsl, "uniform int " + name + ";"), 1u) << glsl;
        EXPECT_EQ(count_of(wgsl, "    " + name + ": i32,"), 1u) << wgsl;
        EXPECT_TRUE(says(wgsl, "uniforms." + name)) << wgsl;
    }
    EXPECT_TRUE(says(glsl, "i <= trace_linear_steps;")) << glsl;
    EXPECT_FALSE(says(glsl, "int steps;")) << glsl;
    EXPECT_EQ(count_of(glsl, "uniform sampler2D height_map;"), 1u) << glsl;
}

/// Before anything else but the version.
TEST(ExportCommand, BeginsWithWhatItTakesForGranted) {
    const std::string glsl = run({"export", "--stage", "max-mip"}).out;
    EXPECT_TRUE(glsl.starts_with("#version 330 core\n// For a relief whose seat is 1")) << glsl;
    const std::string wgsl = run({"export", "--stage", "max-mip", "--language", "wgsl"}).out;
    EXPECT_TRUE(wgsl.starts_with("// For a relief whose seat is 1")) << wgsl;
}

TEST(ExportCommand, SaysWhatParametersAreAndWhichAreWrittenIn) {
    const std::string text = run({"export", "--stage", "linear"}).out;
    EXPECT_TRUE(says(text, "; 1 to ")) << text;
    const std::string babylon = run({"export", "--stage", "babylon"}).out;
    EXPECT_TRUE(says(babylon, "// Written for ")) << babylon;
}

TEST(ExportCommand, WritesAFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(run({"export", "--stage", "pom", "-o", "pom.glsl"}, folder.path()).code, 0);
    EXPECT_EQ(file_bytes(folder.path() / "pom.glsl"), run({"export", "--stage", "pom"}).out);
}

TEST(ExportCommand, SaysWhatAFunctionTakesForGranted) {
    const std::string search = run({"export", "--stage", "max-mip", "--side", "512"}).out;
    EXPECT_TRUE(says(search, "// For a relief whose seat is 1")) << search;
    EXPECT_TRUE(says(search, "maps of 512^2, repeat (--side, --wrap)")) << search;
    const std::string shading = run({"export", "--stage", "shade-phong"}).out;
    EXPECT_TRUE(says(shading, "// Light 0 is directional")) << shading;
    for (const char* const term : {"light1_constant", "light1_linear", "light1_quadratic"})
        EXPECT_TRUE(says(shading, std::string("uniform float ") + term)) << term;
}

TEST(ExportCommand, SeveralStagesAreOneFile) {
    const Outcome outcome = run({"export", "--stage", "linear", "--stage", "max-mip", "--stage",
                                 "shade-phong", "-D", "steps=48"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto count = [&](const std::string& part) {
        int found = 0;
        for (std::size_t at = outcome.out.find(part); at != std::string::npos;
             at = outcome.out.find(part, at + 1))
            ++found;
        return found;
    };
    for (const char* const once : {"#version", "uniform sampler2D height_map;", "STATUS_NONE = 0",
                                   "void trace_linear(", "void trace_max_mip(", "steps = 48;"})
        EXPECT_EQ(count(once), 1) << once;
    EXPECT_EQ(run({"export", "--stage", "linear", "--stage", "trace/linear"}).code, 2);
    EXPECT_EQ(run({"export", "--stage", "linear", "--stage", "pom", "-D", "pace=1"}).code, 2);
}

TEST(ExportCommand, AStageIsOfALightWrapAndSeat) {
    const Words shadow = {"export", "--stage", "shadow-march-thesis", "--lights", "3", "--light"};
    const auto with = [](Words words, const char* word) {
        words.emplace_back(word);
        return words;
    };
    const std::string last = run(with(shadow, "2")).out;
    EXPECT_TRUE(says(last, "uniform vec3 light2_position;")) << last;
    EXPECT_FALSE(says(last, "light0_position")) << last;
    EXPECT_EQ(run(with(shadow, "3")).code, 2);
    const Words search = {"export", "--stage", "max-mip"};
    const std::string repeating = run(search).out;
    const std::string clamped = run(with(with(search, "--wrap"), "clamp-to-edge")).out;
    EXPECT_TRUE(says(clamped, "clamp-to-edge (--side, --wrap)")) << clamped;
    EXPECT_NE(clamped.substr(clamped.find("void ")), repeating.substr(repeating.find("void ")));
    const std::string outset = run(with(with(search, "--seat"), "0.5")).out;
    EXPECT_TRUE(says(outset, "whose seat is 0.5")) << outset;
    EXPECT_NE(outset.substr(outset.find("void ")), repeating.substr(repeating.find("void ")));
    for (const char* seat : {"1.5", "nan"})
        EXPECT_EQ(run(with(with(search, "--seat"), seat)).code, 2) << seat;
    for (const char* stage : {"occlusion/ao-horizon", "shadow/horizon", "trace/sphere-3d"}) {
        const std::string text = run({"export", "--stage", stage}).out;
        EXPECT_TRUE(says(text, "of one layer")) << stage << text;
    }
    EXPECT_FALSE(says(run(search).out, "of one layer"));
}

TEST(ExportCommand, WritesASceneAsAFolder) {
    const TemporaryFolder folder;
    const Words words = {"export",     "thesis-quad", "--size", "16x16",
                         "--channels", "hit,R",       "-D",     "material.relief.steps=8",
                         "-o",         "out"};
    const Outcome outcome = run(words, folder.path());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "manifest.json")) << outcome.err;
    const std::string shader = file_bytes(folder / "out/bricks.frag");
    EXPECT_TRUE(says(shader, "const int steps = 8;")) << shader;
    for (const char* const file : {"out/README.md", "out/expected.exr", "out/vertices.bin"})
        EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
    EXPECT_EQ(run(words, folder.path()).code, 0);  // in its own place
    testing_films::write_bytes(folder / "out/mine.txt", "text");
    const Outcome refused = run(words, folder.path());
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(says(refused.err, "mine.txt")) << refused.err;
}

TEST(ExportCommand, RefusesScenesInOneLine) {
    const TemporaryFolder folder;
    const auto export_to = [&](const Words& more) {
        Words words = {"export", "--size", "8x8", "-o", "out"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words, folder.path());
    };
    const Outcome unknown = export_to({"no-such-scene"});
    EXPECT_EQ(unknown.code, 3) << unknown.err;
    const Outcome judge = export_to({"rows/oracle-bilinear"});
    EXPECT_EQ(judge.code, 2);
    EXPECT_TRUE(says(judge.err, "oracle-bilinear: proves what it finds")) << judge.err;
    EXPECT_EQ(std::count(judge.err.begin(), judge.err.end(), '\n'), 1) << judge.err;
    const Outcome webgpu = export_to({"thesis-quad", "--language", "wgsl"});
    EXPECT_EQ(webgpu.code, 2);
    EXPECT_TRUE(says(webgpu.err, "-D conventions=d3d")) << webgpu.err;
    EXPECT_EQ(export_to({"thesis-quad", "--stage", "linear"}).code, 2);
    EXPECT_EQ(export_to({"thesis-quad", "--side", "64"}).code, 2);
    EXPECT_EQ(run({"export", "thesis-quad"}).code, 2);
    EXPECT_EQ(folder.count(), 0u);
}

TEST(ExportCommand, WritesAPageThatJudges) {
    const TemporaryFolder folder;
    const Words words = {"export",     "sampler-wrap-repeat", "--size",  "8x8",
                         "--channels", "uv,R,G,B,A",          "--every", "2",
                         "--page",     "judge.html"};
    const Outcome outcome = run(words, folder.path());
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string page = file_bytes(folder / "judge.html");
    EXPECT_TRUE(says(page, "gpu.lo.R"));
    EXPECT_TRUE(says(page, "#version 300 es"));
    EXPECT_EQ(run(words, folder.path()).code, 0);
    EXPECT_EQ(file_bytes(folder / "judge.html"), page);
}

TEST(ExportCommand, RefusesPagesInOneLine) {
    const TemporaryFolder folder;
    const auto refuse = [&](const Words& more) {
        Words words = {"export", "--size", "8x8"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words, folder.path());
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(folder.count(), 0u) << outcome.err;
        return outcome;
    };
    const auto of_a_scene = [&](const Words& more) {
        Words words = {"thesis-quad"};
        words.insert(words.end(), more.begin(), more.end());
        return refuse(words);
    };
    EXPECT_EQ(of_a_scene({"--page", "judge.exr"}).code, 2);
    EXPECT_EQ(of_a_scene({"--page", ""}).code, 2);
    EXPECT_EQ(of_a_scene({"--page", "none/judge.html"}).code, 5);
    EXPECT_EQ(of_a_scene({"--page", "judge.html", "-o", "out"}).code, 2);
    EXPECT_EQ(of_a_scene({"--page", "judge.html", "--language", "glsl"}).code, 2);
    EXPECT_EQ(of_a_scene({"--page", "judge.html", "--limits", "metal"}).code, 2);
    EXPECT_EQ(of_a_scene({"--page", "judge.html", "--every", "0"}).code, 2);
    EXPECT_EQ(of_a_scene({"--page", "judge.html", "--channels", "no-such"}).code, 2);
    EXPECT_EQ(refuse({"--page", "judge.html"}).code, 2);
    EXPECT_EQ(refuse({"no-such-scene", "--page", "judge.html"}).code, 3);
    const Outcome samples = of_a_scene({"--page", "judge.html", "-D", "samples=4"});
    EXPECT_EQ(samples.code, 2);
    EXPECT_TRUE(says(samples.err, "found 4 samples per pixel, expected one")) << samples.err;
    const Outcome judge = refuse({"rows/oracle-bilinear", "--page", "judge.html"});
    EXPECT_EQ(judge.code, 2);
    EXPECT_TRUE(says(judge.err, "proves what it finds")) << judge.err;
}

TEST(ExportCommand, SaysWhyAStageIsNotWritten) {
    const std::string list = run({"export", "--list"}).out;
    EXPECT_TRUE(says(list, "trace/linear "));
    EXPECT_TRUE(says(list, "no: proves what it finds, by intervals and rationals")) << list;
    const Outcome refused = run({"export", "--stage", "oracle-block"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(says(refused.err, "proves what it finds, by intervals")) << refused.err;
    EXPECT_TRUE(says(refused.err, "(see `quadrel export --list`)")) << refused.err;
}

TEST(ExportCommand, ListsWhatHasAllWords) {
    const std::string all = run({"export", "--list"}).out;
    const std::string cones = run({"export", "--list", "CONE", "trace/"}).out;
    EXPECT_TRUE(says(cones, "trace/cone-cell "));
    EXPECT_FALSE(says(cones, "shadow/shadow-cone ")) << cones;
    EXPECT_FALSE(says(cones, "trace/linear ")) << cones;
    EXPECT_LT(cones.size(), all.size());
    // Words of reasons and sources, too, in any order.
    EXPECT_TRUE(says(run({"export", "--list", "rationals", "no:"}).out, "oracle/oracle "));
    EXPECT_TRUE(says(run({"export", "Dummer", "--list"}).out, "trace/cone-dummer-exact "));
    const Outcome none = run({"export", "--list", "thesis-quad"});
    EXPECT_EQ(none.code, 0);
    EXPECT_EQ(none.out, "");
    EXPECT_TRUE(says(none.err, "nothing in this list has all of these words")) << none.err;
}

TEST(ExportCommand, RefusesWhatItDoesNotKnow) {
    const Words wrong[] = {{"export"},
                           {"export", "--stage", "trace/liner"},
                           {"export", "--stage", "frame/linear"},
                           {"export", "--stage", "linear", "-D", "steps=0"},
                           {"export", "--stage", "linear", "-D", "steps"},
                           {"export", "--stage", "linear", "-D", "pace=1"},
                           {"export", "--stage", "linear", "--language", "metal"},
                           {"export", "--stage", "linear", "--side", "0"},
                           {"export", "--list", "-o", "list.txt"},
                           {"export", "--list", "--stage", "linear"},
                           {"export", "thesis-quad", "words", "-o", "out"},
                           {"export", "--stage", "linear", "--wrap", "around"},
                           {"export", "--stage", "linear", "--size", "8x8"},
                           {"export", "--snippets", "--seat", "0.5"},
                           {"export", "--snippets", "--stage", "linear"},
                           {"export", "--snippets", "-D", "steps=3"}};
    for (const Words& words : wrong) EXPECT_EQ(run(words).code, 2) << words.back();
    const Outcome bare = run({"export", "--stage", "linear", "-D", "steps"});
    EXPECT_TRUE(says(bare.err, "found \"steps\", expected steps=VALUE")) << bare.err;
}

}  // namespace
}  // namespace quadrel::cli_tests
