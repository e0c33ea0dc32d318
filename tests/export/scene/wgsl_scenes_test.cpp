// Scenes in WGSL: the shaders of all that can leave before a browser's compiler, and what the
// manifest says of their bindings.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <set>

#include "effort.hpp"
#include "export/scene/content.hpp"
#include "export/scene/manifest.hpp"
#include "export/scene/small_scenes.hpp"
#include "export/wgsl_page.hpp"
#include "quadrel/error.hpp"

namespace quadrel::export_tests {
namespace {

constexpr const char* conventions = "conventions=d3d";

struct WgslScene {
    std::string name, error;
    std::vector<std::string> refused;
    std::vector<Program> programs;
};

WgslScene wgsl_scene(const SmallScenes& scenes, const std::string& name) {
    const Scene scene = scenes.load(name, {conventions});
    WgslScene result{name, "", refused_stages(scene), {}};
    SceneExport options;
    options.language = "wgsl";
    options.reference = false;
    options.threads = 1;
    try {
        const ExportContent content = export_content(scene, options);
        for (const ContentMaterial& material : content.materials)
            result.programs.push_back(material.program);
    } catch (const UsageError& error) {
        result.error = error.what();
    }
    return result;
}

/// Of these a pipeline of the first pass is made, too, which takes a compiler longer.
const std::set<std::string>& with_pipelines() {
    static const std::set<std::string> names{
        "thesis-quad", "rows/frag-depth", "rows/frame-vertex-published", "rows/prism-gs-published"};
    return names;
}

/// Some of the installed scenes: all functions are compiled by themselves (wgsl_test.cpp).
std::vector<WgslScene> wgsl_scenes(const SmallScenes& scenes) {
    std::vector<std::string> names(with_pipelines().begin(), with_pipelines().end());
    const std::vector<std::string> all_names = installed_scenes();
    const std::size_t step = test::sanitized ? 16 : 5;
    for (std::size_t i = 0; i < all_names.size(); i += step)
        if (!with_pipelines().contains(all_names[i])) names.push_back(all_names[i]);
    std::vector<WgslScene> all(names.size());
    tbb::parallel_for(std::size_t(0), names.size(),
                      [&](std::size_t i) { all[i] = wgsl_scene(scenes, names[i]); });
    return all;
}

bool is_refused(const WgslScene& scene) {
    return scene.error.find("expected a sampler that WebGPU has") != std::string::npos ||
           std::any_of(scene.refused.begin(), scene.refused.end(), [&](const std::string& id) {
               return scene.error.find(id) != std::string::npos;
           });
}

TEST(WgslScenes, CompileInABrowser) {
    if (testing_browser::browser().empty()) GTEST_SKIP() << testing_browser::no_browser;
    const SmallScenes scenes;
    std::string shaders;
    std::set<std::string> known;
    std::size_t count = 0, left = 0, pipelines = 0;
    for (const WgslScene& scene : wgsl_scenes(scenes)) {
        EXPECT_TRUE(scene.error.empty() || is_refused(scene)) << scene.name << scene.error;
        left += scene.error.empty();
        const bool is_whole = with_pipelines().contains(scene.name);
        pipelines += is_whole;
        for (const Program& program : scene.programs) {
            if (!known.insert(program.vertex + program.fragment).second && !is_whole) continue;
            shaders += "=== " + scene.name + (is_whole ? "*\n" : "\n") + program.vertex +
                       "--- fragment\n" + program.fragment;
            ++count;
        }
    }
    EXPECT_GT(left, test::sanitized ? 8u : 25u);
    EXPECT_EQ(pipelines, with_pipelines().size());
    // A compiler notices a value of another type; a pipeline varyings that do not fit.
    std::vector<std::string> planted;
    {
        const Program program = wgsl_scene(scenes, "thesis-quad").programs.at(0);
        const auto replaced = [&](std::string text, const std::string& from,
                                  const std::string& to) {
            const std::size_t at = text.find(from);
            EXPECT_NE(at, std::string::npos) << from;
            return at == std::string::npos ? text : text.replace(at, from.size(), to);
        };
        planted = {
            program.vertex + "--- fragment\n" +
                replaced(program.fragment, "uv = varyings.uv;", "uv = varyings.P;"),
            program.vertex + "--- fragment\n" +
                replaced(program.fragment, "@location(0) P: vec3f", "@location(0) P: vec4f")};
        for (const std::string& text : planted) shaders += "=== planted*\n" + text;
    }
    const std::vector<std::string> verdicts = browser_verdicts("wgsl_programs.html", shaders);
    if (verdicts == std::vector<std::string>{"none"}) GTEST_SKIP() << "the browser has no WebGPU";
    ASSERT_EQ(verdicts.size(), count + planted.size()) << verdicts.back();
    for (std::size_t i = 0; i < verdicts.size(); ++i)
        EXPECT_EQ(verdicts[i].ends_with(": ok"), i < count) << verdicts[i];
}

/// Every number that a draw has is in the buffer where the struct of the shader has it, and none
/// overlap.
TEST(WgslScenes, TheManifestHasTheBuffer) {
    const SmallScenes scenes;
    SceneExport options;
    options.language = "wgsl";
    const Scene scene = scenes.load("thesis-quad", {conventions});
    const ExportContent content = export_content(scene, options);
    const Json material = manifest_of(content)["materials"][0];
    const std::string& shader = content.materials.at(0).program.fragment;
    const Json& buffer = material["webgpu"]["uniform_buffer"];
    std::size_t end = 0;
    for (const ProgramName& uniform : content.materials.at(0).program.uniforms) {
        const std::size_t offset = buffer["offsets"][uniform.name];
        const std::size_t align = uniform.number > 0 || uniform.type == "vec3" ? 16 : 4;
        EXPECT_GE(offset, end) << uniform.name;
        EXPECT_EQ(offset % align, 0u) << uniform.name;
        end = offset + 4 * (uniform.number > 0        ? std::size_t(uniform.number)
                            : uniform.type == "vec3"  ? 3
                            : uniform.type == "float" ? 1
                                                      : 4);
        EXPECT_NE(shader.find("    " + uniform.name + ": "), std::string::npos) << uniform.name;
    }
    EXPECT_GE(buffer["size"].get<std::size_t>(), end);
    for (std::size_t i = 0; i < material["samplers"].size(); ++i) {
        const std::string name = material["samplers"][i]["uniform"];
        const int texture = material["webgpu"]["bindings"][i]["texture"];
        EXPECT_NE(shader.find("@binding(" + std::to_string(texture) + ") var " + name + ":"),
                  std::string::npos)
            << name;
    }
    EXPECT_EQ(material["webgpu"]["fragment_entries"].size(), content.passes.size());
    for (const ProgramPass& pass : content.passes) EXPECT_LE(pass.target_count, 2);
}

/// What WebGPU has not is said in one line.
TEST(WgslScenes, RefuseWhatWebGpuHasNot) {
    const SmallScenes scenes;
    const auto refusal = [&](const std::string& name, const std::vector<std::string>& overrides) {
        SceneExport options;
        options.language = "wgsl";
        try {
            export_content(scenes.load(name, overrides), options);
        } catch (const UsageError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(refusal("thesis-quad", {}).find("-D conventions=d3d"), std::string::npos);
    EXPECT_NE(refusal("thesis-quad", {conventions, "samples=2"}).find("2 samples"),
              std::string::npos);
    EXPECT_NE(refusal("sampler-border-colour", {conventions}).find("clamp-to-border"),
              std::string::npos);
    EXPECT_NE(refusal("sampler-lod-bias", {conventions}).find("a bias of"), std::string::npos);
    EXPECT_EQ(refusal("thesis-quad", {conventions}), "");
}

}  // namespace
}  // namespace quadrel::export_tests
