// Whether all rays of a range towards a light are said to be hidden, or none, against the judge's
// word on rays of it.
#include "effort.hpp"
#include "quadrel/relief/range_words.hpp"
#include "quadrel/relief/shadow/range_rising.hpp"
#include "relief/oracle/judged.hpp"

namespace quadrel::test {
namespace {

using range_detail::RisingRays;

struct AnswersGiven {
    int lit = 0, dark = 0, either = 0;
};

/// Rays upwards up to `apart` from those over every kind of map, asked for as if they were no
/// further apart than `claimed`.
testing::AssertionResult all_are_as_said(double apart, double claimed, AnswersGiven& given) {
    constexpr int samples = 6;
    const auto check = [&](const JudgedMap& map, const judge::Ray& ray, int, Random& random) {
        const judge::RayRange range = about(ray, claimed);
        const auto answer =
            RisingRays(map.height.sampled, {range.u, range.v}, {range.Ku, range.Kv}).answer();
        given.lit += answer == RisingRays::lit;
        given.dark += answer == RisingRays::dark;
        given.either += answer == RisingRays::either;
        for (int i = 0; i < samples && answer != RisingRays::either; ++i) {
            const judge::Ray one = one_of(about(ray, apart), random);
            std::int32_t steps = 0;
            const bool dark = judge::is_occluded(map.field(judge::Surface::bilinear),
                                                 {one.u, one.v, one.Ku, one.Kv, 0}, steps);
            if (dark != (answer == RisingRays::dark))
                return testing::AssertionFailure() << (dark ? "dark" : "lit");
        }
        return testing::AssertionSuccess();
    };
    return on_stress_rays(rounds(8) * 4, 11, check);
}

TEST(RisingRays, AreAsSaid) {
    for (const double apart : {1e-9, 1e-5, 1e-3}) {
        AnswersGiven given;
        EXPECT_TRUE(all_are_as_said(apart, apart, given)) << apart;
        EXPECT_GT(given.lit, 0) << apart;
        EXPECT_GT(given.dark, 0) << apart;
        if (apart < 1e-8) {
            EXPECT_GT(given.lit + given.dark, 4 * given.either);
        }
    }
}

/// What is said of rays that lie closer together does not hold.
TEST(RisingRays, AreNotThoseOfOthers) {
    AnswersGiven given;
    EXPECT_FALSE(all_are_as_said(1e-2, 1e-6, given));
}

}  // namespace
}  // namespace quadrel::test
