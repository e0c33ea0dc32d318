// Where rays of a range are said to meet a field first, against the judge's word on rays of it.
#include "effort.hpp"
#include "quadrel/relief/range_words.hpp"
#include "quadrel/relief/trace/search/range_first_hit.hpp"
#include "relief/oracle/judged.hpp"

namespace quadrel::test {
namespace {

using range_detail::FieldHits;
using range_detail::FirstParts;

/// Where a field is met by rays of a range; nothing where they are too many or too long.
struct FirstHits {
    FieldHits field;
    std::optional<FirstParts> found;

    FirstHits(const SampledTexture& map, judge::Surface surface, const judge::RayRange& rays)
        : field(map, surface, rays) {
        if (field.places().are_short()) found.emplace(field, field.places().shortest());
    }
    bool known() const { return found && found->known(); }
    int parts() const { return found->count(); }
    const RealInterval& part(int k) const { return (*found)[k]; }
    bool passes() const { return found->passes(); }
    RealInterval height_in(const RealInterval& s) const { return field.height_in(s); }
};

bool is_within(const RealInterval& part, const judge::Hit& hit) {
    return hit.s >= part.lo - hit.bound && hit.s <= part.hi + hit.bound;
}

testing::AssertionResult hold(const FirstHits& hits, const judge::Hit& hit) {
    if (hit.status == Status::floor && hits.passes()) return testing::AssertionSuccess();
    for (int k = 0; k < hits.parts(); ++k) {
        if (!is_within(hits.part(k), hit)) continue;
        const RealInterval height = hits.height_in(hits.part(k));
        if (hit.height >= height.lo - 1e-12 && hit.height <= height.hi + 1e-12)
            return testing::AssertionSuccess();
    }
    return testing::AssertionFailure()
           << "s " << hit.s << ", height " << hit.height << ", in none of " << hits.parts();
}

struct PartsFound {
    int ranges = 0, known = 0, several = 0;
    double width = 0;  ///< of all parts together, summed
};

/// Rays up to `apart` from those of every kind of map, asked for as if they were no further apart
/// than `claimed`, on a surface as if it were `asked`.
testing::AssertionResult all_are_held(double apart, double claimed, judge::Surface surface,
                                      judge::Surface asked, PartsFound& found) {
    constexpr int samples = 6;
    const auto check = [&](const JudgedMap& map, const judge::Ray& ray, int, Random& random) {
        const FirstHits hits(map.height.sampled, asked, about(ray, claimed));
        ++found.ranges;
        if (!hits.known()) return testing::AssertionSuccess();
        ++found.known;
        found.several += hits.parts() > 1;
        for (int k = 0; k < hits.parts(); ++k) found.width += hits.part(k).width();
        testing::AssertionResult result = testing::AssertionSuccess();
        for (int i = 0; i < samples && result; ++i) {
            const judge::Ray one = one_of(about(ray, apart), random);
            result = hold(hits, judge::first_hit(map.field(surface), one));
        }
        return result;
    };
    return on_stress_rays(rounds(3) * 4, 7, check);
}

TEST(FirstHits, HoldThoseOfEachRay) {
    for (const judge::Surface surface : {judge::Surface::bilinear, judge::Surface::block})
        for (const double apart : {1e-9, 1e-4, 1e-2}) {
            PartsFound found;
            EXPECT_TRUE(all_are_held(apart, apart, surface, surface, found)) << apart;
            EXPECT_GT(found.known, found.ranges / 2) << apart;
            if (apart == 1e-4) {
                EXPECT_GT(found.several, 0);
            }
        }
}

TEST(FirstHits, HoldThoseOnTriangles) {
    for (const judge::Surface surface :
         {judge::Surface::tri_main, judge::Surface::tri_anti, judge::Surface::tri_min}) {
        PartsFound found;
        EXPECT_TRUE(all_are_held(1e-4, 1e-4, surface, surface, found));
        EXPECT_GT(found.known, found.ranges / 2);
    }
}

/// What is said of other rays, or of another surface, does not hold.
TEST(FirstHits, DoNotHoldThoseOfOthers) {
    PartsFound found;
    const auto bilinear = judge::Surface::bilinear, block = judge::Surface::block;
    EXPECT_FALSE(all_are_held(1e-2, 1e-4, bilinear, bilinear, found));
    EXPECT_FALSE(all_are_held(1e-9, 1e-9, bilinear, block, found));
    EXPECT_FALSE(all_are_held(1e-9, 1e-9, block, bilinear, found));
}

/// Parts are as wide as the rays are apart, not wider by much.
TEST(FirstHits, AreNarrow) {
    PartsFound found;
    const auto bilinear = judge::Surface::bilinear;
    EXPECT_TRUE(all_are_held(1e-9, 1e-9, bilinear, bilinear, found));
    EXPECT_LT(found.width / found.known, 0.02);  // rays along a surface among them
    PartsFound wider;
    EXPECT_TRUE(all_are_held(1e-2, 1e-2, bilinear, bilinear, wider));
    EXPECT_GT(wider.width, 2 * found.width);
}

/// A chord's end in a bracket, of heights of which hardly anything is known.
TEST(Chords, StayWithinTheirBrackets) {
    Random random(21);
    for (int i = 0; i < rounds(20000); ++i) {
        const double above = random.uniform(0, 0.9), below = above + random.uniform(0, 0.1);
        const double ends[2] = {1 - above - random.uniform(0, 0.1),
                                1 - below + random.uniform(0, 0.1)};
        const double off = random.chance(0.1) ? 10 : random.uniform(0, 0.2);
        const auto around = [&](double x) {
            return Ranges(Ranged(x - off * random.uniform(0, 1), x + off * random.uniform(0, 1)));
        };
        Bracket<Ranges> ranges;
        ranges.s_above = Ranges(above);
        ranges.s_below = Ranges(below);
        ranges.h_above = around(ends[0]);
        ranges.h_below = around(ends[1]);
        Bracket<Quad<double>> numbers;
        numbers.s_above = Quad<double>(above);
        numbers.s_below = Quad<double>(below);
        numbers.h_above = Quad<double>(ends[0]);
        numbers.h_below = Quad<double>(ends[1]);
        const double exact = chord(numbers).lane[0];
        const RealInterval range = chord(ranges).lane[0].range();
        ASSERT_GE(exact, range.lo - 1e-15);
        ASSERT_LE(exact, range.hi + 1e-15);
        ASSERT_GE(range.lo, above - 1e-15);
        ASSERT_LE(range.hi, below + 1e-15);
    }
}

}  // namespace
}  // namespace quadrel::test
