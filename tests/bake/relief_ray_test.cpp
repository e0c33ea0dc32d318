// Rays from any height, straight and bent, against what they promise, and straight ones from the
// top against the judge.
#include "bake/direction/relief_ray.hpp"

#include "bake/support.hpp"
#include "quadrel/relief/trace/oracle/first_hit.hpp"

namespace quadrel::test {
namespace {

using FirstMeeting = std::function<double(const HeightPlane& plane, const ReliefRay& ray)>;

ReliefRay random_ray(std::mt19937& random, double steepest) {
    const auto part = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    ReliefRay ray{};
    ray.x = 30 * part() - 10;
    ray.y = 30 * part() - 10;
    const bool along_axis = random() % 5 == 0, from_corner = random() % 5 == 0;
    ray.dx = steepest * (2 * part() - 1);
    ray.dy = along_axis ? 0 : steepest * (2 * part() - 1);
    if (from_corner) {
        ray.x = std::floor(ray.x);
        ray.y = std::floor(ray.y);
    }
    ray.z = random() % 3 == 0 ? 1 : part();
    return ray;
}

/// The field less the ray at t.
double over_ray(const Texture& field, const SamplerState& sampler, const ReliefRay& ray, double t) {
    return bilinear_at(field, sampler, ray.x + ray.dx * t, ray.y + ray.dy * t) - ray.height(t);
}

/// Where a meeting is told, the field is at or above the ray, or the ray at the bottom, and nowhere
/// before; where none is, the ray is at the top again, and above the field until then.
testing::AssertionResult is_first(const FirstMeeting& meeting, const Texture& field,
                                  const SamplerState& sampler, const ReliefRay& ray) {
    const HeightPlane plane(field, sampler);
    const double t = meeting(plane, ray);
    double end = t;
    if (t >= 0) {
        if (over_ray(field, sampler, ray, t) < -1e-9 && ray.height(t) > 1e-9)
            return testing::AssertionFailure() << "above the field at " << t;
    } else {
        if (!(ray.bend > 0)) return testing::AssertionFailure() << "no meeting";
        end = (1 + std::sqrt(1 + 4 * ray.bend * (1 - ray.z))) / (2 * ray.bend);
    }
    for (int n = 0; n < 64; ++n) {
        const double before = end * n / 64;
        if (over_ray(field, sampler, ray, before) > 1e-9 && before < end - 1e-9)
            return testing::AssertionFailure() << "met at " << before << " before " << end;
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult meets_small_fields(const FirstMeeting& meeting) {
    std::mt19937 random(23);
    for (const Texels& field : small_fields()) {
        for (const SamplerState& sampler : all_samplers()) {
            for (int n = 0; n < 12; ++n) {
                ReliefRay ray = random_ray(random, n % 2 == 0 ? 6 : 40);
                if (n % 3 == 0) ray.bend = static_cast<double>(random() % 100) / 50 - 0.7;
                auto result = is_first(meeting, *field, sampler, ray);
                if (!result) return result << ", " << describe(*field, sampler);
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(ReliefRay, MeetsTheFieldFirst) {
    EXPECT_TRUE(meets_small_fields(first_meeting));
    EXPECT_FALSE(meets_small_fields([](const HeightPlane& plane, const ReliefRay& ray) {
        const double t = first_meeting(plane, ray);
        return t > 0 ? t * 0.95 : t;
    }));
    EXPECT_FALSE(meets_small_fields([](const HeightPlane& plane, const ReliefRay& ray) {
        ReliefRay straight = ray;
        straight.bend = 0;
        return first_meeting(plane, straight);
    }));
    EXPECT_FALSE(meets_small_fields([](const HeightPlane& plane, const ReliefRay& ray) {
        ReliefRay moved = ray;
        moved.x += 0.5;
        return first_meeting(plane, moved);
    }));
}

/// How many of 2000 rays from the top end elsewhere than the judge's: those that graze may.
int rays_unlike_the_judges(const FirstMeeting& meeting) {
    const Texels field = random_field(13, 9, 5);
    const HeightPlane plane(*field, repeat());
    const Texels maxima = bake(*field, BakeKind::max_mip, repeat());
    const SampledTexture heights{field->view(), repeat()}, bounds{maxima->view(), repeat()};
    const oracle::Field judged{&heights, &bounds, oracle::Surface::bilinear};
    std::mt19937 random(29);
    int unlike = 0;
    for (int n = 0; n < 2000; ++n) {
        ReliefRay ray = random_ray(random, n % 2 == 0 ? 6 : 40);
        ray.z = 1;
        const oracle::Hit hit = oracle::first_hit(
            judged, {(ray.x + 0.5) / 13, (ray.y + 0.5) / 9, ray.dx / 13, ray.dy / 9, 0});
        unlike += std::abs(meeting(plane, ray) - hit.s) > 1e-7;
    }
    return unlike;
}

TEST(ReliefRay, MeetsWhereTheJudgeDoes) {
    EXPECT_LE(rays_unlike_the_judges(first_meeting), 4);
    EXPECT_GT(rays_unlike_the_judges([](const HeightPlane& plane, const ReliefRay& ray) {
                  return first_meeting(plane, ray) + 1e-5;
              }),
              1000);
}

}  // namespace
}  // namespace quadrel::test
