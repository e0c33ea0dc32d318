#include "quadrel/relief/trace/oracle/sky.hpp"

#include <bit>
#include <cmath>

#include "quadrel/num/math.hpp"

namespace quadrel::oracle {
namespace {

/// Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014 (SplitMix64).
class Generator {
  public:
    explicit Generator(std::uint64_t state) : state_(state) {}

    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  private:
    std::uint64_t state_;
};

/// The same for a point given in float and in double.
std::uint64_t seed_of(const SkyPoint& point, int seed) {
    const auto bits = [](double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); };
    Generator mix((std::uint64_t(bits(point.u)) << 32) | bits(point.v));
    return mix.next() ^ Generator(static_cast<std::uint64_t>(seed)).next();
}

/// Two unit vectors that stand on n and on each other. Duff et al., "Building an Orthonormal Basis,
/// Revisited", JCGT 6(1), 2017.
struct Basis {
    vec3<double> x, y;

    explicit Basis(const vec3<double>& n) {
        const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
        x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        y = {b, sign + n.y * n.y * a, -n.y};
    }
};

double along(const vec3<double>& a, const vec3<double>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

}  // namespace

Sky open_sky(const Field& field, const SkyPoint& point, int samples, int seed) {
    const Basis basis(point.normal);
    Generator random(seed_of(point, seed));
    constexpr double turn = 6.283185307179586;
    int open = 0;
    std::int32_t steps = 0;
    for (int k = 0; k < samples; ++k) {
        const double u = random.uniform(), angle = turn * random.uniform();
        const double radius = std::sqrt(u), rise = std::sqrt(1 - u);
        const double x = radius * quadrel::cos(angle), y = radius * quadrel::sin(angle);
        const vec3<double> L = basis.x * x + basis.y * y + point.normal * rise;
        const RayUp ray{point.u, point.v, along(point.Du, L) / rise, along(point.Dv, L) / rise,
                        point.z};
        open += !is_occluded(field, ray, steps);
    }
    const double share = static_cast<double>(open) / samples;
    return {share, std::sqrt(share * (1 - share) / (samples - 1))};
}

}  // namespace quadrel::oracle
