// The judge of conformance: films that are made to differ in one way or another get the verdict
// that they have earned.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/constants.hpp>

#include "conformance/judge/judge.hpp"
#include "conformance/judge/reruns.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "render/plan/prepared.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel::tools_tests {
namespace {

using conformance::count_of;
using conformance::GroupReport;
using conformance::total;
using conformance::Verdict;

const std::vector<std::string>& channels() {
    static const std::vector<std::string> names{"A",          "P",    "uv",   "dUVdx",
                                                "dUVdy",      "dPdx", "dPdy", "K",
                                                "lod.lambda", "hit",  "N",    "shadow.visibility",
                                                "R",          "G",    "B"};
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

/// What is not explained, for failures.
std::string examples(const std::vector<GroupReport>& reports) {
    std::string text;
    for (const GroupReport& report : reports)
        for (const conformance::Unexplained& pixel : report.examples)
            text += fmt::format("{} at {},{}: {} for {}\n", pixel.channel, pixel.x, pixel.y,
                                std::bit_cast<float>(pixel.found),
                                std::bit_cast<float>(pixel.reference));
    return text;
}

TEST(Conformance, TheReferenceIsTheSameEverywhere) {
    const auto reports = judged(drawn());
    EXPECT_EQ(reports.size(), 9u);
    for (const GroupReport& report : reports) {
        EXPECT_EQ(count_of(report.counts, Verdict::same), 48u * 48u) << report.name;
        EXPECT_EQ(total(report.counts), 48u * 48u) << report.name;
    }
}

/// K of another rounding, and what Quadrel makes of it: the search is as it should be. What sums
/// lose more is too much.
TEST(Conformance, RoundingIsPermittedAndWhatFollowsInherits) {
    const auto with_k = [](float factor, std::size_t most_ranged) {
        const Film other = with(drawn(), "K.V", 7, [&](float k) { return k * factor; });
        return judged(drawn("K", &other), most_ranged);
    };
    const auto rounded = with_k(1 + 0x1p-21f, 200);
    EXPECT_GT(count(rounded, "frame", Verdict::rounded), 20u);
    EXPECT_EQ(count(rounded, "uv", Verdict::same), 48u * 48u);
    EXPECT_GT(count(rounded, "hit", Verdict::inherited), 20u);
    EXPECT_EQ(count(rounded, Verdict::unexplained), 0u) << examples(rounded);
    EXPECT_EQ(count(rounded, Verdict::left), 0u);
    const auto wrong = with_k(1 + 0x1p-15f, 400);
    EXPECT_GT(count(wrong, "frame", Verdict::unexplained), 20u);
    EXPECT_GT(count(wrong, "hit", Verdict::inherited), 20u);
    // Ranges of a frame are had for next to nothing; of searches fewer quads are looked at.
    const Film wrong_hits = with(drawn(), "hit.s", 7, [](float s) { return s + 0.5f; });
    EXPECT_EQ(count(with_k(1 + 0x1p-15f, 4), "frame", Verdict::left), 0u);
    EXPECT_GT(count(judged(wrong_hits, 4), "hit", Verdict::left), 10u);
}

TEST(Conformance, LevelsHaveTheirRange) {
    const auto moved_by = [](float by) {
        return judged(with(drawn(), "lod.lambda", 7, [&](float level) { return level + by; }));
    };
    const auto permitted = moved_by(0.02f);
    EXPECT_GT(count(permitted, "level", Verdict::legal), 20u);
    EXPECT_EQ(count(permitted, Verdict::unexplained), 0u) << examples(permitted);
    EXPECT_GT(count(moved_by(-0.2f), "level", Verdict::unexplained), 20u);
}

/// Look-ups that are off by a part of a texel's weight, which is no more than permitted, or is.
TEST(Conformance, WeightsMayBeOffByAPart) {
    const Film own = drawn();
    const auto shifted = [&](double texels) {
        const auto moved = [texels](float u) { return static_cast<float>(u + texels / 256); };
        const auto back = [texels](float u) { return static_cast<float>(u - texels / 256); };
        const Film start = with(own, "uv.U", 1, moved);
        Film film = drawn("uv,dUVdx,dUVdy,K", &start);
        // Searches began elsewhere; they say that they did not.
        *film.find("uv.U") = *own.find("uv.U");
        return with(film, "hit.U", 1, back);
    };
    const auto permitted = judged(shifted(0x1p-10));
    EXPECT_GT(count(permitted, "hit", Verdict::perturbed), 100u);
    EXPECT_EQ(count(permitted, "hit", Verdict::unexplained), 0u) << examples(permitted);
    EXPECT_GT(count(judged(shifted(0.2)), "hit", Verdict::unexplained), 20u);
}

/// Light or shadow, where a decision is open: what is neither is not permitted.
TEST(Conformance, WhatLiesInAGapIsUnexplained) {
    const auto reports = judged(with(drawn(), "shadow.visibility", 5, [](float) { return 0.5f; }));
    EXPECT_EQ(count(reports, "shadow", Verdict::legal), 0u);
    EXPECT_GT(count(reports, "shadow", Verdict::unexplained), 100u);
}

/// Filters that give each height somewhat more: by no more than is permitted, or by more.
TEST(Conformance, HeightsMayBeOffByAPart) {
    const auto with_heights = [](double factor) {
        RenderOptions options;
        options.channels = channels();
        PreparedRender prepared = prepare_render(scene(), options, select_kernels(options));
        const conformance::ScaledHeights scaled(prepared.plan, factor);
        return judged(draw(prepared, options));
    };
    const auto permitted = with_heights(1 + 0x1p-17);
    EXPECT_GT(count(permitted, "hit", Verdict::perturbed), 100u);
    EXPECT_EQ(count(permitted, "hit", Verdict::unexplained), 0u) << examples(permitted);
    EXPECT_GT(count(with_heights(1.01), "hit", Verdict::unexplained), 20u);
}

/// Halving ends a piece away where an error flips a test: what a small part of an error gives may
/// lie beyond all that the whole of it gives.
TEST(Conformance, ErrorsMayBeSmallerThanPermitted) {
    for (const char* const row : {"rows/curved-quadric", "rows/prism-free"}) {
        const Scene halving = load_scene(row, {"size=[64,64]"});
        RenderOptions options;
        options.channels = channels();
        PreparedRender prepared = prepare_render(halving, options, select_kernels(options));
        const conformance::ScaledHeights scaled(prepared.plan, 1 - 7e-6);
        conformance::JudgeOptions judging;
        judging.texel = {1.0 / 256, 1.0 / 256};
        const auto reports = conformance::judge(halving, draw(prepared, options), judging);
        EXPECT_GT(count(reports, "hit", Verdict::perturbed), 100u) << row;
        EXPECT_EQ(count(reports, "hit", Verdict::unexplained), 0u) << row << examples(reports);
    }
}

/// The vector to the eye, which no image has: off by no more than is permitted, or by more.
TEST(Conformance, RaysOfVertexProgramsMayBeOffByAPart) {
    const Scene curved = load_scene("rows/curved-quadric-published", {"size=[48,48]"});
    const auto with_eye = [&](double part) {
        RenderOptions options;
        options.channels = channels();
        PreparedRender prepared = prepare_render(curved, options, select_kernels(options));
        conformance::move_eye(prepared.geometry, {part, -part, part});
        return conformance::judge(curved, draw(prepared, options), {});
    };
    const auto permitted = with_eye(0x1p-21);
    EXPECT_GT(count(permitted, "hit", Verdict::perturbed), 0u);
    EXPECT_EQ(count(permitted, "hit", Verdict::unexplained), 0u) << examples(permitted);
    EXPECT_GT(count(with_eye(0x1p-10), "hit", Verdict::unexplained), 20u);
    EXPECT_TRUE(conformance::has_vertex_rays(curved));
    EXPECT_FALSE(conformance::has_vertex_rays(load_scene("rows/curved-quadric", {})));
}

/// A search that turns the frame: what channels have of it is the hit's, and no search starts from
/// it. hit.s is a difference of heights.
TEST(Conformance, ATurnedFrameBelongsToTheHit) {
    const Scene curved = load_scene("rows/curved-quadric", {"size=[48,48]"});
    RenderOptions options;
    options.channels = channels();
    options.channels.insert(options.channels.end(), {"T", "frame_normal", "r"});
    const Film own = render(curved, options);
    const auto count_with = [&](const char* channel, float by, const char* group, Verdict verdict) {
        const Film film = with(own, channel, 7, [by](float x) { return x + by; });
        const auto reports = conformance::judge(curved, film, {});
        if (verdict != Verdict::unexplained) {
            EXPECT_EQ(count(reports, Verdict::unexplained), 0u) << examples(reports);
        }
        return count(reports, group, verdict);
    };
    EXPECT_GT(count_with("T.X", 0x1p-21f, "hit", Verdict::rounded), 20u);
    EXPECT_GT(count_with("frame_normal.Y", 0.01f, "hit", Verdict::unexplained), 20u);
    EXPECT_GT(count_with("hit.s", 0x1p-22f, "hit", Verdict::rounded), 20u);
    EXPECT_GT(count_with("hit.s", 0x1p-18f, "hit", Verdict::unexplained), 20u);

    // What the normal is made of is the frame at the hit.
    const Film turned = with(own, "frame_normal.Y", 7, [](float y) { return y + 0x1p-21f; });
    options.injected = {{"frame_normal", std::make_shared<const Film>(turned), "test"}};
    const auto reports = conformance::judge(curved, render(curved, options), {});
    EXPECT_GT(count(reports, "hit", Verdict::rounded), 20u);
    EXPECT_GT(count(reports, "normal", Verdict::inherited), 20u);
    EXPECT_EQ(count(reports, Verdict::unexplained), 0u) << examples(reports);
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

/// Values that are the reference's once min and max are written out as comparisons differ by what
/// these make of NaN, which is left open; where that changes nothing, something else is wrong.
TEST(Conformance, WhatMinMakesOfNanIsOpen) {
    const Film own = drawn();
    const Film wrong = with(own, "hit.s", 29, [](float s) { return s + 0.5f; });
    const auto judged_with = [&](const Film& written_out) {
        conformance::JudgeOptions options;
        options.texel = {1.0 / 256, 1.0 / 256};
        options.redraws = {{Verdict::unordered, [&] { return written_out; }}};
        return conformance::judge(scene(), wrong, options);
    };
    const auto open = judged_with(own);
    EXPECT_GT(count(open, "hit", Verdict::unordered), 10u);
    EXPECT_EQ(count(open, Verdict::unexplained), 0u) << examples(open);
    const auto still_wrong = judged_with(wrong);
    EXPECT_EQ(count(still_wrong, Verdict::unordered), 0u);
    EXPECT_GT(count(still_wrong, "hit", Verdict::unexplained), 10u);
}

/// A second quad of other texture coordinates, so far behind the first one.
Scene with_second_quad(float behind) {
    Scene two = scene();
    two.objects.push_back(two.objects.front());
    Object& second = two.objects.back();
    second.name = "second";
    second.transform = glm::translate(second.transform, glm::vec3(0, 0, -behind));
    second.transform = glm::rotate(second.transform, glm::half_pi<float>(), glm::vec3(0, 0, 1));
    return two;
}

/// What is seen of two objects at one depth is decided by roundings, of two at others it is not.
TEST(Conformance, OfTwoObjectsAtOneDepthEitherIsSeen) {
    for (const float behind : {0.0f, 0.01f}) {
        const Scene two = with_second_quad(behind);
        Scene second = two;
        second.objects.front().visible = false;
        RenderOptions options;
        options.channels = channels();
        const auto reports = conformance::judge(two, render(second, options), {});
        EXPECT_EQ(count(reports, "uv", Verdict::coverage) > 100u, behind == 0) << behind;
        EXPECT_EQ(count(reports, "uv", Verdict::unexplained) > 100u, behind != 0) << behind;
    }
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
