// Images that people bring, by way of the command line: layers, parts, crops, heights beside
// colours, integers in float targets, pictures of vectors.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "film/films.hpp"
#include "io/exr/parts.hpp"
#include "quadrel/film/exr.hpp"
#include "texture/files.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::TemporaryFolder;
using testing_films::write_bytes;

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

class ImageFiles : public testing::Test {
  protected:
    ImageFiles() {
        Film depth{{0, 0, 2, 2}, {0, 0, 2, 2}, {}}, colours = depth;
        depth.add("Z", ChannelType::float32, bits(3));
        for (const char* name : {"R", "G", "B", "height.Y"})
            colours.add(name, ChannelType::float32, bits(0.5f));
        write_exr_parts(folder / "parts.exr", {{"depth", depth, {}}, {"rgba", colours, {}}});
        write_exr(folder / "one.exr", colours, {});
    }
    Outcome quadrel(const std::vector<std::string>& arguments) const {
        return run(arguments, folder.path());
    }
    /// One line that has the word, and nothing on standard output.
    static testing::AssertionResult complains(const Outcome& outcome, int code,
                                              const std::string& word) {
        if (outcome.code == code && outcome.out.empty() &&
            std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1 &&
            outcome.err.find(word) != std::string::npos)
            return testing::AssertionSuccess();
        return testing::AssertionFailure() << outcome.code << ": " << outcome.err << outcome.out;
    }
    TemporaryFolder folder;
};

TEST_F(ImageFiles, EveryVerbAsksWhichPart) {
    EXPECT_TRUE(complains(quadrel({"mips", "parts.exr", "-o", "m"}), 3, "2 parts"));
    EXPECT_TRUE(complains(quadrel({"compare", "one.exr", "parts.exr"}), 3, "2 parts"));
    EXPECT_EQ(quadrel({"mips", "parts.exr", "--part", "rgba", "--layer", "height", "-o", "m"}).code,
              0);
    EXPECT_EQ(read_exr(folder / "m.0.exr").film.planes[0].name, "Y");
    EXPECT_EQ(quadrel({"compare", "one.exr", "parts.exr", "--part", "1"}).code, 0);
    EXPECT_EQ(quadrel({"compare", "parts.exr", "one.exr", "--reference-part", "rgba"}).code, 0);
    EXPECT_EQ(quadrel({"compare", "parts.exr", "one.exr", "--reference-part", "depth"}).code, 1);
    EXPECT_EQ(quadrel({"bake", "parts.exr", "--layer", "height", "--kind", "max-mip", "--no-cache",
                       "-o", "b.exr"})
                  .code,
              0);
}

TEST_F(ImageFiles, SheetsOfNothingAreRefused) {
    std::filesystem::create_directory(folder / "empty");
    EXPECT_TRUE(
        complains(quadrel({"sheet", "empty", "-o", "s.png"}), 3, "a folder without scenes"));
    EXPECT_FALSE(std::filesystem::exists(folder / "s.png"));
}

TEST_F(ImageFiles, SheetsTakeAPartOfEveryImage) {
    EXPECT_TRUE(complains(quadrel({"sheet", "parts.exr", "-o", "s.png"}), 3, "2 parts"));
    const auto sheet = [&](const std::vector<std::string>& more) {
        std::vector<std::string> line = {"sheet", "parts.exr", "-o", "s.png", "--part"};
        line.insert(line.end(), more.begin(), more.end());
        EXPECT_EQ(quadrel(line).code, 0);
        return testing_films::file_bytes(folder / "s.png");
    };
    const std::string depth = sheet({"0"}), colours = sheet({"rgba"});
    EXPECT_NE(depth, colours);
    EXPECT_EQ(sheet({"depth"}), depth);
    EXPECT_NE(sheet({"rgba", "--layer", "height"}), colours);
}

