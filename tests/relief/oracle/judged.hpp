// The library's judge under test, and a judge of the judge: rational arithmetic from the first cell
// to the last, for every surface, that shares nothing with it.
#pragma once

#include "quadrel/relief/cells.hpp"
#include "quadrel/relief/trace/oracle/common_hit.hpp"
#include "relief/exact/exact_search.hpp"
#include "relief/exact/oracle_exact.hpp"
#include "relief/stress_maps.hpp"

namespace quadrel::test {

namespace judge = quadrel::oracle;

inline constexpr std::array surfaces{judge::Surface::bilinear, judge::Surface::block,
                                     judge::Surface::tri_main, judge::Surface::tri_anti,
                                     judge::Surface::tri_min};

/// A map, its maxima, and rays over it.
struct JudgedMap {
    Map height, maxima;

    explicit JudgedMap(Map map) : height(std::move(map)) {
        maxima.texture =
            bake(*height.texture, bake_kind_from_name("max-mip"), height.sampled.sampler);
        maxima.sampled = {maxima.texture->view(), height.sampled.sampler};
    }
    judge::Field field(judge::Surface surface) const {
        return {&height.sampled, &maxima.sampled, surface};
    }
};

/// The ray of a lane, as the stages take it.
template <PlainFloat T>
judge::Ray judged_ray(Batch<T>& batch, int lane) {
    const oracle::Ray ray = oracle_ray(batch, lane);
    return {double(ray.u), double(ray.v), double(ray.Ku), double(ray.Kv), double(ray.s_polygon)};
}
inline oracle::Ray long_ray(const judge::Ray& ray) {
    return {ray.u, ray.v, ray.Ku, ray.Kv, ray.s_polygon};
}

/// check(map, ray, lane, random) of rays over every kind of map, every wrap mode and any size,
/// those along borders and through corners among them. The polygon is at the top, or `anywhere`.
template <class Check>
testing::AssertionResult on_stress_rays(int rays_per_map, std::uint64_t seed, const Check& check,
                                        bool anywhere = false) {
    for (const StressMap& kind : stress_maps()) {
        Random random(static_cast<std::uint64_t>(kind.name[0]) + seed);
        const JudgedMap map(random_stress_map(random, kind, 24));
        Batch<float> rays(rays_per_map);
        fill_stress_rays(rays, map.height, random);
        if (anywhere && !random.chance(0.5))
            rays.material.seat = static_cast<float>(random.uniform(0, 1));
        for (int lane = 0; lane < rays.lanes; ++lane) {
            const testing::AssertionResult result =
                check(map, judged_ray(rays, lane), lane, random);
            if (!result)
                return testing::AssertionFailure()
                       << kind.name << ", ray " << lane << ": " << result.message();
        }
    }
    return testing::AssertionSuccess();
}

/// All numbers of the ray, each up to `apart` of its size off, or of 1.
inline judge::RayRange about(const judge::Ray& ray, double apart) {
    const auto around = [apart](double x) {
        const double off = apart * std::max(1.0, std::fabs(x));
        return RealInterval(x - off, x + off);
    };
    return {around(ray.u), around(ray.v), around(ray.Ku), around(ray.Kv), ray.s_polygon};
}

/// One of the range, its corners as likely as all the rest.
inline judge::Ray one_of(const judge::RayRange& rays, Random& random) {
    const auto in = [&](const RealInterval& x) {
        if (random.chance(0.5)) return random.chance(0.5) ? x.lo : x.hi;
        return std::clamp(random.uniform(x.lo, x.hi), x.lo, x.hi);
    };
    return {in(rays.u), in(rays.v), in(rays.Ku), in(rays.Kv), rays.s_polygon};
}

/// A hit in rationals: s within [lo, hi], the cell in the plane, before it is wrapped.
struct RationalHit {
    oracle::Real s = 1;
    bool found = false;
    long i = 0, j = 0;
};

/// Every cell on the way, one after the other.
class RationalJudge {
  public:
    RationalJudge(const oracle::Field& field, judge::Surface surface, const judge::Ray& ray)
        : field_(field), surface_(surface), ray_(field, long_ray(ray)) {}

    RationalHit first_hit() const {
        for (mpq_class s = 0; s < 1;) {
            const bool blocks = surface_ == judge::Surface::block;
            if (blocks && touches(s)) return hit(s, s);
            mpq_class to = oracle::ExactRay::next_border(x(0), ray_.dx, s);
            to = std::min(to, oracle::ExactRay::next_border(y(0), ray_.dy, s));
            to = std::min(to, mpq_class(1));
            to = std::min(to, next_diagonal(s, to));
            const mpq_class middle = (s + to) / 2;
            const oracle::ExactQuadratic q = quadratic(s, middle);
            if (q.reaches_zero(to - s)) return hit(s + root(q, to - s), middle);
            s = to;
        }
        return {};
    }

