// Whether a ray comes out of the relief again, against dense samples of it.
#include "quadrel/relief/trace/oracle/emerges.hpp"
#include "relief/oracle/judged.hpp"
#include "relief/planted.hpp"
#include "relief/stress_maps.hpp"

namespace quadrel::test {
namespace {

using judge::Surface;

using Emerges = std::function<bool(const judge::Field&, const judge::Ray&, double, double)>;

/// The field less the ray's height.
double field_above_ray(const oracle::Field& field, Surface surface, const judge::Ray& ray,
                       double s) {
    const double u = ray.u + (s - ray.s_polygon) * ray.Ku, v = ray.v + (s - ray.s_polygon) * ray.Kv,
                 half = surface == Surface::block ? 0 : 0.5;
    const double x = u * field.width - half, y = v * field.height - half;
    const long i = static_cast<long>(std::floor(x)), j = static_cast<long>(std::floor(y));
    const double f = x - double(i), g = y - double(j);
    const auto h = [&](long a, long b) { return double(field.texel(i + a, j + b)); };
    if (surface == Surface::block) return h(0, 0) - (1 - s);
    if (surface == Surface::tri_main)
        return (f > g ? h(0, 0) + f * (h(1, 0) - h(0, 0)) + g * (h(1, 1) - h(1, 0))
                      : h(0, 0) + f * (h(1, 1) - h(0, 1)) + g * (h(0, 1) - h(0, 0))) -
               (1 - s);
    return (h(0, 0) * (1 - f) + h(1, 0) * f) * (1 - g) + (h(0, 1) * (1 - f) + h(1, 1) * f) * g -
           (1 - s);
}

/// The least of it in [from, to], nearly.
double least_above(const oracle::Field& field, Surface surface, const judge::Ray& ray, double from,
                   double to) {
    constexpr int samples = 600;
    double least = 2;
    for (int k = 0; k <= samples; ++k)
        least =
            std::min(least, field_above_ray(field, surface, ray, from + (to - from) * k / samples));
    return least;
}

/// What samples show is told, and nothing else but what lies between them.
testing::AssertionResult tells_what_samples_show(const Emerges& emerges) {
    int out = 0, in = 0, between = 0;
    const auto check = [&](const JudgedMap& map, const judge::Ray& ray, int lane, Random& random) {
        const Surface surface =
            std::array{Surface::bilinear, Surface::block, Surface::tri_main}[std::size_t(lane % 3)];
        const judge::Hit hit = judge::first_hit(map.field(surface), ray);
        if (hit.status != Status::hit) return testing::AssertionSuccess();
        const double from = hit.s + 1e-5, to = from + random.uniform(0, 0.5);
        const oracle::Field field(map.height.sampled);
        const double least = least_above(field, surface, ray, from, std::min(to, 1.0));
        const bool told = emerges(map.field(surface), ray, from, to);
        (told ? out : in) += 1;
        if (least < -1e-5 && !told) return testing::AssertionFailure() << "not told, " << least;
        between += told && least > 0;
        return testing::AssertionSuccess();
    };
    const testing::AssertionResult all = on_stress_rays(96, 7, check);
    if (!all) return all;
    if (out < 30 || in < 30) return testing::AssertionFailure() << out << " out, " << in << " in";
    if (10 * between > out) return testing::AssertionFailure() << between << " of " << out;
    return testing::AssertionSuccess();
}

TEST(Emerges, TellsWhatSamplesShow) {
    EXPECT_TRUE(tells_what_samples_show(judge::emerges));
    const auto planted = [](const auto& change) {
        return Emerges([=](const judge::Field& field, judge::Ray ray, double from, double to) {
            change(ray, from, to);
            return judge::emerges(field, ray, from, to);
        });
    };
    // Seen from elsewhere, along another way, over the first half alone, or never.
    EXPECT_FALSE(
        tells_what_samples_show(planted([](judge::Ray& ray, double&, double&) { ray.u += 0.11; })));
    EXPECT_FALSE(tells_what_samples_show(
        planted([](judge::Ray& ray, double&, double&) { ray.Kv = -ray.Kv; })));
    EXPECT_FALSE(tells_what_samples_show(
        planted([](judge::Ray&, double& from, double& to) { to = (from + to) / 2; })));
    EXPECT_FALSE(tells_what_samples_show(
        [](const judge::Field&, const judge::Ray&, double, double) { return false; }));
}

TEST(Emerges, EndsWhateverTheRay) {
    const JudgedMap map(make_map(8, 8, 1, [](int x, int, int) { return x % 2 ? 1.0f : 0.0f; }, {}));
    constexpr double huge = 1e300, never = std::numeric_limits<double>::infinity();
    for (const judge::Ray& ray :
         {judge::Ray{0.1, 0.1, huge, 1, 0}, judge::Ray{1e12, 0, 1e9, -1e9, 0},
          judge::Ray{never, 0, 1, 1, 0}, judge::Ray{0, 0, 0, 0, 0.5}})
        for (const Surface surface : surfaces)
            EXPECT_NO_THROW(judge::emerges(map.field(surface), ray, -1, 2));
}

}  // namespace
}  // namespace quadrel::test
