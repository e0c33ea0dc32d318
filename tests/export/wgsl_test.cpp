// Exported functions in WGSL before a browser's compiler.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "export/wgsl_page.hpp"

namespace quadrel::export_tests {
namespace {

using testing_films::file_bytes;

TEST(Export, WgslCompilesInABrowser) {
    if (testing_browser::browser().empty()) GTEST_SKIP() << testing_browser::no_browser;
    const std::string shaders = file_bytes(std::string(QUADREL_EXPORTED_FOLDER) + "/each.wgsl");
    const std::vector<std::string> verdicts = browser_verdicts(
        "wgsl.html", shaders + "=== planted\nfn wrong(x: f32) -> i32 {\n    return x;\n}\n");
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
