// The judge of searches against rational arithmetic from the first cell to the last, against dense
// marches, and with errors planted: what it certifies is so.
#include "relief/oracle/judged.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {
namespace {

using judge::Hit;
using judge::Surface;

/// A judge: the library's, or one with an error.
using Finder = std::function<Hit(const JudgedMap&, Surface, const judge::Ray&)>;

Hit found(const JudgedMap& map, Surface surface, const judge::Ray& ray) {
    return judge::first_hit(map.field(surface), ray);
}

/// The map without its highest texel, as if a search had missed it.
const JudgedMap& without_spike(const JudgedMap& map) {
    static std::map<const float*, std::unique_ptr<JudgedMap>> made;
    auto& lower = made[map.height.sampled.view.texels];
    if (!lower) {
        const TextureView& view = map.height.sampled.view;
        const float most = *std::max_element(
            view.texels, view.texels + std::ptrdiff_t(view.width[0]) * view.height[0]);
        lower = std::make_unique<JudgedMap>(make_map(
            view.width[0], view.height[0], 1,
            [&](int x, int y, int) {
                const float h = view.texels[y * view.width[0] + x];
                return h == most ? 0 : h;
            },
            map.height.sampled.sampler));
    }
    return *lower;
}

Finder with(Planted planted) {
    return [planted](const JudgedMap& map, Surface surface, const judge::Ray& ray) {
        const bool overlooks = planted == Planted::spike_overlooked;
        Hit hit = found(overlooks ? without_spike(map) : map, surface, ray);
        if (hit.status != Status::hit) return hit;
        if (planted == Planted::cell_beside) hit.cell_x += 1;
        if (planted == Planted::beyond_the_bound)
            hit.s = std::min(1.0, hit.s + 2 * hit.bound + 0x1p-52);
        if (planted == Planted::bound_too_small) hit.bound = 0;
        return hit;
    };
}

/// Of every surface every fourth ray.
testing::AssertionResult on_rays(
    int rays_per_surface,
    const std::function<testing::AssertionResult(const JudgedMap&, Surface, const judge::Ray&)>&
        check) {
    const auto check_surfaces = [&](const JudgedMap& map, const judge::Ray& ray, int lane,
                                    Random&) {
        for (const Surface surface : surfaces) {
            if (static_cast<int>(surface) % 4 != lane % 4) continue;
            const testing::AssertionResult result = check(map, surface, ray);
            if (!result)
                return testing::AssertionFailure()
                       << "surface " << static_cast<int>(surface) << ": " << result.message();
        }
        return testing::AssertionSuccess();
    };
    return on_stress_rays(rays_per_surface * 4, 40, check_surfaces, true);
}

/// A cell of the plane as the judge names it: beyond the end of an axis the outermost one.
double named(long cell, const GridAxis& axis, Surface surface) {
    const long n = axis.count, last = axis.first + n - (surface == Surface::block ? 0 : 1);
    if (!axis.periodic) return static_cast<double>(std::clamp<long>(cell, axis.first, last));
    return static_cast<double>(axis.first + (((cell - axis.first) % n) + n) % n);
}

/// What is certified is what rational arithmetic finds: status, cell, and s within the bound.
testing::AssertionResult certificate_holds(const JudgedMap& map, Surface surface,
                                           const judge::Ray& ray, const Hit& hit) {
    const auto fail = [&](const std::string& what) {
        return testing::AssertionFailure() << what << " at " << hit.s;
    };
    if (hit.certificate == Certificate::none) return fail("not certified");
    const oracle::Field field(map.height.sampled);
    const RationalHit exact = RationalJudge(field, surface, ray).first_hit();
    if (exact.found != (hit.status == Status::hit)) return fail("another status");
    if (!exact.found) return testing::AssertionSuccess();
    if (!(std::fabs(hit.s - exact.s) <= hit.bound)) return fail("beyond the bound");
    const SamplerState& sampler = map.height.sampled.sampler;
    const Grid grid = cell_grid(field.width, field.height, sampler);
    // At the start a ray is in the cell that its point is in.
    const bool same = hit.cell_x == named(exact.i, grid.u, surface) &&
                      hit.cell_y == named(exact.j, grid.v, surface);
    return same || exact.s == 0 ? testing::AssertionSuccess() : fail("another cell");
}

testing::AssertionResult certificates_hold(const Finder& find, int rays_per_surface = 24) {
    return on_rays(rays_per_surface,
                   [&](const JudgedMap& map, Surface surface, const judge::Ray& ray) {
                       return certificate_holds(map, surface, ray, find(map, surface, ray));
                   });
}

TEST(FirstHit, IsWhatRationalsFind) {
    EXPECT_TRUE(certificates_hold(found));
    for (const Planted planted : {Planted::cell_beside, Planted::beyond_the_bound,
                                  Planted::spike_overlooked, Planted::bound_too_small})
        EXPECT_FALSE(certificates_hold(with(planted))) << static_cast<int>(planted);
}

/// Through a row of texel centres, and all but along it: rounding cannot tell on which side such a
/// ray is, from its beginning to its end.
testing::AssertionResult follows_borders(const Finder& find) {
    const auto cliff = [](int x, int) { return x < 17 ? 0.0f : 1.0f; };
    const JudgedMap map(height_map(33, 17, cliff, Wrap::mirrored_repeat));
    for (const Surface surface : surfaces)
        for (const double Ku : {-1.678341811449427e-18, 1e-19, -1e-30, 1e-300, 0.0})
            for (const double Kv : {-0.007077410351485014, 0.3, 0.0}) {
                const judge::Ray ray{0.5, 0.28767773509025574, Ku, Kv, 0};
                const Hit hit = find(map, surface, ray);
                if (hit.steps > 100) return testing::AssertionFailure() << hit.steps << " steps";
                if (auto held = certificate_holds(map, surface, ray, hit); !held)
                    return held << ", Ku " << Ku << ", Kv " << Kv;
            }
    return testing::AssertionSuccess();
}

TEST(FirstHit, ARayThatStaysOnABorderIsFound) {
    EXPECT_TRUE(follows_borders(found));
    EXPECT_FALSE(follows_borders(with(Planted::cell_beside)));
    EXPECT_FALSE(follows_borders([](const JudgedMap&, Surface, const judge::Ray&) {
        return Hit{};  // given up
    }));
}

/// By rationals alone the same, in the same cell; and both ways to a certificate are taken.
TEST(FirstHit, IsTheSameByRationalsAlone) {
    int by_bounds = 0, exactly = 0;
    EXPECT_TRUE(on_rays(12, [&](const JudgedMap& map, Surface surface, const judge::Ray& ray) {
        const Hit hit = found(map, surface, ray);
        const Hit exact = judge::first_hit(map.field(surface), ray, true);
        by_bounds += hit.certificate == Certificate::bounds;
        exactly += hit.certificate == Certificate::exact;
        if (std::fabs(hit.s - exact.s) <= hit.bound + exact.bound && hit.cell_x == exact.cell_x &&
            hit.cell_y == exact.cell_y && hit.status == exact.status)
            return testing::AssertionSuccess();
        return testing::AssertionFailure() << hit.s << " and " << exact.s;
    }));
    EXPECT_GT(by_bounds, 5 * exactly);
    EXPECT_GT(exactly, 3);
}

/// The oracle that judges the searches' tests, in long double.
testing::AssertionResult agrees_with_the_tests_oracle(const Finder& find) {
    return on_rays(48, [&](const JudgedMap& map, Surface surface, const judge::Ray& ray) {
        const oracle::Field field(map.height.sampled);
        const auto meet = [&](oracle::Real lift) {
            const oracle::Ray along = long_ray(ray);
            if (surface == Surface::bilinear) return oracle::meet_bilinear(field, along, lift).s;
            return oracle::meet_triangles(field, along,
                                          surface == Surface::tri_main   ? oracle::Diagonal::main
                                          : surface == Surface::tri_anti ? oracle::Diagonal::anti
                                                                         : oracle::Diagonal::least,
                                          lift)
                .s;
        };
        const Hit hit = find(map, surface, ray);
        if (surface == Surface::block) return is_not_wrong_of_blocks(field, long_ray(ray), hit.s);
        if (hit.s >= meet(0x1p-50L) - hit.bound && hit.s <= meet(-0x1p-50L) + hit.bound)
            return testing::AssertionSuccess();
        return testing::AssertionFailure() << hit.s << " not " << double(meet(0));
    });
}

TEST(FirstHit, IsThatOfTheTestsOracle) {
    EXPECT_TRUE(agrees_with_the_tests_oracle(found));
    EXPECT_FALSE(agrees_with_the_tests_oracle(with(Planted::spike_overlooked)));
}

/// Height of a surface at a point in dual cells, by sampling alone.
oracle::Real sampled(const oracle::Field& field, Surface surface, oracle::Real x, oracle::Real y) {
    const auto i = static_cast<long>(std::floor(x)), j = static_cast<long>(std::floor(y));
    if (surface == Surface::bilinear) return field.bilinear(x, y);
    if (surface == Surface::block)
        return field.texel(static_cast<long>(std::floor(x + 0.5L)),
                           static_cast<long>(std::floor(y + 0.5L)));
    const oracle::Real a = field.texel(i, j), b = field.texel(i + 1, j);
    const oracle::Real c = field.texel(i, j + 1), e = field.texel(i + 1, j + 1);
    const oracle::Real f = x - std::floor(x), g = y - std::floor(y);
    const bool main = surface == Surface::tri_main ||
                      (surface == Surface::tri_min && std::fabs(a - e) <= std::fabs(b - c));
    if (main) return g < f ? a + (b - a) * f + (e - b) * g : a + (e - c) * f + (c - a) * g;
    return f + g < 1 ? a + (b - a) * f + (c - a) * g : e + (c - e) * (1 - f) + (b - e) * (1 - g);
}

/// 1/20000 steps meet nothing before it does.
testing::AssertionResult is_first(const Finder& find) {
    return on_rays(2, [&](const JudgedMap& map, Surface surface, const judge::Ray& ray) {
        const Hit hit = find(map, surface, ray);
        const oracle::Field field(map.height.sampled);
        const oracle::GridRay grid(field, long_ray(ray), 0.5L);
        for (int k = 0; k < 20000 * hit.s - 1e-6; ++k) {
            const oracle::Real s = k / 20000.0L;
            if (sampled(field, surface, grid.x + grid.dx * s, grid.y + grid.dy * s) >=
                1 - s + 1e-15L)
                return testing::AssertionFailure() << "a sample at " << double(s) << " is below";
        }
        return testing::AssertionSuccess();
    });
}

TEST(FirstHit, NoSampleOfADenseMarchIsBelowBeforeIt) {
    EXPECT_TRUE(is_first(found));
    EXPECT_FALSE(is_first(with(Planted::spike_overlooked)));
}

// ---- Special rays -------------------------------------------------------------------------------

Hit along(const JudgedMap& map, const judge::Ray& ray, Surface surface = Surface::bilinear) {
    return found(map, surface, ray);
}

TEST(FirstHit, OfFlatMapsIsTheirDepth) {
    for (const float height : {0.0f, 0.5f, 1.0f}) {
        const JudgedMap map(flat_map(height, 7));
        for (const Surface surface : surfaces)
            for (const double K : {0.0, 0.3, 57.0}) {
                const Hit hit = along(map, {0.3, 0.7, K, -K / 3, 0.25}, surface);
                EXPECT_EQ(hit.status, Status::hit);
                EXPECT_NE(hit.certificate, Certificate::none);
                EXPECT_LE(std::fabs(hit.s - (1 - height)), hit.bound);
                EXPECT_LE(hit.bound, 0x1p-52);
                EXPECT_EQ(hit.condition, hit.s == 0 ? 0 : 1);
            }
    }
}

/// Seen straight down, s is that of the height at uv.
TEST(FirstHit, StraightDownIsTheHeight) {
    const JudgedMap map(height_map(5, 3, [](int x, int y) { return float(x * 3 + y) / 16; }));
    const oracle::Field field(map.height.sampled);
    for (int k = 0; k < 40; ++k) {
        const double u = k / 20.0 - 0.7, v = k / 13.0;
        const auto h = field.bilinear(oracle::Real(u) * 5 - 0.5L, oracle::Real(v) * 3 - 0.5L);
        EXPECT_NEAR(along(map, {u, v, 0, 0, 0}).s, double(1 - h), 1e-15);
    }
}

TEST(FirstHit, OutOfUnitHeightsIsAtTheTopOrNone) {
    const JudgedMap high(flat_map(1.5f, 4)), low(flat_map(-0.5f, 4));
    const Hit top = along(high, {0.1, 0.1, 1, 0, 0}), none = along(low, {0.1, 0.1, 1, 0, 0});
    EXPECT_EQ(top.s, 0);
    EXPECT_EQ(top.height, 1.5);
    EXPECT_EQ(top.certificate, Certificate::bounds);
    EXPECT_EQ(none.status, Status::floor);
    EXPECT_EQ(none.s, 1);
    EXPECT_EQ(none.certificate, Certificate::bounds);
}

TEST(FirstHit, SaysWhyItIsNotProven) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const JudgedMap map(flat_map(0.25f, 4)),
        broken(height_map(4, 4, [](int x, int) { return x == 2 ? NAN : 0.25f; }));
    for (const double bad : {nan, infinity}) {
        const Hit hit = along(map, {0.5, 0.5, bad, 0, 0});
        EXPECT_EQ(hit.reason, Uncertified::not_finite);
        EXPECT_EQ(hit.status, Status::nan);
        EXPECT_EQ(hit.certificate, Certificate::none);
    }
    EXPECT_EQ(along(broken, {0.125, 0.125, 1, 0, 0}).reason, Uncertified::not_a_number);
    EXPECT_EQ(along(broken, {0.125, 0.125, 0.01, 0, 0}).certificate, Certificate::bounds);
    const Hit far = along(map, {0.5, 0.5, 1e12, 0, 0});
    EXPECT_EQ(far.reason, Uncertified::too_long);
    EXPECT_EQ(far.status, Status::cap);
}

