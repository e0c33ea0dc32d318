// Dual numbers: every function of num/ against central differences of three steps, the bits of
// doubles in the values, and derivatives that turn with the axes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "num/dual_support.hpp"
#include "quadrel/num/derivative.hpp"
#include "quadrel/num/srgb.hpp"
#include "random.hpp"

namespace quadrel::num_tests {
namespace {

using test::Random;
constexpr double endless = std::numeric_limits<double>::infinity();

std::vector<DualCase> arithmetic_cases() {
    return {
        dual_case("+", [](const auto& x) { return x[0] + x[1] + 0.5; }),
        dual_case("-", [](const auto& x) { return -x[0] - x[1] - 0.5f; }),
        dual_case("*", [](const auto& x) { return x[0] * x[1] * 3.0; }),
        dual_case(
            "/", [](const auto& x) { return x[0] / x[1]; }, 0.5, 4),
        dual_case(
            "sqrt", [](const auto& x) { return sqrt(x[0]); }, 0.1, 4),
        dual_case(
            "inversesqrt", [](const auto& x) { return inversesqrt(x[0]); }, 0.1, 4),
        dual_case("abs", [](const auto& x) { return abs(x[0]) * x[1]; }),
        dual_case("copysign", [](const auto& x) { return copysign(x[0], x[1]); }),
        dual_case("min", [](const auto& x) { return min(x[0], x[1] * x[1]); }),
        dual_case("max", [](const auto& x) { return max(x[0], 0.25f) * x[2]; }),
        dual_case("clamp", [](const auto& x) { return clamp(x[0] * x[1], -2.0, x[2]); }),
        dual_case("saturate", [](const auto& x) { return saturate(x[0] * x[0] - x[1]); }),
        dual_case("floor", [](const auto& x) { return x[0] * floor(x[1]); }),
        dual_case("ceil", [](const auto& x) { return x[0] * ceil(x[1]); }),
        dual_case("trunc", [](const auto& x) { return x[0] * trunc(x[1]); }),
        dual_case("round_even", [](const auto& x) { return x[0] * round_even(x[1]); }),
        dual_case("fract", [](const auto& x) { return fract(x[0]); }),
        dual_case(
            "mod", [](const auto& x) { return mod(x[0], x[1]); }, 0.5, 4),
        dual_case("sign", [](const auto& x) { return sign(x[0]) * x[1]; }),
        dual_case("step", [](const auto& x) { return step(x[0], x[1]) * x[2]; }),
        dual_case("mix", [](const auto& x) { return mix(x[0], x[1], x[2]); }),
        dual_case("lerp", [](const auto& x) { return lerp(x[0], x[1], x[2]); }),
        dual_case("smoothstep", [](const auto& x) { return smoothstep(-3.0, x[1] + 6, x[0]); }),
        dual_case("select", [](const auto& x) { return select(x[0] < x[1], x[0] * x[2], x[1]); }),
        dual_case(
            "exponent", [](const auto& x) { return exponent(x[0]) * x[1]; }, 0.1, 4),
        dual_case("significand", [](const auto& x) { return significand(x[0]); }),
        dual_case("dFdx", [](const auto& x) { return dFdx(x[0] * x[1]); }),
        dual_case("dFdy", [](const auto& x) { return dFdy(x[0], DerivativeMode::coarse) * x[1]; }),
    };
}

std::vector<DualCase> transcendental_cases() {
    return {
        dual_case("exp2", [](const auto& x) { return exp2(x[0] * x[1]); }),
        dual_case("exp", [](const auto& x) { return exp(x[0]) * x[1]; }),
        dual_case(
            "log2", [](const auto& x) { return log2(x[0]); }, 0.2, 4),
        dual_case(
            "log", [](const auto& x) { return log(x[0]); }, 0.2, 4),
        dual_case(
            "pow", [](const auto& x) { return pow(x[0], x[1]); }, 0.2, 3),
        dual_case("pow of a constant", [](const auto& x) { return pow(2.5f, x[1]); }),
        dual_case("sin", [](const auto& x) { return sin(x[0] * x[1]); }),
        dual_case("cos", [](const auto& x) { return cos(x[0] * x[1]); }),
        dual_case(
            "tan", [](const auto& x) { return tan(x[0]); }, -1.4, 1.4),
        dual_case("atan2", [](const auto& x) { return atan2(x[0], x[1]); }),
        dual_case("atan", [](const auto& x) { return atan(x[0]); }),
        dual_case(
            "asin", [](const auto& x) { return asin(x[0]); }, -0.9, 0.9),
        dual_case(
            "acos", [](const auto& x) { return acos(x[0]); }, -0.9, 0.9),
        dual_case("radians", [](const auto& x) { return radians(x[0]) + degrees(x[1]); }),
        dual_case(
            "srgb_decode", [](const auto& x) { return srgb_decode(x[0]); }, 0, 1),
        dual_case(
            "srgb_encode", [](const auto& x) { return srgb_encode(x[0]); }, 0, 1),
    };
}

/// A vector of the three numbers, and another.
template <class F>
vec3<F> first(const std::array<F, 3>& x) {
    return {x[0], x[1], x[2]};
}
template <class F>
vec3<F> second(const std::array<F, 3>& x) {
    return {x[1] * x[1], 1.5 + x[0], x[2] - x[1]};
}

std::vector<DualCase> vector_cases() {
    return {
        dual_case("dot", [](const auto& x) { return dot(first(x), second(x)); }),
        dual_case("cross", [](const auto& x) { return cross(first(x), second(x)).y; }),
        dual_case("length", [](const auto& x) { return length(first(x)); }),
        dual_case("distance", [](const auto& x) { return distance(first(x), second(x)); }),
        dual_case("normalize", [](const auto& x) { return normalize(first(x)).z; }),
        dual_case("reflect", [](const auto& x) { return reflect(first(x), second(x)).x; }),
        dual_case(
            "refract",
            [](const auto& x) { return refract(normalize(first(x)), normalize(second(x)), 0.7).y; },
            0.1, 1),
        dual_case("faceforward",
                  [](const auto& x) { return faceforward(first(x), second(x), first(x) * 2.0).x; }),
        dual_case("inverse",
                  [](const auto& x) {
                      using F = std::decay_t<decltype(x[0])>;
                      return inverse(
                          mat3<F>(first(x), second(x), cross(first(x), second(x))))[0][1];
                  }),
        dual_case("determinant",
                  [](const auto& x) {
                      using F = std::decay_t<decltype(x[0])>;
                      return determinant(mat2<F>(x[0], x[1], x[2], x[0])) *
                             transpose(mat2<F>(x[0], x[1], x[2], x[0]))[0][1];
                  }),
    };
}

std::vector<DualCase> all_cases() {
    std::vector<DualCase> all = arithmetic_cases();
    for (const auto& more : {transcendental_cases(), vector_cases()})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

/// Arguments that vary by a rate of their own along each axis.
std::array<Quad<Dual>, 3> random_arguments(const DualCase& of, Random& random) {
    std::array<Quad<Dual>, 3> x;
    for (Quad<Dual>& argument : x)
        for (Dual& lane : argument.lane)
            lane = {random.uniform(of.low, of.high), random.uniform(-1, 1), random.uniform(-1, 1)};
    return x;
}

/// The same a step along one axis, in double.
std::array<Quad<double>, 3> moved(const std::array<Quad<Dual>, 3>& x, int axis, double t) {
    std::array<Quad<double>, 3> out;
    for (std::size_t i = 0; i < 3; ++i)
        for (int lane = 0; lane < 4; ++lane) {
            const Dual& from = x[i].lane[lane];
            out[i].lane[lane] = from.value + t * (axis == 0 ? from.dx : from.dy);
        }
    return out;
}

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

/// Values of doubles, bit for bit, and derivatives that central differences come near to as the
/// step's square; but for one lane in 30, which a corner of the function may be near.
testing::AssertionResult is_differentiated(const DualCase& of) {
    constexpr double step = 0x1p-8;
    Random random(7);
    int lanes = 0, off = 0;
    for (int round = 0; round < 24; ++round) {
        const auto x = random_arguments(of, random);
        const Quad<Dual> found = of.dual(x);
        const Quad<double> value = of.plain(moved(x, 0, 0));
        for (int lane = 0; lane < 4; ++lane) {
            if (!same(found.lane[lane].value, value.lane[lane]))
                return testing::AssertionFailure() << "another value";
            const double noise = 0x1p-51 * (1 + std::abs(value.lane[lane]));
            for (int axis = 0; axis < 2; ++axis) {
                const auto f = [&](double t) { return of.plain(moved(x, axis, t)).lane[lane]; };
                const Dual& d = found.lane[lane];
                off += !step_errors(f, axis == 0 ? d.dx : d.dy, step, noise).fall();
                ++lanes;
            }
        }
    }
    if (30 * off <= lanes) return testing::AssertionSuccess();
    return testing::AssertionFailure() << off << " of " << lanes << " derivatives are off";
}

TEST(Dual, EveryFunctionHasItsDerivative) {
    for (const DualCase& of : all_cases()) EXPECT_TRUE(is_differentiated(of)) << of.name;
}

/// A function of lanes in the place of a case's dual text.
template <class Lane>
DualCase with(DualCase of, const Lane& lane) {
    of.dual = [lane](const std::array<Quad<Dual>, 3>& x) {
        return map_lanes<Quad<Dual>>(lane, x[0], x[1]);
    };
    return of;
}

TEST(Dual, WrongDerivativesAreCaught) {
    const auto of = [](const std::string& name) {
        for (const DualCase& row : all_cases())
            if (row.name == name) return row;
        throw std::invalid_argument(name);
    };
    const auto chain = [](auto... x) { return detail::chain(x...); };
    const std::vector<DualCase> planted{
        with(of("sqrt"), [&](Dual x, Dual) { return chain(x, sqrt(x.value), 1 / sqrt(x.value)); }),
        with(of("log2"), [&](Dual x, Dual) { return chain(x, log2(x.value), 1 / x.value); }),
        with(of("pow"),
             [&](Dual x, Dual y) {
                 return chain(x, pow(x.value, y.value), y.value * pow(x.value, y.value - 1));
             }),
        with(of("atan2"),
             [&](Dual y, Dual x) {
                 const double square = x.value * x.value + y.value * y.value;
                 return chain(y, x, atan2(y.value, x.value), -y.value / square, x.value / square);
             }),
        with(of("/"),
             [&](Dual a, Dual b) {
                 const double q = a.value / b.value;
                 return Dual(q, (a.dx + q * b.dx) / b.value, (a.dy + q * b.dy) / b.value);
             }),
        with(of("fract"), [](Dual x, Dual) { return Dual(fract(x.value)); }),
        with(of("atan"),
             [](Dual x, Dual) {
                 const Dual right = atan(x);
                 return Dual(right.value, right.dy, right.dx);
             }),
    };
    for (const DualCase& row : planted) EXPECT_FALSE(is_differentiated(row)) << row.name;
    EXPECT_FALSE(is_differentiated(with(of("exp2"), [](Dual x, Dual y) {
        return exp2(x * y) * (1 + 0x1p-52);
    }))) << "a value off by an ulp";
}

/// Arguments whose axes are turned give derivatives that are turned.
TEST(Dual, DerivativesTurnWithTheAxes) {
    constexpr double c = 0.6, s = 0.8;
    const auto turned = [](const Dual& d) {
        return Dual(d.value, c * d.dx + s * d.dy, c * d.dy - s * d.dx);
    };
    Random random(9);
    for (const DualCase& of : all_cases()) {
        const auto x = random_arguments(of, random);
        auto other = x;
        for (Quad<Dual>& argument : other) argument = map_lanes<Quad<Dual>>(turned, argument);
        const Quad<Dual> expected = map_lanes<Quad<Dual>>(turned, of.dual(x)),
                         found = of.dual(other);
        for (int lane = 0; lane < 4; ++lane) {
            const Dual &a = found.lane[lane], &b = expected.lane[lane];
            const double tolerance = 1e-12 * (1 + std::abs(b.dx) + std::abs(b.dy));
            EXPECT_TRUE(same(a.value, b.value)) << of.name;
            EXPECT_NEAR(a.dx, b.dx, tolerance) << of.name;
            EXPECT_NEAR(a.dy, b.dy, tolerance) << of.name;
        }
    }
}

/// What does not vary has derivative 0, whatever the function is there.
TEST(Dual, ConstantsHaveNoDerivative) {
    for (const double x : {0.0, -0.0, 1.0, -1.0, endless, -endless, std::nan(""), 1e300})
        for (const DualCase& of : all_cases()) {
            const Quad<Dual> found = of.dual({Quad<Dual>(x), Quad<Dual>(0.0), Quad<Dual>(x)});
            for (const Dual& lane : found.lane) {
                EXPECT_EQ(lane.dx, 0) << of.name << " of " << x;
                EXPECT_EQ(lane.dy, 0) << of.name << " of " << x;
            }
        }
}

TEST(Dual, LimitsAtTheEdgesOfDomains) {
    const auto slope = [](const auto& f, double x) {
        return exact_dx(f(with_derivatives(Quad<Dual>(x), 1, 0))).lane[0];
    };
    const auto sqrt_of = [](const Quad<Dual>& x) { return sqrt(x); };
    const auto power = [](double y) {
        return [y](const Quad<Dual>& x) { return pow(x, Quad<Dual>(y)); };
    };
    EXPECT_EQ(slope(sqrt_of, 0), endless);
    EXPECT_EQ(slope(power(2), 0), 0);
    EXPECT_EQ(slope(power(1), 0), 1);
    EXPECT_EQ(slope(power(0), 0), 0);
    EXPECT_EQ(slope(power(0.5), 0), endless);
    EXPECT_EQ(slope([](const Quad<Dual>& y) { return pow(Quad<Dual>(0.0), y); }, 2), 0);
    EXPECT_EQ(slope([](const Quad<Dual>& x) { return sin(x); }, 1e300), 0);  // counts as sin(0)
    const auto steep = [](const Quad<Dual>& x) { return atan2(x, Quad<Dual>(0x1p-1000)); };
    EXPECT_EQ(slope(steep, 0), 0x1p1000);
    EXPECT_EQ(slope([](const Quad<Dual>& x) { return abs(x); }, -0.0), 1);
}

/// dFdx is the difference of the lanes' values; its derivative that of their derivatives.
TEST(Dual, FiniteDifferencesAreOfValuesAndOfDerivatives) {
    Quad<Dual> x;
    for (int lane = 0; lane < 4; ++lane)
        x.lane[lane] = {1.0 * lane * lane, 10.0 * lane, -1.0 * lane};
    EXPECT_EQ(values_of(dFdx(x)).lane[3], 5);
    EXPECT_EQ(exact_dx(dFdx(x)).lane[3], 10);
    EXPECT_EQ(exact_dy(dFdy(x)).lane[0], -2);
}

}  // namespace
}  // namespace quadrel::num_tests
