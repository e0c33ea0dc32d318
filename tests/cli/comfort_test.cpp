// quadrel render, as it treats people and scripts: notes, one line at the end, the right option
// for a file, an image on standard output.
#include <gtest/gtest.h>

#include "cli/process.hpp"
#include "cli/terminal.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using Words = std::vector<std::string>;

constexpr const char* one_quad = R"({"quadrel": 1, "size": [16, 8],
    "material": {"shade": "shade-debug"},
    "camera": {"type": "orthographic", "height": 2, "eye": [0, 0, 3]},
    "objects": [{"name": "wall", "mesh": "quad"}]})";
constexpr const char* nothing = R"({"quadrel": 1, "size": [16, 8],
    "objects": [{"mesh": "quad", "transform": [{"translate": [0, 0, 90]}]}]})";

class Comfort : public testing::Test {
  protected:
    void SetUp() override {
        testing_films::write_bytes(folder / "quad.json", one_quad);
        testing_films::write_bytes(folder / "nothing.json", nothing);
    }
    Words line(const std::string& scene, const Words& options) const {
        Words words = {"render", scene + ".json", "-o", "a.exr"};
        words.insert(words.end(), options.begin(), options.end());
        return words;
    }
    Outcome render(const std::string& scene, const Words& options = {}) const {
        return run(line(scene, options), folder.path());
    }
    Outcome on_terminal(const std::string& scene, const Words& options = {}) const {
        return run_on_terminal(line(scene, options), folder.path());
    }
    TemporaryFolder folder;
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(Comfort, OneLineAtTheEndOnATerminal) {
    const Outcome seen = on_terminal("quad");
    EXPECT_EQ(seen.code, 0);
    // Half of a picture twice as wide as high.
    EXPECT_TRUE(has(seen.err, "64 of 128 pixels covered (50.0 %); plan ")) << seen.err;
    EXPECT_TRUE(has(seen.err, "left out: ")) << seen.err;
    EXPECT_FALSE(has(render("quad").err, "covered"));
    const Outcome quiet = on_terminal("quad", {"--quiet"});
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(quiet.err, "");
}

TEST_F(Comfort, PixelsAreThoseOfTheWindowWhateverTheChannels) {
    EXPECT_TRUE(has(on_terminal("quad", {"--channels", "uv", "--window", "0,0,5,8"}).err,
                    "8 of 40 pixels covered (20.0 %)"));
    EXPECT_TRUE(has(on_terminal("quad", {"-D", "samples=4"}).err, "64 of 128 pixels covered"));
}

TEST_F(Comfort, NothingInViewIsAWarning) {
    const std::string warning = "warning: nothing is in view: of 2 triangles 2 are outside";
    EXPECT_TRUE(has(render("nothing").err, warning)) << render("nothing").err;
    EXPECT_TRUE(has(render("nothing", {"--quiet"}).err, warning));
    EXPECT_EQ(render("nothing").code, 0);
    EXPECT_FALSE(has(render("quad").err, "warning"));
    EXPECT_TRUE(has(render("quad", {"-D", "objects=[]"}).err, "no visible triangle"));
}

TEST_F(Comfort, QuietIsQuiet) {
    EXPECT_NE(render("quad").err, "");
    EXPECT_EQ(render("quad", {"--quiet", "-t", "999", "--channels", "N,T,B"}).err, "");
    EXPECT_NE(render("missing", {"--quiet"}).err, "");
}

TEST_F(Comfort, OtherVerbsTooAreQuietAndKnowTheirFiles) {
    ASSERT_EQ(render("quad", {"--channels", "A"}).code, 0);
    for (const Words& words :
         std::vector<Words>{{"sheet", "quad.json", "-o", "s.png"},
                            {"mips", "a.exr", "-o", "m"},
                            {"bake", "a.exr", "--kind", "max-mip", "-o", "b.exr", "--no-cache"}}) {
        Words quiet = words;
        quiet.push_back("--quiet");
        EXPECT_NE(run(words, folder.path()).err, "") << words[0];
        const Outcome outcome = run(quiet, folder.path());
        EXPECT_EQ(outcome.code, 0) << words[0];
        EXPECT_EQ(outcome.err, "");
    }
    EXPECT_EQ(run({"sheet", "quad.json", "-o", "s.exr"}, folder.path()).code, 2);
    EXPECT_EQ(run({"bake", "a.exr", "--kind", "max-mip", "-o", "b.png"}, folder.path()).code, 2);
}

TEST_F(Comfort, MoreThreadsThanProcessorsAreObeyedWithANote) {
    const Outcome outcome = render("quad", {"-t", "999"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(has(outcome.err, "-t 999: more threads than the ")) << outcome.err;
    EXPECT_FALSE(has(render("quad", {"-t", "1"}).err, "threads"));
}

TEST_F(Comfort, BlueIsNotTheBitangent) {
    EXPECT_TRUE(has(render("quad", {"--channels", "N,T,B"}).err, "the bitangent is B.X,B.Y,B.Z"));
    EXPECT_FALSE(has(render("quad", {"--channels", "R,G,B,N"}).err, "bitangent"));
    EXPECT_FALSE(has(render("quad", {"--channels", "N,T,B.X,B.Y,B.Z"}).err, "bitangent"));
}

TEST_F(Comfort, NamesOfOtherKindsAreRefusedWithTheRightOption) {
    for (const auto& [words, right] : std::vector<std::pair<Words, std::string>>{
             {{"-o", "x.png"}, ".png is written by --preview"},
             {{"-o", "x.JPEG"}, ".png is written by --preview"},
             {{"-o", "x.json"}, ".json is written by --stats"},
             {{"--preview", "x.exr"}, ".exr is written by -o"},
             {{"--preview", "x.jpg"}, "expected a name that ends in .png"},
             {{"--stats", "x.exr"}, ".exr is written by -o"}}) {
        Words all = {"render", "quad.json"};
        all.insert(all.end(), words.begin(), words.end());
        const Outcome outcome = run(all, folder.path());
        EXPECT_EQ(outcome.code, 2) << words[1];
        EXPECT_TRUE(has(outcome.err, right)) << outcome.err;
    }
    EXPECT_EQ(folder.count(), 2u);
}

TEST_F(Comfort, MinusStreamsTheImage) {
    ASSERT_EQ(render("quad").code, 0);
    const Outcome streamed = run({"render", "quad.json", "-o", "-"}, folder.path());
    EXPECT_EQ(streamed.code, 0);
    EXPECT_EQ(streamed.out, file_bytes(folder / "a.exr"));
    EXPECT_EQ(folder.count(), 3u);  // no file named -
    EXPECT_EQ(run({"render", "quad.json", "-o", "-"}, folder.path(), "/dev/full").code, 5);
}

/// Only render writes to standard output; elsewhere "-" would become a file of this name.
TEST_F(Comfort, MinusIsNoFileOfOtherVerbs) {
    ASSERT_EQ(render("quad", {"--channels", "A"}).code, 0);
    const std::size_t files = folder.count();
    for (const Words& words :
         std::vector<Words>{{"sheet", "quad.json", "-o", "-"},
                            {"mips", "a.exr", "-o", "-"},
                            {"bake", "a.exr", "--kind", "max-mip", "-o", "-", "--no-cache"},
                            {"compare", "a.exr", "a.exr", "--heatmap", "-"},
                            {"compare", "a.exr", "a.exr", "--heatmap", "h.exr"}})
        EXPECT_EQ(run(words, folder.path()).code, 2) << words[0];
    EXPECT_EQ(folder.count(), files);
}

/// A name cannot forge a line of the report.
TEST_F(Comfort, NamesStayOnTheirLine) {
    ASSERT_EQ(render("quad", {"--channels", "A"}).code, 0);
    std::filesystem::copy(folder / "a.exr", folder / "x\nequal\n.exr");
    const Outcome outcome = run({"compare", "x\nequal\n.exr", "a.exr"}, folder.path());
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(has(outcome.out, "x\\nequal\\n.exr")) << outcome.out;
}

TEST_F(Comfort, NamesFromScenesStayOnTheirLine) {
    constexpr const char* forged = "x\\nforged\\u001b[2J";
    testing_films::write_bytes(
        folder / "names.json",
        R"({"quadrel": 1, "size": [4, 4], "materials": {")" + std::string(forged) +
            R"(": {"color": {"file": "a\nforged.exr"}}}, "objects": [{"mesh": "quad", "name": ")" +
            forged + R"("}, {"mesh": "quad", "visible": false, "name": ")" + forged + R"("}]})");
    ASSERT_EQ(render("quad", {"--channels", "R,G,B"}).code, 0);
    std::filesystem::copy(folder / "a.exr", folder / "a\nforged.exr");
    const std::filesystem::path data = folder / "data";
    std::filesystem::create_directories(data / "scenes");
    std::filesystem::copy(folder / "quad.json", data / "scenes" / "x\nforged.json");
    setenv("QUADREL_DATA", data.c_str(), 1);
    for (const Words& words :
         std::vector<Words>{{"probe", "names.json", "--pixel", "1,1"},
                            {"render", "names.json", "--explain"},
                            {"render", "names.json", "-o", "n.exr"},
                            {"info", "names.json"},
                            {"list", "scenes", "forged"},
                            {"render", "names.json", "-D", "objects[0].material=none"}}) {
        const Outcome outcome = run(words, folder.path());
        const std::string text = outcome.out + outcome.err;
        EXPECT_FALSE(has("\n" + text, "\nforged")) << words[0] << ": " << text;
        EXPECT_TRUE(has(text, "forged") || words[0] == "render") << text;
    }
    unsetenv("QUADREL_DATA");
    // Channels are named by files, too.
    Film film = read_exr(folder / "a.exr").film;
    film.planes[0].name = "x\nforged";
    write_exr(folder / "b.exr", film, {});
    const std::string report = run({"compare", "a.exr", "b.exr"}, folder.path()).out;
    EXPECT_TRUE(has(report, "x\\nforged") && !has(report, "\nforged")) << report;
}

TEST_F(Comfort, AnotherStageByTheCommandLine) {
    const Words other = {"-D", "material.relief.trace=steep"};
    testing_films::write_bytes(folder / "secant.json", R"({"quadrel": 1, "size": [16, 8],
        "material": {"height": {"noise": {}}, "shade": "shade-debug",
                     "relief": {"trace": "secant", "iterations": 3}},
        "objects": [{"mesh": "quad"}]})");
    const Outcome outcome = render("secant", other);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "dropped iterations")) << outcome.err;
    EXPECT_FALSE(has(render("secant").err, "dropped"));
    EXPECT_EQ(render("secant", {other[0], other[1], "-D", "material.relief.iterations=3"}).code, 3);
    EXPECT_EQ(render("secant", {other[0], other[1], "-D", "material.relief.iterations=null"}).code,
              0);
}

}  // namespace
}  // namespace quadrel::cli_tests
