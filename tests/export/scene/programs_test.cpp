// Every installed scene as shaders, before glslangValidator, Debian's reference compiler.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <set>

#include "effort.hpp"
#include "export/scene/content.hpp"
#include "export/scene/small_scenes.hpp"
#include "quadrel/error.hpp"

namespace quadrel::export_tests {
namespace {

/// What one scene became in a language.
struct Exported {
    std::string scene, error;
    std::vector<std::string> refused;
    std::vector<Program> programs;
    std::vector<int> passes;  ///< how many each has
};

Exported exported(const SmallScenes& scenes, const std::string& name, const std::string& language) {
    const Scene scene = scenes.load(name);
    Exported result{name, "", refused_stages(scene), {}, {}};
    SceneExport options;
    options.language = language;
    options.threads = 1;
    try {
        const ExportContent content = export_content(scene, options);
        for (const ContentMaterial& material : content.materials) {
            result.programs.push_back(material.program);
            result.passes.push_back(static_cast<int>(content.passes.size()));
        }
    } catch (const UsageError& error) {
        result.error = error.what();
    }
    return result;
}

/// Scenes that leave in that of the languages: under the sanitizers each in one of them.
std::vector<std::string> scenes_of(std::size_t language) {
    std::vector<std::string> names;
    const std::vector<std::string> all = installed_scenes();
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!test::sanitized || i % 9 == 3 * language) names.push_back(all[i]);
    return names;
}

std::vector<Exported> all_exported(const SmallScenes& scenes, const std::vector<std::string>& names,
                                   const std::string& language) {
    std::vector<Exported> all(names.size());
    tbb::parallel_for(std::size_t(0), names.size(),
                      [&](std::size_t i) { all[i] = exported(scenes, names[i], language); });
    return all;
}

/// Texts that a compiler is to take, each once.
struct Texts {
    std::set<std::string> vertex, fragment;

    explicit Texts(const std::vector<Exported>& all) {
        for (const Exported& of : all)
            for (const Program& program : of.programs) {
                vertex.insert(program.vertex);
                fragment.insert(program.fragment);
            }
    }
};

bool has_validator() { return std::system("glslangValidator --version > /dev/null 2>&1") == 0; }

/// A language, and how its compiler is called: for one text where that makes a binary, else for
/// many.
struct Language {
    const char *name, *options;
    int texts_a_call;
};
constexpr Language languages[] = {{"glsl", "-G --aml --amb -o /dev/null", 1},
                                  {"glsl-es", "", 1000},
                                  {"hlsl", "-D -V --aml --amb -e main -o /dev/null", 1}};

/// What the compiler says against any of the texts; empty if it takes all. `more`: options.
std::string complaints(const std::set<std::string>& texts, const Language& language,
                       const std::string& more) {
    const testing_films::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "shaders");
    int number = 0;
    for (const std::string& text : texts)
        testing_films::write_bytes(folder / "shaders" / std::to_string(number++), text);
    const std::string log = (folder / "log").string();
    const std::string command = "cd '" + (folder / "shaders").string() +
                                "' && ls | xargs -P 2 -n " + std::to_string(language.texts_a_call) +
                                " glslangValidator " + language.options + " " + more + " > '" +
                                log + "' 2>&1";
    if (std::system(command.c_str()) == 0) return "";
    return "not taken:\n" + testing_films::file_bytes(log).substr(0, 4000);
}

/// The first `right` as `wrong`.
std::string replaced(std::string text, const std::string& right, const std::string& wrong) {
    const std::size_t at = text.find(right);
    EXPECT_NE(at, std::string::npos) << right;
    return at == std::string::npos ? text : text.replace(at, right.size(), wrong);
}

/// Vertex shaders that transform vertices themselves.
std::set<std::string> by_matrices(const std::set<std::string>& vertex) {
    std::set<std::string> texts;
    for (const std::string& text : vertex)
        texts.insert(replaced(text, "#define SHADED_VERTICES 1", "#define SHADED_VERTICES 0"));
    return texts;
}

