// Scene files of glman: the thesis' own is a scene of our format.
#include <algorithm>

#include "io/glib/glib_files.hpp"
#include "quadrel/render.hpp"

namespace quadrel {
namespace {

class Glib : public GlibFiles {};

/// The same, written down by hand in the project's own format.
const std::string thesis_json = R"({
  "quadrel": 1,
  "background": [0, 0, 0],
  "camera": {"type": "perspective", "fov_y": 70, "eye": [0, 0, 3], "target": [0, 0, 0],
             "up": [0, 1, 0]},
  "materials": {"Parallax": {
    "color": {"file": "colormap.bmp", "flip_v": true},
    "emissive": {"file": "glowmap.bmp", "flip_v": true, "swizzle": "gb0r"},
    "gloss": {"file": "glossmap.bmp", "flip_v": true, "swizzle": "gb0r"},
    "height": {"file": "normalmap.bmp", "flip_v": true, "swizzle": "alpha-or-first"},
    "relief": {"frame": "frame-thesis", "trace": "linear-thesis",
               "surface": "h2n-thesis@published", "shadow": "shadow-march-thesis@published",
               "depth": 0.10},
    "shade": "shade-thesis@published"}},
  "objects": [{"mesh": {"shape": "quad", "size": 2, "subdivide": [1, 1]},
               "material": "Parallax", "transform": [{"translate": [0, 0, 1]}]}],
  "environment": {"faces": ["nvposx.bmp", "nvnegx.bmp", "nvposy.bmp", "nvnegy.bmp",
                            "nvposz.bmp", "nvnegz.bmp"]}
})";

std::string with_real_images(std::string text) {
    for (const auto& [name, image] : images)
        text = replaced(text, name + ".bmp",
                        fmt::format("{}/textures/{}.exr", QUADREL_DATA_DIR, image));
    return text;
}

Film rendered(const Scene& scene) {
    RenderOptions options;
    options.channels = {"R", "G", "B", "A", "Z"};
    options.threads = 1;
    return render(scene, options);
}

testing::AssertionResult same_film(const Load& read, const std::filesystem::path& glib,
                                   const std::filesystem::path& json) {
    Scene a, b;
    try {
        a = read(glib);
        b = read(json);
    } catch (const InputError& error) {
        return testing::AssertionFailure() << error.what();
    }
    a.width = b.width = 56;
    a.height = b.height = 40;
    const Film one = rendered(a), other = rendered(b);
    for (std::size_t i = 0; i < one.planes.size(); ++i)
        if (one.planes[i].bits != other.planes[i].bits)
            return testing::AssertionFailure() << "other bits in " << one.planes[i].name;
    return testing::AssertionSuccess();
}

TEST_F(Glib, ThesisSceneIsAnEqualJsonSceneBitForBit) {
    const auto glib = write(with_real_images(thesis_listing));
    const auto json = folder.write("scene.json", with_real_images(thesis_json));
    EXPECT_TRUE(same_film(read_scene, glib, json));
    for (const GlibDefect defect :
         {GlibDefect::least_of_slider, GlibDefect::greatest_of_slider, GlibDefect::comments_drawn,
          GlibDefect::first_row_at_v_0, GlibDefect::size_is_the_whole_side,
          GlibDefect::gloss_as_stored})
        EXPECT_FALSE(same_film(planted_reader(defect), glib, json)) << static_cast<int>(defect);
}

TEST_F(Glib, ThesisSceneHasTheCanonicalFormOfTheJsonScene) {
    const Scene json = load_scene(folder.write("scene.json", thesis_json));
    EXPECT_EQ(canonical(thesis_listing), json.canonical);
    EXPECT_EQ(load(thesis_listing).hash, json.hash);
    const Scene scene = load(thesis_listing);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].position, glm::vec3(10, 10, 10));
    EXPECT_EQ(scene.materials.at(0).depth, 0.1f);
}

