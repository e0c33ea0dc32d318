// Scene files of glman: what is not understood is refused where it stands.
#include "io/glib/glib_files.hpp"

namespace quadrel {
namespace {

class GlibErrors : public GlibFiles {};

TEST_F(GlibErrors, UnknownCommands) {
    EXPECT_TRUE(
        refuses(with("QuadXY", "QuadXZ"), 25, 1, "not understood", "\"QuadXY\", or one of"));
    EXPECT_TRUE(refuses(thesis_listing + "Shpere 1 2 3\n", 29, 1, "not understood",
                        "\"Sphere\", or one of Background, Perspective, LookAt"));
    EXPECT_TRUE(refuses("  Ortho -5. 5. -5. 5.\n", 1, 3, "not understood", "one of Background"));
    EXPECT_TRUE(refuses(std::string("\0\x01\xff\n", 4), 1, 1, "not understood", "one of"));
    EXPECT_FALSE(refuses(with("QuadXY", "QuadXZ"), 25, 2, "not understood", "QuadXY"));
    EXPECT_FALSE(refuses(thesis_listing, 25, 1, "not understood", "QuadXY"));
}

TEST_F(GlibErrors, UnknownShadersAndParameters) {
    EXPECT_TRUE(
        refuses(with("Parallax.vert", "bump.vert"), 14, 10, "\"bump.vert\"", "Parallax.vert"));
    EXPECT_TRUE(refuses(with("Parallax.frag", "Parallax.vert"), 15, 10, "", "Parallax.frag"));
    EXPECT_TRUE(refuses(with("Program  Parallax", "Program  parallax"), 16, 10, "\"parallax\"",
                        "Parallax"));
    EXPECT_TRUE(refuses(with("Color_Map 8", "Colour_Map 8"), 19, 1, "\"Colour_Map\"",
                        "\"Color_Map\", or one of Environment_Map"));
    EXPECT_TRUE(refuses(with("Color_Map 8", "Normal_Map 8"), 22, 1, "a second time", "once"));
    EXPECT_TRUE(refuses(with("1.>\n", "1.> \\\n"), 25, 1, "the command \"QuadXY\"", "backslash"));
    EXPECT_TRUE(refuses(with("Normal_Map 11 \\\n", ""), 16, 1, "no Normal_Map", "height"));
    EXPECT_TRUE(refuses(with("Vertex   Parallax.vert\n", ""), 15, 1, "shaders", "Vertex"));
    EXPECT_TRUE(refuses("Perspective 70\nTeapot", 2, 1, "without a program", "Program"));
}

TEST_F(GlibErrors, UnitsAndFiles) {
    EXPECT_TRUE(refuses(with("Color_Map 8", "Color_Map 7"), 19, 1, "unit 7", "Texture2D"));
    EXPECT_TRUE(
        refuses(with("Environment_Map 7", "Environment_Map 8"), 18, 1, "unit 8", "CubeMap"));
    EXPECT_TRUE(refuses(with("Texture2D 8", "Texture2D 32"), 9, 11, "\"32\"", "from 0 to 31"));
    EXPECT_TRUE(refuses(with("Texture2D 8", "Texture2D -1"), 9, 11, "\"-1\"", "from 0 to 31"));
    EXPECT_TRUE(refuses(with("Texture2D 8", "Texture2D 8.5"), 9, 11, "\"8.5\"", "from 0 to 31"));
    EXPECT_TRUE(refuses(with("colormap.bmp", "color.bmp"), 9, 13, "no such file", "a file"));
    EXPECT_TRUE(refuses(with("nvnegy", "nvnegq"), 6, 12, "no such file", "a file"));
    EXPECT_TRUE(refuses(with("nvposz.bmp nvnegz.bmp", "nvposz.bmp"), 7, 11, "end of the command",
                        "six files"));
    EXPECT_TRUE(refuses(with("colormap.bmp", "colormap.bmp 3"), 9, 26, "\"3\" more",
                        "Texture2D unit file"));
    EXPECT_TRUE(refuses(thesis_listing + "CubeMap 7 a b c d e f\nTeapot", 30, 1,
                        "another Environment_Map", "one for the whole scene"));
}

TEST_F(GlibErrors, Numbers) {
    EXPECT_TRUE(refuses(with("Perspective 70", "Perspective wide"), 2, 13, "\"wide\"", "a number"));
    for (const char* word : {"nan", "inf", "1e999", "0x1p3", "1,5", "+-2", "+"})
        EXPECT_TRUE(refuses(with("Perspective 70", "Perspective " + std::string(word)), 2, 13, word,
                            "a number"));
    EXPECT_TRUE(refuses(with("Perspective 70", "Perspective 180"), 2, 13, "180", "(0, 180)"));
    EXPECT_TRUE(refuses(with("Perspective 70", "Perspective 70 .1"), 2, 16, "\".1\" more",
                        "Perspective field-of-view"));
    EXPECT_TRUE(refuses(with("0 1 0\n", "0 1\n"), 3, 25, "end of the command", "upwards"));
    EXPECT_TRUE(refuses(with("0 0 3  0 0 0", "0 0 3  0 0 3"), 3, 1, "same place", "two places"));
    EXPECT_TRUE(refuses(with("QuadXY 1. 1. 1 1", "QuadXY 1. 0. 1 1"), 25, 11, "\"0.\"", "> 0"));
    EXPECT_TRUE(refuses(with("QuadXY 1. 1. 1 1", "QuadXY 1. 1. 1"), 25, 15, "end", "rows"));
    EXPECT_TRUE(refuses(with("QuadXY 1. 1. 1 1", "QuadXY 1. 1. 1.5 1"), 25, 14, "1.5", "integer"));
    EXPECT_TRUE(refuses(with("# Sphere 1. 32 32", "Sphere 1. 2 32"), 26, 11, "2", "[3, 2048]"));
    EXPECT_TRUE(refuses(with("# Sphere 1. 32 32", "Sphere -1. 32 32"), 26, 8, "-1", "> 0"));
    EXPECT_TRUE(refuses(with("# Torus 1.0 1.0", "Torus 1.5 1.0"), 27, 1, "above outer_radius", ""));
    EXPECT_TRUE(refuses(with("# Teapot", "Teapot 2"), 28, 8, "\"2\" more", "Teapot"));
}

TEST_F(GlibErrors, Sliders) {
    const auto slider = [](const std::string& text) { return with("<0. .10 1.>", text); };
    EXPECT_TRUE(refuses(slider("<0. 1. .10>"), 23, 23, "outside", "ascending"));
    EXPECT_TRUE(refuses(slider("<0. .10 1."), 23, 29, "end of the command", ">"));
    EXPECT_TRUE(refuses(slider("<0. .10>"), 23, 26, "\">\"", "the greatest value"));
    EXPECT_TRUE(refuses(slider("<0. .10 1. 2.>"), 23, 30, "\"2.\"", ">"));
    EXPECT_TRUE(refuses(slider("<true>"), 23, 20, "\"true\"", "a number"));
    EXPECT_TRUE(refuses(slider("<-1 -.5 0>"), 23, 23, "below 0", ">= 0"));
    EXPECT_TRUE(refuses(slider(""), 23, 18, "end of the command", "depth"));
}

TEST_F(GlibErrors, WhatIsMissingOrDouble) {
    EXPECT_TRUE(refuses("", 1, 1, "no such command", "one"));
    EXPECT_TRUE(refuses("Perspective 70\n", 1, 15, "no shape", "QuadXY, Sphere, Torus or Teapot"));
    EXPECT_TRUE(refuses(with("Perspective 70\n", ""), 24, 17, "no such command", "one"));
    EXPECT_TRUE(refuses(with("Perspective 70", "Perspective 70\nPerspective 50"), 3, 1,
                        "a second time", "line 2"));
    EXPECT_TRUE(refuses(with("1.>\n\nQuadXY 1. 1. 1 1\n# Sphere 1. 32 32\n"
                             "# Torus 1.0 1.0 32 32\n# Teapot\n",
                             "1.> \\\n\n"),
                        23, 31, "the end of the file after a backslash", "the rest"));
    EXPECT_EQ(load(with("LookAt 0 0 3  0 0 0  0 1 0\n", "")).objects.size(), 1u);
}

/// Whether a file cut off anywhere is refused, unless only what says nothing is missing.
testing::AssertionResult refuses_cut_files(const Load& read, const TemporaryFolder& folder) {
    const std::string whole = load_scene(folder.write("whole.glib", thesis_listing)).canonical;
    // Files of glman may leave out the cells of QuadXY.
    const std::string without_cells = replaced(whole, ",\"subdivide\":[1,1]", "");
    const std::size_t needed = thesis_listing.find("QuadXY 1. 1. 1 1") + 16;
    for (std::size_t size = 0; size < thesis_listing.size(); ++size) {
        const auto file = folder.write("scene.glib", thesis_listing.substr(0, size));
        try {
            const std::string canonical = read(file).canonical;
            if (canonical != whole && canonical != without_cells)
                return testing::AssertionFailure() << "another scene: " << size << " bytes";
        } catch (const InputError&) {
            if (size >= needed) return testing::AssertionFailure() << "refused: " << size;
        }
    }
    return testing::AssertionSuccess();
}

TEST_F(GlibErrors, CutOffFilesAreRefused) {
    EXPECT_TRUE(refuses_cut_files(read_scene, folder));
    EXPECT_FALSE(refuses_cut_files(planted_reader(GlibDefect::open_end_accepted), folder));
}

TEST_F(GlibErrors, DamagedFilesAreReadOrRefused) {
    constexpr char bytes[] = {'\0', '\n', '\\', '<', '#', '9', '-', '\xff'};
    for (std::size_t at = 0; at < thesis_listing.size(); ++at) {
        std::string text = thesis_listing;
        text[at] = bytes[at % std::size(bytes)];
        try {
            EXPECT_FALSE(load(text).objects.empty());
        } catch (const InputError& error) {
            EXPECT_FALSE(error.file.empty());
            EXPECT_GT(error.line, 0) << error.what();
        }
    }
}

}  // namespace
}  // namespace quadrel