  private:
    /// Positions in texels of blocks, or dual cells.
    mpq_class x(const mpq_class& s) const { return ray_.x + ray_.dx * s + half(); }
    mpq_class y(const mpq_class& s) const { return ray_.y + ray_.dy * s + half(); }
    mpq_class half() const {
        return surface_ == judge::Surface::block ? mpq_class(1, 2) : mpq_class(0);
    }
    bool triangles() const {
        return surface_ != judge::Surface::bilinear && surface_ != judge::Surface::block;
    }

    bool touches(const mpq_class& s) const {
        const long i = oracle::floor_of(x(s)), j = oracle::floor_of(y(s));
        return oracle::rational(field_.texel(i, j)) >= 1 - s;
    }
    RationalHit hit(const mpq_class& s, const mpq_class& within) const {
        return {s.get_d(), true, oracle::floor_of(x(within)), oracle::floor_of(y(within))};
    }
    bool main_edge(long i, long j) const {
        if (surface_ != judge::Surface::tri_min) return surface_ == judge::Surface::tri_main;
        const auto at = [&](long a, long b) { return double(field_.texel(i + a, j + b)); };
        return std::fabs(at(0, 0) - at(1, 1)) <= std::fabs(at(1, 0) - at(0, 1));
    }
    /// Where the ray next crosses the edge inside its cell, if before `end`.
    mpq_class next_diagonal(const mpq_class& s, const mpq_class& end) const {
        if (!triangles()) return end;
        const mpq_class middle = (s + end) / 2;
        const long i = oracle::floor_of(x(middle)), j = oracle::floor_of(y(middle));
        const bool main = main_edge(i, j);
        const mpq_class f = x(0) - i, g = y(0) - j;
        const mpq_class rate = main ? mpq_class(ray_.dx - ray_.dy) : mpq_class(ray_.dx + ray_.dy);
        if (rate == 0) return end;
        const mpq_class at = (main ? mpq_class(g - f) : mpq_class(1 - f - g)) / rate;
        return at > s && at < end ? at : end;
    }
    /// About s, of the piece at `within`.
    oracle::ExactQuadratic quadratic(const mpq_class& s, const mpq_class& within) const {
        const long i = oracle::floor_of(x(within)), j = oracle::floor_of(y(within));
        const mpq_class f = x(s) - i, g = y(s) - j;
        const auto h = [&](long a, long b) { return oracle::rational(field_.texel(i + a, j + b)); };
        if (surface_ == judge::Surface::block) return {0, 1, h(0, 0) - (1 - s)};
        mpq_class h00 = h(0, 0), h10 = h(1, 0), h01 = h(0, 1), h11 = h(1, 1);
        if (triangles()) {
            const mpq_class fm = x(within) - i, gm = y(within) - j;
            if (main_edge(i, j)) {
                if (gm <= fm)
                    h01 = h00 + h11 - h10;
                else
                    h10 = h00 + h11 - h01;
            } else {
                if (fm + gm <= 1)
                    h11 = h10 + h01 - h00;
                else
                    h00 = h10 + h01 - h11;
            }
        }
        const mpq_class b = h10 - h00, c = h01 - h00, d = h00 - h10 - h01 + h11;
        return {d * ray_.dx * ray_.dy,
                b * ray_.dx + c * ray_.dy + d * (f * ray_.dy + g * ray_.dx) + 1,
                h00 + b * f + c * g + d * f * g - (1 - s)};
    }
    /// The first root in [0, length], which has one, to 2^-80 of the length.
    static mpq_class root(const oracle::ExactQuadratic& q, const mpq_class& length) {
        if (q.C >= 0) return 0;
        const auto at = [&](const mpq_class& tau) {
            return mpq_class((q.A * tau + q.B) * tau + q.C);
        };
        mpq_class low = 0, high = length;
        if (at(high) < 0) high = -q.B / (2 * q.A);
        for (int k = 0; k < 80; ++k) {
            const mpq_class middle = (low + high) / 2;
            (at(middle) < 0 ? low : high) = middle;
        }
        return high;
    }

    const oracle::Field& field_;
    judge::Surface surface_;
    oracle::ExactRay ray_;
};

}  // namespace quadrel::test
