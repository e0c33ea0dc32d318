// The thesis' .glib file, readers of it that are wrong, and files made from it, for the tests.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <regex>
#include <utility>
#include <vector>

#include "quadrel/scene/load.hpp"
#include "scene/planted.hpp"
#include "scene/support.hpp"

namespace quadrel {

using planted::GlibDefect;

/// "Derivative-Based Relief Mapping" (2012), appendix, Parallax.glib, blank lines as printed.
inline const std::string thesis_listing = R"(Background 0 0 0
Perspective 70
LookAt 0 0 3  0 0 0  0 1 0

CubeMap 7 nvposx.bmp nvnegx.bmp \
nvposy.bmp nvnegy.bmp \
nvposz.bmp nvnegz.bmp

Texture2D 8 colormap.bmp
Texture2D 9 glowmap.bmp
Texture2D 10 glossmap.bmp
Texture2D 11 normalmap.bmp

Vertex   Parallax.vert
Fragment Parallax.frag
Program  Parallax  \

Environment_Map 7 \
Color_Map 8 \
Emissive_Map 9 \
Gloss_Map 10 \
Normal_Map 11 \
MaxParallaxOffset <0. .10 1.>

QuadXY 1. 1. 1 1
# Sphere 1. 32 32
# Torus 1.0 1.0 32 32
# Teapot
)";

/// The thesis' file names and images of ours that stand for them.
inline const std::vector<std::pair<std::string, std::string>> images = {
    {"nvposx", "sky_px"},         {"nvnegx", "sky_nx"},
    {"nvposy", "sky_py"},         {"nvnegy", "sky_ny"},
    {"nvposz", "sky_pz"},         {"nvnegz", "sky_nz"},
    {"colormap", "city_color"},   {"glowmap", "city_emissive"},
    {"glossmap", "bricks_gloss"}, {"normalmap", "bricks_normal_height"}};

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

using Load = std::function<Scene(const std::filesystem::path&)>;

inline std::string read_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline Scene load_changed(const std::filesystem::path& file,
                          const std::function<std::string(std::string)>& change) {
    const std::filesystem::path changed =
        file.parent_path() / ("changed-" + file.filename().string());
    std::ofstream(changed, std::ios::binary) << change(read_text(file));
    return load_scene(changed);
}

/// The real reader.
inline Scene read_scene(const std::filesystem::path& file) { return load_scene(file); }

/// Readers of .glib files that are wrong in one thing each; JSON they read as they should.
inline Load planted_reader(GlibDefect defect) {
    return [defect](const std::filesystem::path& file) {
        if (file.extension() == ".json") return load_scene(file);
        const auto substitute = [&](const char* pattern, const char* by) {
            return load_changed(file, [&](const std::string& text) {
                return std::regex_replace(text, std::regex(pattern), by);
            });
        };
        switch (defect) {
            case GlibDefect::least_of_slider:
                return substitute("<(\\S+) \\S+ \\S+>", "$1");
            case GlibDefect::greatest_of_slider:
                return substitute("<\\S+ \\S+ (\\S+)>", "$1");
            case GlibDefect::comments_drawn:
                return substitute("# ", "");
            case GlibDefect::z_and_size_swapped:
                return substitute("QuadXY (\\S+) (\\S+)", "QuadXY $2 $1");
            case GlibDefect::first_row_at_v_0:
                return load_scene(file,
                                  {"material.color.flip_v=false", "material.height.flip_v=false"});
            case GlibDefect::size_is_the_whole_side:
                return load_scene(file, {"objects[0].mesh.size=1"});
            case GlibDefect::gloss_as_stored:
                return load_scene(file, {"material.gloss.swizzle=rgb"});
            case GlibDefect::last_texture_for_all:
                return load_changed(file, [](const std::string& text) {
                    const std::string last = text.substr(text.rfind("Texture2D 8"));
                    return std::regex_replace(text, std::regex("Texture2D 8 .*"),
                                              last.substr(0, last.find('\n')));
                });
            case GlibDefect::open_end_accepted:
                return load_changed(file, [](std::string text) {
                    while (!text.empty() && (text.back() == '\\' || text.back() == '\n'))
                        text.pop_back();
                    const bool drawn = text.find("\nQuadXY") != std::string::npos;
                    return drawn ? text + " 2" : text;
                });
        }
        return load_scene(file);
    };
}

class GlibFiles : public testing::Test {
  protected:
    void SetUp() override {
        for (const auto& [name, image] : images) folder.write(name + ".bmp", name);
    }
    std::filesystem::path write(const std::string& text) const {
        return folder.write("scene.glib", text);
    }
    Scene load(const std::string& text, const std::vector<std::string>& overrides = {}) const {
        return load_scene(write(text), overrides);
    }
    std::string canonical(const std::string& text) const { return load(text).canonical; }

    /// Whether the file is refused at this place, in these words.
    testing::AssertionResult refuses(const std::string& text, int line, int column,
                                     const std::string& found, const std::string& expected) const {
        try {
            load(text);
        } catch (const InputError& error) {
            const std::string place = fmt::format("scene.glib:{}:{}: ", line, column);
            const std::string what = error.what();
            if (what.find(place) != std::string::npos &&
                error.found.find(found) != std::string::npos &&
                error.expected.find(expected) != std::string::npos)
                return testing::AssertionSuccess();
            return testing::AssertionFailure() << "another complaint: " << what;
        }
        return testing::AssertionFailure() << "no complaint";
    }
    /// The listing with one text in place of another.
    static std::string with(const std::string& what, const std::string& by) {
        EXPECT_NE(thesis_listing.find(what), std::string::npos) << what;
        return replaced(thesis_listing, what, by);
    }

    TemporaryFolder folder;
};

}  // namespace quadrel
