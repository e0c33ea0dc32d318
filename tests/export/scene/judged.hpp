// A judge's page of a small scene, and what a browser makes of it.
#pragma once

#include <gtest/gtest.h>

#include "browser.hpp"
#include "effort.hpp"
#include "io/document/json.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::export_tests {

inline constexpr const char* software_gpu =
    "--use-angle=swiftshader --enable-unsafe-swiftshader --virtual-time-budget=60000 --dump-dom";

/// A few pixels as those of a large picture, in few steps and with a small map of colours, so that
/// ranges are soon found and pages soon made; the light grazes. Of the browser's own software
/// renderer, whose vertices are snapped to sixteenths.
inline Scene small_scene() {
    return load_scene(
        "bricks-45",
        {test::sanitized ? "size=[8,8]" : "size=[16,12]", "camera.fov_y=2", "hardware=chromium",
         "material.relief.steps=8", "material.relief.shadow=shadow-none",
         "lights[0].position=[10,-1,0]", "material.gloss=null",
         "textures.bricks-color.file=" QUADREL_DATA_DIR "/textures/calibration.exr"});
}
/// `text` with every `from` replaced; there has to be one.
inline std::string with_planted(std::string text, const std::string& from, const std::string& to) {
    std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    for (; at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

/// The page after its script has run.
class Judged {
  public:
    Judged(const std::string& page, const std::string& anchor, const char* options = software_gpu) {
        testing_films::write_bytes(folder_ / "judge.html", page);
        ran_ = testing_browser::browse(folder_, "judge.html" + anchor, options, "dom");
        dom_ = testing_films::file_bytes(folder_ / "dom");
        verdict_ = data("verdict");
    }

    const std::string& dom() const { return dom_; }
    /// What the page's body holds as data of that name; null where it holds none.
    Json data(const std::string& name) const {
        const std::string mark = "data-" + name + "=\"";
        const std::size_t from = dom_.find(mark);
        if (from == std::string::npos) return {};
        const std::size_t start = from + mark.size();
        std::string text = dom_.substr(start, dom_.find('"', start) - start);
        for (const auto& [word, character] :
             {std::pair{"&quot;", "\""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
            for (std::size_t at; (at = text.find(word)) != std::string::npos;)
                text.replace(at, std::string(word).size(), character);
        return Json::parse(text, nullptr, false);
    }
    /// Null where the page has come to none.
    const Json& verdict() const { return verdict_; }
    std::string error() const {
        if (!ran_) return "no answer: " + testing_films::file_bytes(folder_ / "err");
        return verdict_.is_object() ? verdict_.value("error", "") : "no verdict";
    }
    int failing() const { return error().empty() ? verdict_["counts"][3].get<int>() : -1; }
    std::string first_to_leave() const { return verdict_.value("first", ""); }

  private:
    testing_films::TemporaryFolder folder_;
    bool ran_ = false;
    std::string dom_;
    Json verdict_;
};

/// Why a test is skipped under the sanitizers that others beside it do not skip.
inline constexpr const char* runs_in_browser = "what it adds runs in the browser, unsanitized";

class JudgePageInABrowser : public testing::Test {
  protected:
    void SetUp() override {
        if (testing_browser::browser().empty()) GTEST_SKIP() << testing_browser::no_browser;
    }
};

/// Whether verdicts are as they should be where nothing is wrong.
inline void expect_legal(const Judged& judged) {
    ASSERT_EQ(judged.error(), "");
    EXPECT_EQ(judged.failing(), 0) << judged.verdict().dump(1);
    int pixels = 0;
    for (const Json& count : judged.verdict()["counts"]) pixels += count.get<int>();
    EXPECT_EQ(judged.verdict()["pixels"], pixels);
    EXPECT_EQ(judged.verdict()["rows"].size(), 17u) << judged.verdict().dump(1);
    for (const Json& row : judged.verdict()["rows"])
        if (row["name"] == "uv.U" || row["name"] == "hit.U") {
            EXPECT_EQ(row["counts"][0], pixels) << row.dump();
        }
}

}  // namespace quadrel::export_tests