/// Coordinates a billion tiles away, rays of thousands of tiles, and some that hardly move.
TEST(FirstHit, OfAbsurdRaysIsProven) {
    Random random(3);
    const JudgedMap map(
        height_map(16, 11, [&](int, int) { return float(random.below(256)) / 255; }));
    for (int k = 0; k < 60; ++k) {
        const double far = k % 2 == 0 ? 1e9 : -1e5, K = k % 3 == 0 ? 1e-20 : 0.3;
        const judge::Ray ray{std::floor(far) + double(random.below(64)) / 32, random.uniform(0, 1),
                             K, k % 5 == 0 ? 0.0 : -K / 7, 0.5};
        for (const Surface surface : surfaces)
            EXPECT_TRUE(certificate_holds(map, surface, ray, found(map, surface, ray))) << k;
    }
    const JudgedMap low(flat_map(0.001f, 16));
    EXPECT_EQ(along(low, {0.1, 0.2, 5000, 300, 0}).certificate, Certificate::bounds);
}

/// A ray that touches a ridge, and one that passes by it closer than double can tell.
TEST(FirstHit, DecidesGrazesExactly) {
    const JudgedMap map(height_map(8, 8, [](int x, int) { return x == 4 ? 0.75f : 0.25f; }));
    const double K = 2.0 / 8;  // falls as steeply as the flank
    const auto touching = [&](double aside) {
        return along(map, {4.5 / 8 - 0.25 * K + aside, 0.5, K, 0, 0});
    };
    EXPECT_NEAR(touching(0).s, 0.25, touching(0).bound);
    EXPECT_NE(touching(0).certificate, Certificate::none);
    EXPECT_GT(touching(0x1p-53).s, 0.26);
    EXPECT_NE(touching(0x1p-53).certificate, Certificate::none);
}

}  // namespace
}  // namespace quadrel::test
