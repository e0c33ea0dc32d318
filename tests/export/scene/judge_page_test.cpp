// The judge's page in a browser: a scene drawn by the browser's own GPU is found legal, and one
// whose shader was changed is not.
#include "export/scene/judge_page.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "browser.hpp"
#include "io/document/json.hpp"
#include "quadrel/error.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::export_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;

constexpr const char* software_gpu =
    "--use-angle=swiftshader --enable-unsafe-swiftshader --virtual-time-budget=60000 --dump-dom";
constexpr const char* no_gpu =
    "--disable-gpu --disable-software-rasterizer --disable-3d-apis --virtual-time-budget=20000 "
    "--dump-dom";

/// Small, and of one level of detail, so that ranges are soon found.
Scene small_scene(std::vector<std::string> more = {}) {
    std::vector<std::string> assignments = {"size=[24,16]", "material.relief.steps=24",
                                            "material.height.mip=none"};
    assignments.insert(assignments.end(), more.begin(), more.end());
    return load_scene("bricks-45", assignments);
}

/// The page after its script has run.
class Judged {
  public:
    Judged(const std::string& page, const std::string& anchor, const char* options = software_gpu) {
        testing_films::write_bytes(folder_ / "judge.html", page);
        ran_ = testing_browser::browse(folder_, "judge.html" + anchor, options, "dom");
        dom_ = file_bytes(folder_ / "dom");
        const std::string mark = "data-verdict=\"";
        const std::size_t from = dom_.find(mark);
        if (from == std::string::npos) return;
        const std::size_t start = from + mark.size();
        std::string text = dom_.substr(start, dom_.find('"', start) - start);
        for (const auto& [word, character] :
             {std::pair{"&quot;", "\""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
            for (std::size_t at; (at = text.find(word)) != std::string::npos;)
                text.replace(at, std::string(word).size(), character);
        verdict_ = Json::parse(text, nullptr, false);
    }

    const std::string& dom() const { return dom_; }
    /// Null where the page has come to none.
    const Json& verdict() const { return verdict_; }
    std::string error() const {
        if (!ran_) return "no answer: " + file_bytes(folder_ / "err");
        return verdict_.is_object() ? verdict_.value("error", "") : "no verdict";
    }
    int failing() const { return error().empty() ? verdict_["counts"][3].get<int>() : -1; }
    std::string first_to_leave() const { return verdict_.value("first", ""); }

  private:
    TemporaryFolder folder_;
    bool ran_ = false;
    std::string dom_;
    Json verdict_;
};

class JudgePageInABrowser : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (!testing_browser::browser().empty()) page() = judge_page(small_scene(), {});
    }
    void SetUp() override {
        if (testing_browser::browser().empty()) GTEST_SKIP() << testing_browser::no_browser;
    }
    static std::string& page() {
        static std::string made;
        return made;
    }
};

TEST_F(JudgePageInABrowser, FindsWhatItsGpuDrawsLegal) {
    const Judged judged(page(), "#view=classes&channel=hit.U&pixel=12,8");
    ASSERT_EQ(judged.error(), "");
    EXPECT_EQ(judged.failing(), 0) << judged.verdict().dump(1);
    int pixels = 0;
    for (const Json& count : judged.verdict()["counts"]) pixels += count.get<int>();
    EXPECT_EQ(pixels, 24 * 16);
    EXPECT_GT(judged.verdict()["counts"][0].get<int>(), 0);
    EXPECT_EQ(judged.verdict()["rows"].size(), 18u) << judged.verdict().dump(1);
    // Values of both sides at the pixel.
    EXPECT_NE(judged.dom().find("data-of=\"0 hit.U 0x"), std::string::npos);
    EXPECT_NE(judged.dom().find("data-of=\"1 hit.U 0x"), std::string::npos);
    EXPECT_NE(judged.dom().find("No channel leaves its range here."), std::string::npos);
}

}  // namespace
}  // namespace quadrel::export_tests
