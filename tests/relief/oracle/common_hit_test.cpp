// What all rays of a range are said to have in common, against the judge's word on rays of it.
#include "quadrel/relief/trace/oracle/common_hit.hpp"

#include "effort.hpp"
#include "relief/oracle/judged.hpp"

namespace quadrel::test {
namespace {

using judge::CommonHit;
using judge::RayRange;

testing::AssertionResult holds(const CommonHit& common, const judge::Hit& hit) {
    if (hit.status != common.status)
        return testing::AssertionFailure() << "another status at " << hit.s;
    if (hit.status != Status::hit) return testing::AssertionSuccess();
    if (hit.cell_x != common.cell_x || hit.cell_y != common.cell_y)
        return testing::AssertionFailure() << "another cell at " << hit.s;
    return hit.s >= common.lo - hit.bound && hit.s <= common.hi + hit.bound
               ? testing::AssertionSuccess()
               : testing::AssertionFailure()
                     << hit.s << " not in " << common.lo << " to " << common.hi;
}

struct Shares {
    int rays = 0, proven = 0;
};

/// Rays of every kind of map and surface. `claimed` of `apart`: the range whose rays are asked for
/// what they have in common.
testing::AssertionResult all_hold(double apart, double claimed, Shares& shares) {
    constexpr int samples = 6;
    const auto check = [&](const JudgedMap& map, const judge::Ray& ray, int lane, Random& random) {
        const auto surface = surfaces[static_cast<std::size_t>(lane) % surfaces.size()];
        const CommonHit common = judge::common_hit(map.field(surface), about(ray, claimed));
        ++shares.rays;
        if (common.reason != Uncertified::proven) return testing::AssertionSuccess();
        ++shares.proven;
        testing::AssertionResult result = testing::AssertionSuccess();
        for (int i = 0; i < samples && result; ++i) {
            const judge::Ray one = one_of(about(ray, apart), random);
            result = holds(common, judge::first_hit(map.field(surface), one));
        }
        return result;
    };
    return on_stress_rays(rounds(16) * 4, 90, check);
}

TEST(CommonHit, HoldsForEachRayOfItsRange) {
    for (const double apart : {1e-12, 1e-6, 1e-3}) {
        Shares shares;
        EXPECT_TRUE(all_hold(apart, apart, shares)) << apart;
        EXPECT_GT(shares.proven, 0) << apart;
    }
}

/// What is said of a narrower range, or of one ray, does not hold for a wide one.
TEST(CommonHit, DoesNotHoldForOthers) {
    Shares shares;
    EXPECT_FALSE(all_hold(1e-2, 1e-3, shares));
    EXPECT_FALSE(all_hold(1e-3, 0, shares));
}

/// Of what double tells apart most is proven, and of a single ray what is proven of it.
TEST(CommonHit, ProvesMost) {
    Random random(5);
    const JudgedMap map(height_map(
        32, 32, [&](int, int) { return static_cast<float>(random.uniform(0, 1)); }, Wrap::repeat));
    int proven = 0, rays = 0;
    for (int i = 0; i < 200; ++i) {
        const judge::Ray ray{random.uniform(0, 1), random.uniform(0, 1), random.uniform(-1, 1),
                             random.uniform(-1, 1), 0};
        const judge::Field field = map.field(judge::Surface::bilinear);
        const judge::Hit hit = judge::first_hit(field, ray);
        const CommonHit common = judge::common_hit(field, about(ray, 1e-14));
        ++rays;
        proven += common.reason == Uncertified::proven;
        EXPECT_TRUE(common.reason != Uncertified::proven || holds(common, hit));
    }
    EXPECT_GT(proven, rays * 99 / 100);
}

/// Rays that end in two cells, that stay on a border, or that no number is known of.
TEST(CommonHit, LeavesOpenWhatIsOpen) {
    const auto flat = [](int, int) { return 0.5f; };
    const JudgedMap map(height_map(16, 16, flat, Wrap::repeat));
    const judge::Field field = map.field(judge::Surface::bilinear);
    const auto reason = [&](const RayRange& rays) { return judge::common_hit(field, rays).reason; };
    const double border = 1.5 / 16;  // between two cells
    EXPECT_EQ(reason({0.1, 0.1, 0.0, 0.0, 0}), Uncertified::proven);
    EXPECT_EQ(reason({{border - 1e-9, border + 1e-9}, 0.1, 0.0, 0.0, 0}), judge::pixel_open);
    EXPECT_EQ(reason({0.1, 0.1, {-0.5, 0.5}, 0.0, 0}), judge::pixel_open);
    EXPECT_EQ(reason({border - 0.5, 0.1, {1 - 1e-9, 1 + 1e-9}, 0.0, 0}), judge::pixel_open);
    EXPECT_EQ(reason({0.1, 0.1, {-1e30, 1e30}, 0.0, 0}), Uncertified::too_long);
    const double end = std::numeric_limits<double>::infinity();
    EXPECT_EQ(reason({0.1, {-end, end}, 0.0, 0.0, 0}), Uncertified::not_finite);
}

}  // namespace
}  // namespace quadrel::test
