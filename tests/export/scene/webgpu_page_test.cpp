// The judge's page by WebGPU: what a browser draws from WGSL is found legal, and a shader that was
// changed is not.
#include "effort.hpp"
#include "export/scene/judge_page.hpp"
#include "export/scene/judged.hpp"

namespace quadrel::export_tests {
namespace {

constexpr const char* software_webgpu =
    "--use-angle=swiftshader --enable-unsafe-swiftshader --enable-unsafe-webgpu "
    "--use-webgpu-adapter=swiftshader --virtual-time-budget=60000 --dump-dom";
constexpr const char* webgpu_limits = "webgpu,snapping=0.0625";

/// The browser's virtual time passes while it is idle, although an adapter takes real time to
/// answer: the page is kept busy until it is ready.
std::string busy(const std::string& page) {
    return with_planted(page, "start().catch(",
                        "const busy = setInterval(() => { for (let i = 0, x = 0; i < 3e7; i += 1) "
                        "x += i % 7; }, 100);\n"
                        "start().finally(() => clearInterval(busy)).catch(");
}

bool has_no_webgpu(const Judged& judged) {
    return judged.error().find("no WebGPU") != std::string::npos ||
           judged.error().find("no adapter") != std::string::npos;
}

TEST_F(JudgePageInABrowser, FindsWhatWebGpuDrawsLegal) {
    if (test::sanitized) GTEST_SKIP() << runs_in_browser;
    const std::string page = busy(judge_page(small_scene(), {{}, webgpu_limits}));
    const Judged judged(page, "#by=webgpu", software_webgpu);
    if (has_no_webgpu(judged)) GTEST_SKIP() << judged.error();
    expect_legal(judged);
    EXPECT_NE(judged.verdict().value("renderer", "").find("WebGPU on"), std::string::npos);
    const Judged swapped(with_planted(page, "out.dUVdx = dpdx(uv);", "out.dUVdx = dpdy(uv);"),
                         "#by=webgpu", software_webgpu);
    EXPECT_GT(swapped.failing(), 0) << swapped.error();
    EXPECT_EQ(swapped.first_to_leave(), "dUVdx.U");
    const Judged none(with_planted(page, "out.dUVdx = dpdx(uv);", "out.dUVdx = missing;"),
                      "#by=webgpu", software_webgpu);
    EXPECT_NE(none.error().find("bricks_fragment.wgsl does not compile"), std::string::npos)
        << none.error();
}

/// Tables by directions are arrays of floats that are not filtered, their numbers uniforms.
TEST_F(JudgePageInABrowser, FindsWhatIsDrawnOfTablesLegal) {
    const Scene scene = load_scene(
        "rows/vdm",
        {test::sanitized ? "size=[4,4]" : "size=[12,8]", "camera.fov_y=2", "hardware=chromium",
         "material.relief.shadow=shadow-none", "material.color=null", "textures.color=null",
         "textures.height.file=" QUADREL_DATA_DIR "/textures/calibration.exr"});
    const std::string page = judge_page(scene, {{}, webgpu_limits});
    struct By {
        std::string page;
        const char *anchor, *options, *fetch, *another;
    };
    const By both[] = {
        {page, "", software_gpu, "ivec3(table_x, ", "ivec3(table_y, "},
        {busy(page), "#by=webgpu", software_webgpu, "vec2i(table_x, ", "vec2i(table_y, "}};
    for (const By& by : both) {
        const Judged judged(by.page, by.anchor, by.options);
        if (has_no_webgpu(judged)) continue;
        ASSERT_EQ(judged.error(), "");
        EXPECT_EQ(judged.failing(), 0) << judged.verdict().dump(1);
        const Judged other(with_planted(by.page, by.fetch, by.another), by.anchor, by.options);
        EXPECT_GT(other.failing(), 0) << by.another << other.error();
    }
}

/// What WebGPU has not is said where it is asked for; WebGL 2 is not touched by it.
TEST(JudgePage, SaysWhatWebGpuHasNot) {
    const Scene scene = load_scene("sampler-border-colour", {"size=[8,8]"});
    const std::string page = judge_page(scene, {{}, ""});
    EXPECT_NE(page.find("found clamp-to-border, expected a sampler that WebGPU has"),
              std::string::npos);
    EXPECT_NE(page.find("#version 3"), std::string::npos);
}

}  // namespace
}  // namespace quadrel::export_tests