TEST_F(Glib, InstalledSceneIsFoundByNameAndIsTheThesisFile) {
    const Scene scene = load_scene("parallax.glib");
    EXPECT_EQ(scene.file.filename(), "parallax.glib");
    const std::vector<std::string> names = installed_scenes();
    EXPECT_EQ(std::count(names.begin(), names.end(), "parallax.glib"), 1);
    // But for the comment at the top, the names of the images and blanks.
    const auto stripped = [](std::string text) {
        text = text.substr(text.find("Background"));
        text = std::regex_replace(text, std::regex("\\S+\\.(bmp|exr)"), "image");
        return std::regex_replace(text, std::regex("\\s+"), " ");
    };
    EXPECT_EQ(stripped(read_text(scene.file)), stripped(thesis_listing));
    EXPECT_THROW(load_scene("no-such-scene.glib"), InputError);
}

TEST_F(Glib, WritingDoesNotMatter) {
    const std::string plain = canonical(thesis_listing);
    EXPECT_EQ(canonical(replaced(thesis_listing, "\n", "\r\n")), plain);
    EXPECT_EQ(canonical(replaced(thesis_listing, " ", "\t ")), plain);
    EXPECT_EQ(canonical("\xEF\xBB\xBF##OpenGL GLIB\n" + thesis_listing), plain);
    EXPECT_EQ(canonical(with("<0. .10 1.>", "< +0 1e-1 1.00 >")), plain);
    EXPECT_EQ(canonical(with("<0. .10 1.>", ".1")), plain);
    EXPECT_EQ(canonical(with("QuadXY", "quadxy")), plain);
    EXPECT_EQ(canonical(with("Perspective 70", "PERSPECTIVE 70 # degrees")), plain);
    EXPECT_EQ(canonical(with("Color_Map 8 \\", "Color_Map 8\\")), plain);
    EXPECT_EQ(canonical(with("Color_Map 8 \\", "Color_Map 8 \\\n  # Noise_Map 3 \\\n\n")), plain);
    EXPECT_EQ(canonical(with("Vertex   ", "Vertex shaders\\")), plain);
    EXPECT_EQ(canonical(with("colormap.bmp", ".\\colormap.bmp")), plain);
    EXPECT_NE(canonical(with("Perspective 70", "Perspective 71")), plain);
}

/// Whether commented commands have no effect, whatever they are.
testing::AssertionResult ignores_comments(const Load& read, const TemporaryFolder& folder) {
    const std::string comments[] = {"# Sphere 1. 32 32\n", "  # Nonsense <\n", "#Teapot\n",
                                    "# Program Parallax \\\n", "#\n"};
    const Scene plain = load_scene(folder.write("plain.glib", thesis_listing));
    for (const std::string& comment : comments) {
        try {
            const Scene scene = read(folder.write("scene.glib", comment + thesis_listing));
            if (scene.canonical != plain.canonical) return testing::AssertionFailure() << comment;
        } catch (const InputError& error) {
            return testing::AssertionFailure() << error.what();
        }
    }
    return testing::AssertionSuccess();
}

TEST_F(Glib, CommentsStayComments) {
    EXPECT_TRUE(ignores_comments(read_scene, folder));
    EXPECT_FALSE(ignores_comments(planted_reader(GlibDefect::comments_drawn), folder));
}

/// Whether a slider's value is its middle number.
testing::AssertionResult takes_the_middle(const Load& read, const TemporaryFolder& folder) {
    for (const auto& [slider, depth] : {std::pair("<0. .05 1.>", 0.05f),
                                        {"<.25 .5 .75>", 0.5f},
                                        {"<0 1 1>", 1.0f},
                                        {"<0 0 1>", 0.0f}}) {
        const Scene scene =
            read(folder.write("scene.glib", replaced(thesis_listing, "<0. .10 1.>", slider)));
        if (scene.materials.at(0).depth != depth) return testing::AssertionFailure() << slider;
    }
    return testing::AssertionSuccess();
}

TEST_F(Glib, SliderGivesItsMiddleValue) {
    EXPECT_TRUE(takes_the_middle(read_scene, folder));
    EXPECT_FALSE(takes_the_middle(planted_reader(GlibDefect::least_of_slider), folder));
    EXPECT_FALSE(takes_the_middle(planted_reader(GlibDefect::greatest_of_slider), folder));
    EXPECT_EQ(load(with(" \\\nMaxParallaxOffset <0. .10 1.>", "")).materials.at(0).depth, 0.05f);
}

