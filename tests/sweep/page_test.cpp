// The page in a browser: it draws its charts, at two widths, light and dark, without an error.
#include "sweep/report/page.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "browser.hpp"
#include "quadrel/texture/image.hpp"
#include "sweep/plan_files.hpp"
#include "sweep/report/results.hpp"
#include "sweep/sweep.hpp"

namespace quadrel::sweep_tests {
namespace {

using namespace quadrel::sweep;
using testing_films::file_bytes;
using testing_films::TemporaryFolder;

bool browse(const TemporaryFolder& folder, const std::string& options, const std::string& out) {
    return testing_browser::browse(folder, "out/page.html", "--disable-gpu " + options, out);
}

class Page : public testing::Test {
  protected:
    void SetUp() override {
        if (testing_browser::browser().empty()) GTEST_SKIP() << testing_browser::no_browser;
        const Plan plan = plan_of(folder, small_plan());
        write_results(folder / "out", "A test",
                      run_sweep(plan, {folder / "out", 1, 1, "test", {}}).records);
    }
    TemporaryFolder folder;
};

/// The attribute that the script sets when it has drawn all charts.
bool has_drawn(const std::string& dom) {
    const std::size_t at = dom.find("data-drawn=\"");
    return at != std::string::npos && std::atoi(dom.c_str() + at + 12) >= 3;
}

TEST_F(Page, DrawsItsCharts) {
    ASSERT_TRUE(browse(folder, "--dump-dom", "dom")) << file_bytes(folder / "err");
    const std::string dom = file_bytes(folder / "dom");
    EXPECT_TRUE(has_drawn(dom)) << file_bytes(folder / "err");
    EXPECT_NE(dom.find("<td class=\"word\">spikes</td>"), std::string::npos);
    EXPECT_NE(dom.find("<figcaption>"), std::string::npos);
    // A script that ends early draws nothing.
    std::string broken = file_bytes(folder / "out" / "page.html");
    broken.replace(broken.find("function start()"), 16, "function strat()");
    testing_films::write_bytes(folder / "out" / "page.html", broken);
    ASSERT_TRUE(browse(folder, "--dump-dom", "dom"));
    EXPECT_FALSE(has_drawn(file_bytes(folder / "dom")));
}

/// The share of the picture's pixels that are as the corner is.
double share_of_ground(const Image& image) {
    std::size_t same = 0;
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < image.values.size(); i += channels)
        same += image.values[i] == image.values[0];
    return static_cast<double>(same * channels) / static_cast<double>(image.values.size());
}

TEST_F(Page, IsReadWideAndLightNarrowAndDark) {
    for (const bool dark : {false, true}) {
        const std::string width = dark ? "400" : "2000";
        const std::string mode = dark ? "--blink-settings=preferredColorScheme=0 " : "";
        ASSERT_TRUE(browse(
            folder, "--window-size=" + width + ",1200 " + mode + "--screenshot=shot.png", "log"))
            << file_bytes(folder / "err");
        const Image image = load_image(folder / "shot.png");
        EXPECT_EQ(image.width, std::stoi(width));
        EXPECT_EQ(image.values[0] < 0.5, dark) << image.values[0];
        EXPECT_LT(share_of_ground(image), 0.995);
        EXPECT_GT(share_of_ground(image), 0.5);
    }
}

}  // namespace
}  // namespace quadrel::sweep_tests
