// The judge's page by WebGPU: what a browser draws from WGSL is found legal, and a shader that was
// changed is not.
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