TEST(ScenePrograms, AllCompileThatCanLeave) {
    const SmallScenes scenes;
    for (std::size_t l = 0; l < std::size(languages); ++l) {
        const Language& language = languages[l];
        const std::vector<Exported> all = all_exported(scenes, scenes_of(l), language.name);
        int left = 0;
        for (const Exported& of : all) {
            left += of.error.empty();
            EXPECT_EQ(of.error.empty(), of.refused.empty()) << of.scene << ": " << of.error;
            if (of.error.empty()) continue;
            EXPECT_TRUE(std::any_of(
                of.refused.begin(), of.refused.end(),
                [&](const std::string& id) { return of.error.find(id) != std::string::npos; }))
                << of.error;
        }
        EXPECT_GT(left, test::sanitized ? 15 : 150) << language.name;
        // It is no part of what is sanitized, and takes the same texts in other builds.
        if (test::sanitized) continue;
        if (!has_validator()) GTEST_SKIP() << "glslangValidator is not installed (glslang-tools)";
        const Texts texts(all);
        EXPECT_EQ(complaints(texts.fragment, language, "-S frag"), "") << language.name;
        EXPECT_EQ(complaints(texts.vertex, language, "-S vert"), "") << language.name;
        EXPECT_EQ(complaints(by_matrices(texts.vertex), language, "-S vert"), "") << language.name;
    }
}

/// Shaders that are linked have one version, also where the fragment shader alone asks for more.
bool versions_agree(const Program& program) {
    const auto version = [](const std::string& text) { return text.substr(0, text.find('\n')); };
    return version(program.vertex) == version(program.fragment);
}

TEST(ScenePrograms, LinkedShadersHaveOneVersion) {
    const SmallScenes scenes;
    for (const char* language : {"glsl", "glsl-es"})
        for (const char* scene : {"lattice", "thesis-quad"}) {
            Exported of = exported(scenes, scene, language);
            ASSERT_EQ(of.error, "");
            for (Program& program : of.programs) {
                EXPECT_TRUE(versions_agree(program)) << scene << ", " << language;
                program.vertex.replace(0, 9, "#version 9");
                EXPECT_FALSE(versions_agree(program));
            }
        }
}

TEST(ScenePrograms, EveryPassCompiles) {
    if (!has_validator()) GTEST_SKIP() << "glslangValidator is not installed (glslang-tools)";
    const SmallScenes scenes;
    for (const Language& language : languages) {
        const Exported one = exported(scenes, "thesis-quad", language.name);
        ASSERT_EQ(one.error, "");
        EXPECT_GT(one.passes[0], 1);
        for (int pass = 0; pass < one.passes[0]; ++pass) {
            const std::string text = replaced(one.programs[0].fragment, "#define PASS 0",
                                              "#define PASS " + std::to_string(pass));
            EXPECT_EQ(complaints({text}, language, "-S frag"), "") << language.name << pass;
        }
    }
}

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

TEST(ScenePrograms, HaveEachFunctionOnce) {
    const SmallScenes scenes;
    Scene scene = scenes.load("thesis-quad");
    scene.lights.resize(3, scene.lights.front());
    const ExportContent content = export_content(scene, {});
    const std::string& text = content.materials.at(0).program.fragment;
    for (const char* const name :
         {"quad_differentiate", "frame_frame_gram", "trace_linear", "surface_h2n_thesis",
          "shadow_shadow_march_thesis_light0", "shadow_shadow_march_thesis_light1",
          "shadow_shadow_march_thesis_light2", "shade_shade_thesis"}) {
        EXPECT_EQ(count(text, std::string("void ") + name + "("), 1) << name;
        EXPECT_EQ(count(text, std::string("    ") + name + "("), 1) << name;  // called
    }
    EXPECT_EQ(count(text, "uniform sampler2D height_map;"), 1);
    EXPECT_EQ(count(text, "uniform vec3 light2_position;"), 1);
}

/// What a compiler or a reader has to notice.
TEST(ScenePrograms, PlantedErrorsAreFound) {
    if (!has_validator()) GTEST_SKIP() << "glslangValidator is not installed (glslang-tools)";
    const SmallScenes scenes;
    struct Planted {
        const char *language, *right, *wrong;
    };
    // Outputs and varyings of another type, a uniform or a sampler that is not declared.
    constexpr Planted all[] = {{"glsl", "out vec2 dUVdx", "out vec3 dUVdx"},
                               {"glsl", "uniform vec3 eye;", ""},
                               {"glsl", "in vec2 uv;", "in vec3 uv;"},
                               {"glsl-es", "precision highp float;", ""},
                               {"hlsl", "SamplerState height_map_sampler;", ""},
                               {"hlsl", "Targets targets = (Targets)0;", ""}};
    for (const Planted& planted : all) {
        const std::string text =
            replaced(exported(scenes, "thesis-quad", planted.language).programs.at(0).fragment,
                     planted.right, planted.wrong);
        for (const Language& language : languages)
            if (language.name == std::string(planted.language)) {
                EXPECT_NE(complaints({text}, language, "-S frag"), "") << planted.right;
            }
    }
}

}  // namespace
}  // namespace quadrel::export_tests
