// The judge of conformance: films that are made to differ in one way or another get the verdict
// that they have earned.
#include <gtest/gtest.h>

#include <bit>
#include <functional>

#include "conformance/judge.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::tools_tests {
namespace {

using conformance::count_of;
using conformance::GroupReport;
using conformance::total;
using conformance::Verdict;

const std::vector<std::string>& channels() {
    static const std::vector<std::string> names{
        "A", "P", "uv", "dUVdx", "dUVdy", "dPdx", "dPdy", "K", "hit", "N", "shadow.visibility",
        "R", "G", "B"};
    return names;
}

const Scene& scene() {
    static const Scene loaded =
        load_scene("rows/linear", {"size=[48,48]", "material.relief.steps=24"});
    return loaded;
}

/// A render of the scene, with what `changed` has of these values from there on.
Film drawn(const std::string& values = "", const Film* changed = nullptr) {
    RenderOptions options;
    options.channels = channels();
    if (changed != nullptr)
        options.injected = {{values, std::make_shared<const Film>(*changed), "test"}};
    return render(scene(), options);
}

bool is_covered(const Film& film, std::size_t i) { return film.find("A")->as_float(i) > 0; }

/// Another value at every so many covered pixels.
Film with(Film film, const std::string& channel, std::size_t every,
          const std::function<float(float)>& change) {
    Plane& plane = *film.find(channel);
    for (std::size_t i = 0; i < plane.bits.size(); i += every)
        if (is_covered(film, i))
            plane.bits[i] = std::bit_cast<std::uint32_t>(change(plane.as_float(i)));
    return film;
}

std::vector<GroupReport> judged(const Film& film, std::size_t most_ranged = 200) {
    conformance::JudgeOptions options;
    options.texel = {1.0 / 256, 1.0 / 256};
    options.most_ranged = most_ranged;
    return judge(scene(), film, options);
}

std::uint64_t count(const std::vector<GroupReport>& reports, const std::string& group,
                    Verdict verdict) {
    for (const GroupReport& report : reports)
        if (report.name == group) return count_of(report.counts, verdict);
    ADD_FAILURE() << "no group " << group;
    return 0;
}

std::uint64_t count(const std::vector<GroupReport>& reports, Verdict verdict) {
    std::uint64_t sum = 0;
    for (const GroupReport& report : reports) sum += count_of(report.counts, verdict);
    return sum;
}

TEST(Conformance, TheReferenceIsTheSameEverywhere) {
    const auto reports = judged(drawn());
    EXPECT_EQ(reports.size(), 8u);
    for (const GroupReport& report : reports) {
        EXPECT_EQ(count_of(report.counts, Verdict::same), 48u * 48u) << report.name;
        EXPECT_EQ(total(report.counts), 48u * 48u) << report.name;
    }
}

/// K of another rounding, and what Quadrel makes of it: the search is as it should be, and K is in
/// its range.
TEST(Conformance, RoundingIsLegalAndWhatFollowsInherits) {
    const Film rounded = with(drawn(), "K.U", 7, [](float k) {
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(k) + 2);
    });
    const auto reports = judged(drawn("K", &rounded));
    EXPECT_GT(count(reports, "frame", Verdict::legal), 20u);
    EXPECT_EQ(count(reports, "uv", Verdict::same), 48u * 48u);
    EXPECT_GT(count(reports, "hit", Verdict::inherited), 20u);
    EXPECT_EQ(count(reports, Verdict::unexplained), 0u);
    EXPECT_EQ(count(reports, Verdict::left), 0u);
    // Fewer quads are looked at than there are.
    EXPECT_GT(count(judged(drawn("K", &rounded), 4), "frame", Verdict::left), 10u);
}

/// Look-ups that are off by a part of a texel's weight, which is no more than permitted, or is.
TEST(Conformance, WeightsMayBeOffByAPart) {
    const Film own = drawn();
    const auto shifted = [&](double texels) {
        const Film moved =
            with(own, "uv.U", 1, [&](float u) { return static_cast<float>(u + texels / 256); });
        Film film = drawn("uv", &moved);
        // Searches began elsewhere; their results are told from where they should have begun.
        for (const char* name : {"uv.U", "uv.V", "dUVdx.U", "dUVdx.V", "dUVdy.U", "dUVdy.V", "K.U",
                                 "K.V", "P.X", "dPdx.X"})
            *film.find(name) = *own.find(name);
        return with(film, "hit.U", 1,
                    [&](float u) { return static_cast<float>(u - texels / 256); });
    };
    const auto permitted = judged(shifted(0x1p-10));
    EXPECT_GT(count(permitted, "hit", Verdict::perturbed), 100u);
    EXPECT_EQ(count(permitted, "hit", Verdict::unexplained), 0u);
    EXPECT_GT(count(judged(shifted(0.2)), "hit", Verdict::unexplained), 20u);
}

/// What no error explains, stage by stage.
TEST(Conformance, WrongValuesAreUnexplained) {
    const Film own = drawn();
    const auto wrong = [&](const char* channel, const char* group,
                           const std::function<float(float)>& change) {
        const auto reports = judged(with(own, channel, 29, change));
        for (const GroupReport& report : reports)
            if (report.name == group) {
                EXPECT_FALSE(report.examples.empty()) << channel;
            }
        return count(reports, group, Verdict::unexplained);
    };
    EXPECT_GT(wrong("uv.U", "uv", [](float u) { return u + 0.01f; }), 10u);
    EXPECT_GT(wrong("dUVdx.U", "derivatives", [](float d) { return 2 * d + 0.01f; }), 10u);
    EXPECT_GT(wrong("K.V", "frame", [](float k) { return 1.001f * k + 0.001f; }), 10u);
    EXPECT_GT(wrong("hit.s", "hit", [](float s) { return s + 0.5f; }), 10u);
    EXPECT_GT(wrong("N.Z", "normal", [](float) { return std::nanf(""); }), 10u);
    EXPECT_GT(wrong("shadow.visibility", "shadow", [](float v) { return v + 2; }), 10u);
    EXPECT_GT(wrong("G", "color", [](float g) { return g + 1; }), 10u);
}

/// A pixel that one side alone covers is permitted beside an edge, and nowhere else.
TEST(Conformance, CoverageIsJudgedByEdges) {
    const Film own = drawn();
    Film film = own;
    const std::size_t middle = film.index(24, 24);
    film.find("A")->bits[middle] = 0;
    const auto reports = judged(film);
    EXPECT_EQ(count(reports, "coverage", Verdict::unexplained), 1u);
    EXPECT_EQ(count(reports, "hit", Verdict::same), 48u * 48u - 1);
}

}  // namespace
}  // namespace quadrel::tools_tests