/// Whether QuadXY is a square of half-width 3 at z = 2.
testing::AssertionResult quad_is_at(const Load& read, const std::filesystem::path& file) {
    const Scene scene = read(file);
    const Object& object = scene.objects.at(0);
    for (const glm::vec3& corner : scene.meshes.at(object.mesh).positions) {
        const glm::vec4 at = object.transform * glm::vec4(corner, 1);
        if (std::abs(at.x) != 3 || std::abs(at.y) != 3 || at.z != 2)
            return testing::AssertionFailure() << at.x << " " << at.y << " " << at.z;
    }
    return testing::AssertionSuccess();
}

TEST_F(Glib, QuadXYIsGivenByItsPlaneAndHalfWidth) {
    const auto file = write(with("QuadXY 1. 1. 1 1", "QuadXY 2. 3."));
    EXPECT_TRUE(quad_is_at(read_scene, file));
    EXPECT_FALSE(quad_is_at(planted_reader(GlibDefect::z_and_size_swapped), file));
    EXPECT_FALSE(quad_is_at(planted_reader(GlibDefect::size_is_the_whole_side), file));
    const Scene cells = load(with("QuadXY 1. 1. 1 1", "QuadXY 0 1 3 2"));
    EXPECT_EQ(cells.meshes.at(0).triangles.size(), 12u);
}

TEST_F(Glib, SeveralShapes) {
    const Scene scene = load(thesis_listing + "Sphere 1. 8 6\nTorus .5 1 8 9\nTeapot\n");
    ASSERT_EQ(scene.objects.size(), 4u);
    EXPECT_EQ(scene.materials.size(), 1u);
    const Scene json = load_scene(folder.write("scene.json", R"({"quadrel": 1, "objects": [
        {"mesh": {"shape": "sphere", "radius": 1, "slices": 8, "stacks": 6}},
        {"mesh": {"shape": "torus", "inner_radius": 0.5, "outer_radius": 1, "sides": 8,
                  "rings": 9}}, {"mesh": "teapot"}]})"));
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(scene.meshes.at(scene.objects[i + 1].mesh).positions,
                  json.meshes.at(json.objects[i].mesh).positions);
}

/// Whether each shape has the colour map of its moment.
testing::AssertionResult textures_of_the_moment(const Load& read, const TemporaryFolder& folder) {
    const Scene scene = read(folder.write(
        "scene.glib", thesis_listing + "Teapot\nTexture2D 8 glowmap.bmp\nTeapot\nTeapot\n"));
    const char* const expected[] = {"colormap.bmp", "colormap.bmp", "glowmap.bmp", "glowmap.bmp"};
    for (std::size_t i = 0; i < 4; ++i) {
        const Material& material = scene.materials.at(scene.objects.at(i).material);
        if (material.textures.at("color").file.filename() != expected[i])
            return testing::AssertionFailure() << "shape " << i;
    }
    if (scene.materials.size() == 2 && scene.materials[1].name == "Parallax-2")
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << scene.materials.size() << " materials";
}

TEST_F(Glib, ShapesHaveTheTexturesOfTheirMoment) {
    EXPECT_TRUE(textures_of_the_moment(read_scene, folder));
    EXPECT_FALSE(textures_of_the_moment(planted_reader(GlibDefect::last_texture_for_all), folder));
}

TEST_F(Glib, OptionsOverrideIt) {
    const Scene scene =
        load(thesis_listing, {"size=[8,4]", "material.relief.depth=0.5",
                              "material.color.wrap=clamp-to-edge", "camera.near=0.5", "lights=[]"});
    EXPECT_EQ(scene.width, 8);
    EXPECT_EQ(scene.materials.at(0).depth, 0.5f);
    EXPECT_EQ(scene.materials.at(0).textures.at("color").sampler.wrap_u, Wrap::clamp_to_edge);
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_TRUE(
        complains([&] { load(thesis_listing, {"camera.fov=50"}); }, {"camera.fov", "-D", "fov_y"}));
}

}  // namespace
}  // namespace quadrel
