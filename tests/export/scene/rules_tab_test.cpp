// The tab of the judge's page that asks a browser's GPU what it does where it may choose.
#include <fmt/format.h>

#include "effort.hpp"
#include "export/scene/judge_page.hpp"
#include "export/scene/judged.hpp"
#include "io/scene/setting_words.hpp"
#include "rules/probe.hpp"

namespace quadrel::export_tests {
namespace {

std::string plain_page() {
    JudgePage options;
    options.scene.channels = {"uv", "A"};
    return judge_page(small_scene(), options);
}

const Json& result_of(const Json& results, const std::string& id) {
    for (const Json& result : results)
        if (result["id"] == id) return result;
    static const Json none;
    return none;
}

std::size_t preset_index(std::string_view name) {
    std::size_t i = 0;
    while (hardware_words[i].first != name) ++i;
    return i;
}

/// Which probes of the browser's own renderer are not as its preset has them, of those that it
/// models.
std::string disagreements(const Json& results) {
    std::string ids;
    const std::size_t chromium = preset_index("chromium");
    for (const rules::Probe& probe : rules::all_probes()) {
        const Json& result = result_of(results, probe.id);
        if (probe.not_modelled.empty() && result["missing"] == "" &&
            result["presets"][chromium]["differing"] != 0)
            ids += " " + probe.id;
    }
    return ids;
}

TEST_F(JudgePageInABrowser, AsksTheProbes) {
    const Judged judged(plain_page(), "#tab=rules");
    const Json results = judged.data("rules");
    ASSERT_TRUE(results.is_array()) << results.dump() << judged.error();
    const std::vector<rules::Probe> probes = rules::all_probes();
    ASSERT_EQ(results.size(), probes.size());
    std::string missing;
    for (const rules::Probe& probe : probes) {
        const Json& result = result_of(results, probe.id);
        // Textures of 16 bits are a browser's choice.
        if (result["missing"] != "" && probe.id != "weights-R16") missing += " " + probe.id;
        // The page says of the same answers what the program says.
        for (std::size_t k = 0; k < std::size(hardware_words); ++k) {
            const auto& [name, hardware] = hardware_words[k];
            const rules::Values own = rules::answers_of_quadrel(probe, hardware_model(hardware));
            const Json& preset = result["presets"][k];
            EXPECT_EQ(preset["does"], probe.words(own)) << probe.id << " " << name;
            ASSERT_EQ(preset.contains("permitted"), bool(probe.legal)) << probe.id;
            if (probe.legal) {
                EXPECT_EQ(preset["permitted"], probe.legal(own)) << probe.id << " " << name;
            }
        }
    }
    // What GLSL ES 3.0 has no words for is named with the reason.
    EXPECT_EQ(missing, " derivatives-qualified samples lod-query lod-query-level gather fma");
    EXPECT_NE(judged.dom().find("not asked: GLSL ES 3.0 has no textureGather"), std::string::npos);
    EXPECT_EQ(disagreements(results), "");
    EXPECT_EQ(result_of(results, "derivatives")["seen"], "coarse");
    EXPECT_EQ(result_of(results, "snapping")["seen"], "4 bits, half to even");
    EXPECT_EQ(result_of(results, "texture-size")["seen"], "each its own");
}

/// Where WebGPU draws the scene probes are told by WGSL's names and what WebGPU permits.
TEST_F(JudgePageInABrowser, TellsTheProbesInTheTermsOfWhatDraws) {
    if (test::sanitized) GTEST_SKIP() << runs_in_browser;
    const auto says = [](const Judged& judged, const std::string& text) {
        return judged.dom().find(text) != std::string::npos;
    };
    const std::string page = plain_page();
    // Without waiting for an adapter, which the browser's virtual time does not do.
    const Judged by_gl(page, "#tab=rules"),
        by_gpu(with_planted(page, "navigator.gpu", "navigator.none"), "#tab=rules&by=webgpu");
    for (const auto& [glsl, wgsl] :
         {std::pair{">dFdx and dFdy of a product", ">dpdx and dpdy of a product"},
          {">textureSize of levels", ">textureDimensions of levels"},
          {">the level of texture() along", ">the level of textureSample() along"},
          {"title=\"Permitted: 2 ulp (GLSL 4.60, 4.7.1)", "title=\"Permitted: 2 ulp (WGSL, "},
          {">not asked: GLSL ES 3.0 has no textureQueryLod<",
           ">not asked: WebGL 2 asks, and GLSL ES 3.0 has no textureQueryLod, nor has WGSL<"}}) {
        EXPECT_TRUE(says(by_gl, glsl)) << glsl;
        EXPECT_FALSE(says(by_gl, wgsl)) << wgsl;
        EXPECT_TRUE(says(by_gpu, wgsl)) << wgsl;
        EXPECT_FALSE(says(by_gpu, glsl)) << glsl;
    }
    EXPECT_TRUE(says(by_gpu, ">The scene is drawn by WebGPU, the probes"));
}

/// A GPU that does otherwise is told.
TEST_F(JudgePageInABrowser, ProbesTellPlantedRules) {
    if (test::sanitized) GTEST_SKIP() << runs_in_browser;
    struct Planted {
        const char *from, *to, *id, *seen;
        bool permitted;
    };
    const Planted errors[] = {
        {"dFdy(pixel.x * pixel.y)", "dFdx(pixel.x * pixel.y)", "derivatives", "other", false},
        {"textureSize(map0, int(asked.x))", "textureSize(map0, 0)", "texture-size",
         "204 of 256 another's", false}};
    // The shaders are packed.
    std::string changed = "this.program(fragment";
    for (const Planted& error : errors)
        changed += fmt::format(".replace(\"{}\", \"{}\")", error.from, error.to);
    const std::string page = with_planted(plain_page(), "this.program(fragment)", changed + ")");
    const Json results = Judged(page, "#tab=rules").data("rules");
    for (const Planted& error : errors) {
        const Json& result = result_of(results, error.id);
        EXPECT_EQ(result["seen"], error.seen);
        EXPECT_EQ(result["permitted"], error.permitted);
        EXPECT_NE(result["presets"][preset_index("chromium")]["differing"], 0);
    }
}

}  // namespace
}  // namespace quadrel::export_tests