/// A ball that mirrors an environment of these faces.
std::string mirror_scene(const std::string& faces) {
    return R"({"quadrel": 1, "size": [16, 16], "objects": [{"mesh": "sphere"}],
 "material": {"gloss": {"file": ")" QUADREL_DATA_DIR R"(/textures/mirror_gloss.exr"},
              "shade": "shade-thesis"}, "environment": {"faces": [)" +
           faces + "]}}";
}

/// Faces that are parts of one file give the bits of faces that are files.
TEST_F(ImageFiles, FacesOfEnvironmentsMayBeParts) {
    std::vector<ExrPart> parts;
    std::string files, of_one;
    float value = 0;
    for (const std::string name : {"px", "nx", "py", "ny", "pz", "nz"}) {
        Film face{{0, 0, 2, 2}, {0, 0, 2, 2}, {}};
        value += 0.125f;
        for (const char* channel : {"R", "G", "B"})
            face.add(channel, ChannelType::float32, bits(value));
        write_exr(folder / (name + ".exr"), face, {});
        parts.push_back({name, face, {}});
        const std::string comma = files.empty() ? "" : ", ";
        files += comma + "\"" + name + ".exr\"";
        of_one += comma + R"({"file": "cube.exr", "part": ")" + name + "\"}";
    }
    write_exr_parts(folder / "cube.exr", parts);
    const auto render = [&](const std::string& faces, const std::vector<std::string>& more = {}) {
        write_bytes(folder / "s.json", mirror_scene(faces));
        std::vector<std::string> line = {"render", "s.json", "-o", "s.exr"};
        line.insert(line.end(), more.begin(), more.end());
        const Outcome outcome = quadrel(line);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return film_hash(read_exr(folder / "s.exr").film);
    };
    const std::string right = render(files);
    EXPECT_EQ(render(of_one), right);
    const std::string other = render(of_one, {"-D", "environment.faces[4].part=px"});
    EXPECT_NE(other, right) << "the face towards the eye";
    EXPECT_EQ(render(files, {"-D", "environment.faces[4].file=px.exr"}), other);
    EXPECT_EQ(render(files, {"-D", "environment.faces[4]=px.exr"}), other);
    of_one.replace(of_one.find(R"(, "part": "pz")"), 14, "");
    write_bytes(folder / "s.json", mirror_scene(of_one));
    EXPECT_TRUE(complains(quadrel({"render", "s.json"}), 3, "environment.faces[4]: found 6 parts"));
}

TEST_F(ImageFiles, InfoGivesAnOverviewOfParts) {
    const auto all = nlohmann::json::parse(quadrel({"info", "parts.exr", "--json"}).out);
    ASSERT_EQ(all["parts"].size(), 2u);
    EXPECT_EQ(all["parts"][1]["name"], "rgba");
    EXPECT_EQ(all["parts"][0]["channels"], "Z");
    const auto one =
        nlohmann::json::parse(quadrel({"info", "parts.exr", "--part", "0", "--json"}).out);
    EXPECT_EQ(one["channels"][0]["max"], 3);
}

/// A scene of a quad that fills the view, with this height map.
std::string scene_of(const std::string& height) {
    return R"({"quadrel": 1, "size": [8, 8], "camera": {"eye": [0, 0, 1.2]},
 "material": {"height": {)" +
           height + R"(}, "relief": {"trace": "linear", "steps": 64}},
 "objects": [{"mesh": "quad"}]})";
}

