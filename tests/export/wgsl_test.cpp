// Exported functions in WGSL before a browser's compiler.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "browser.hpp"
#include "page/template.hpp"

namespace quadrel::export_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;

/// What the browser says of each shader of a file, a line each: "linear: ok"; a line "none" where
/// it has no WebGPU.
std::vector<std::string> verdicts_of(const std::string& shaders) {
    page::PageTemplate page(std::filesystem::path(QUADREL_SOURCE_DIR) /
                            "tests/data/page/wgsl.html");
    page.fill("{{SHADERS}}", shaders);
    const TemporaryFolder folder;
    testing_films::write_bytes(folder / "page.html", page.text());
    if (!testing_browser::browse(folder, "page.html",
                                 "--use-angle=swiftshader --enable-unsafe-swiftshader "
                                 "--enable-unsafe-webgpu --use-webgpu-adapter=swiftshader "
                                 "--virtual-time-budget=20000 --dump-dom",
                                 "dom"))
        return {"no answer: " + file_bytes(folder / "err")};
    const std::string dom = file_bytes(folder / "dom"), start = "<pre id=\"verdicts\">";
    const std::size_t from = dom.find(start) + start.size();
    std::istringstream lines(dom.substr(from, dom.find("</pre>", from) - from));
    std::vector<std::string> verdicts;
    for (std::string line; std::getline(lines, line);) verdicts.push_back(line);
    return verdicts;
}

TEST(Export, WgslCompilesInABrowser) {
    if (testing_browser::browser().empty()) GTEST_SKIP() << testing_browser::no_browser;
    const std::string shaders = file_bytes(std::string(QUADREL_EXPORTED_FOLDER) + "/each.wgsl");
    const std::vector<std::string> verdicts =
        verdicts_of(shaders + "=== planted\nfn wrong(x: f32) -> i32 {\n    return x;\n}\n");
    if (verdicts == std::vector<std::string>{"none"}) GTEST_SKIP() << "the browser has no WebGPU";
    std::size_t count = 0;
    for (std::size_t at = shaders.find("=== "); at != std::string::npos;
         at = shaders.find("=== ", at + 1))
        ++count;
    EXPECT_GT(count, 100u);
    ASSERT_EQ(verdicts.size(), count + 1) << verdicts.back();
    for (std::size_t i = 0; i < count; ++i)
        EXPECT_TRUE(verdicts[i].ends_with(": ok")) << verdicts[i];
    EXPECT_FALSE(verdicts[count].ends_with(": ok"));
}

}  // namespace
}  // namespace quadrel::export_tests