TEST_F(ImageFiles, HeightsAreInTheFirstChannelUnlessASwizzleSaysOtherwise) {
    // Heights 0.5 in red; alpha, all opaque, is not meant.
    test::Bytes pixels;
    for (int i = 0; i < 4; ++i) pixels += test::Bytes("\x80\x00\x00\xff", 4);
    write_bytes(folder / "rgba.png", test::make_png(2, 2, 8, test::PngColour::rgba, pixels));
    pixels.clear();
    for (int i = 0; i < 4; ++i) pixels += test::Bytes("\x80\xff", 2);
    write_bytes(folder / "ya.png", test::make_png(2, 2, 8, test::PngColour::grey_alpha, pixels));
    const auto height = [&](const std::string& texture) {
        write_bytes(folder / "s.json", scene_of(texture));
        const Outcome outcome =
            quadrel({"render", "s.json", "--channels", "hit.h,hit.s", "-o", "out.exr"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const Film film = read_exr(folder / "out.exr").film;
        EXPECT_NEAR(film.find("hit.s")->as_float(27), 1 - film.find("hit.h")->as_float(27), 0.02);
        return film.find("hit.h")->as_float(27);
    };
    for (const char* file : {"rgba.png", "ya.png"}) {
        const std::string texture = R"("file": ")" + std::string(file) + "\"";
        EXPECT_FLOAT_EQ(height(texture), 128.0f / 255.0f) << file;
        // What was read before, and would be wrong now: the alpha.
        EXPECT_FLOAT_EQ(height(texture + R"(, "swizzle": "a")"), 1.0f) << file;
        EXPECT_FLOAT_EQ(height(texture + R"(, "swizzle": "alpha-or-first")"), 1.0f) << file;
    }
    write_bytes(folder / "s.json", scene_of(R"("file": "rgba.png", "swizzle": "1-ga")"));
    const Outcome plan = quadrel({"render", "s.json", "--channels", "hit.h", "--explain"});
    EXPECT_NE(plan.out.find("rgba.png: heights from 1-g\n"), std::string::npos) << plan.out;
}

TEST_F(ImageFiles, ATextureNamesItsLayerAndPart) {
    const auto render = [&](const std::string& more) {
        write_bytes(folder / "s.json", scene_of(R"("file": "parts.exr")" + more));
        return quadrel({"render", "s.json", "--channels", "hit.h", "-o", "out.exr"});
    };
    for (const char* part : {R"("rgba")", "1"}) {
        const Outcome outcome = render(R"(, "layer": "height", "part": )" + std::string(part));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_FLOAT_EQ(read_exr(folder / "out.exr").film.planes[0].as_float(27), 0.5f);
    }
    EXPECT_TRUE(complains(render(""), 3, "2 parts"));
    EXPECT_TRUE(complains(render(R"(, "part": 2)"), 3, "no part \"2\""));
    EXPECT_TRUE(complains(render(R"(, "part": 1.5)"), 3, "number from 0"));
    EXPECT_TRUE(complains(render(R"(, "layer": "")"), 3, "name of a layer"));
    EXPECT_TRUE(complains(render(R"(, "layer": "gloss", "part": 1)"), 3, "no layer \"gloss\""));
}

TEST_F(ImageFiles, ACropIsComparedWithAWholeFrameOnRequest) {
    const Film whole = testing_films::smooth_film(1);
    Film part = whole;
    crop(part, {3, 2, 9, 7});
    write_exr(folder / "whole.exr", whole, {});
    write_exr(folder / "crop.exr", part, {});
    part.planes[0].bits[7] += 1;  // at 4,3
    write_exr(folder / "off.exr", part, {});
    EXPECT_EQ(quadrel({"compare", "whole.exr", "crop.exr"}).code, 1) << "strict by default";
    EXPECT_EQ(quadrel({"compare", "whole.exr", "crop.exr", "--overlap"}).code, 0);
    EXPECT_EQ(quadrel({"compare", "crop.exr", "whole.exr", "--overlap"}).code, 0);
    const Outcome off = quadrel({"compare", "whole.exr", "off.exr", "--overlap"});
    EXPECT_EQ(off.code, 1);
    EXPECT_NE(off.out.find("worst at 4,3"), std::string::npos) << off.out;
    EXPECT_EQ(quadrel({"compare", "whole.exr", "off.exr", "--window", "5,3,9,7"}).code, 0);
    EXPECT_EQ(quadrel({"compare", "whole.exr", "off.exr", "--window", "4,3,5,4"}).code, 1);
    const auto json = nlohmann::json::parse(
        quadrel({"compare", "whole.exr", "crop.exr", "--overlap", "--json"}).out);
    EXPECT_EQ(json["preparation"]["window"], nlohmann::json::array({3, 2, 9, 7}));
    EXPECT_TRUE(complains(quadrel({"compare", "whole.exr", "crop.exr", "--window", "0,0,4,4"}), 2,
                          "test image"));
    EXPECT_TRUE(complains(quadrel({"compare", "whole.exr", "crop.exr", "--window", "4,3,4,4"}), 2,
                          "--window"));
    Film elsewhere = whole;
    crop(elsewhere, {10, 0, 12, 2});
    write_exr(folder / "elsewhere.exr", elsewhere, {});
    EXPECT_TRUE(
        complains(quadrel({"compare", "crop.exr", "elsewhere.exr", "--overlap"}), 2, "share no"));
}

TEST_F(ImageFiles, IntegersInFloatTargets) {
    Film reference{{0, 0, 3, 1}, {0, 0, 3, 1}, {}}, port = reference;
    reference.add("hit.steps", ChannelType::uint32).bits = {0, 12, 4096};
    port.add("hit.steps", ChannelType::float32).bits = {0, bits(12), bits(4096)};
    write_exr(folder / "a.exr", reference, {});
    write_exr(folder / "b.exr", port, {});
    const Outcome equal = quadrel({"compare", "a.exr", "b.exr"});
    EXPECT_EQ(equal.code, 0) << equal.out;
    EXPECT_NE(equal.out.find("hit.steps: integers"), std::string::npos) << equal.out;
    EXPECT_EQ(quadrel({"compare", "a.exr", "b.exr", "--encode", "half"}).code, 0);
    port.planes[0].bits[1] = bits(13);
    write_exr(folder / "c.exr", port, {});
    EXPECT_EQ(quadrel({"compare", "a.exr", "c.exr"}).code, 1);
    EXPECT_EQ(quadrel({"compare", "a.exr", "c.exr", "--abs", "1"}).code, 1)
        << "what holds for all floats is no allowance for integers";
    EXPECT_EQ(quadrel({"compare", "a.exr", "c.exr", "--abs", "hit.steps=1"}).code, 0);
}

/// Grey with alpha has one pair of names, whatever reads it.
TEST_F(ImageFiles, GreyWithAlphaIsNamedAlike) {
    write_bytes(folder / "ya.png", test::make_png(2, 2, 8, test::PngColour::grey_alpha,
                                                  std::string("\x10\x20\x30\x40\x50\x60\x70\x7f")));
    EXPECT_EQ(quadrel({"mips", "ya.png", "-o", "m"}).code, 0);
    const Film film = read_exr(folder / "m.0.exr").film;
    ASSERT_EQ(film.planes.size(), 2u);
    EXPECT_EQ(film.planes[0].name, "A");
    EXPECT_EQ(film.planes[1].name, "Y");
    EXPECT_EQ(quadrel({"compare", "ya.png", "m.0.exr"}).code, 0);
    EXPECT_EQ(quadrel({"mips", "ya.png", "--swizzle", "ra", "-o", "n"}).code, 0);
    EXPECT_NE(read_exr(folder / "n.0.exr").film.find("G"), nullptr);
}

/// Only the window is read, and it is the same.
TEST_F(ImageFiles, WindowsAreComparedAsCropsAre) {
    Film film = testing_films::random_film(5, {0, 0, 60, 70}, {0, 0, 60, 70});
    write_exr(folder / "a.exr", film, {});
    film.planes[0].bits[film.index(3, 3)] ^= 1u << 20;
    write_exr(folder / "b.exr", film, {});
    EXPECT_EQ(quadrel({"compare", "a.exr", "b.exr"}).code, 1);
    EXPECT_EQ(quadrel({"compare", "a.exr", "b.exr", "--window", "4,4,50,66"}).code, 0);
    EXPECT_EQ(quadrel({"compare", "a.exr", "b.exr", "--window", "0,0,4,4"}).code, 1);
    EXPECT_EQ(quadrel({"compare", "a.exr", "b.exr", "--window", "0,0,61,4"}).code, 2);
}

}  // namespace
}  // namespace quadrel::cli_tests
