// Signed zeros, denormals, infinities and NaN: the written rules of math.hpp's functions, on float
// and on double, as properties of the function under test.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "num/inputs.hpp"
#include "num/planted.hpp"
#include "quadrel/num/math.hpp"

namespace quadrel::num_tests {
namespace {

template <class T>
constexpr T infinity = std::numeric_limits<T>::infinity();
template <class T>
constexpr T nan = std::numeric_limits<T>::quiet_NaN();

template <class T>
using Function = T (*)(T);
template <class T>
using Function2 = T (*)(T, T);

/// The same value and sign, or both NaN.
template <class T>
bool same(T a, T b) {
    return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

template <class T>
struct Case {
    T x;
    T expected;
};
template <class T>
testing::AssertionResult gives(Function<T> f, std::initializer_list<Case<T>> cases) {
    for (const auto [x, expected] : cases) {
        if (!same(f(x), expected)) {
            return testing::AssertionFailure() << x << " gives " << f(x) << ", not " << expected;
        }
    }
    return testing::AssertionSuccess();
}
template <class T>
struct Case2 {
    T x;
    T y;
    T expected;
};
template <class T>
testing::AssertionResult gives2(Function2<T> f, std::initializer_list<Case2<T>> cases) {
    for (const auto [x, y, expected] : cases) {
        if (!same(f(x, y), expected)) {
            return testing::AssertionFailure()
                   << "(" << x << ", " << y << ") gives " << f(x, y) << ", not " << expected;
        }
    }
    return testing::AssertionSuccess();
}

template <class T>
testing::AssertionResult exponential_rules(Function<T> exponential) {
    return gives<T>(exponential, {{T(0), T(1)},
                                  {T(-0.0), T(1)},
                                  {infinity<T>, infinity<T>},
                                  {-infinity<T>, T(0)},
                                  {std::numeric_limits<T>::max(), infinity<T>},
                                  {std::numeric_limits<T>::lowest(), T(0)},
                                  {std::numeric_limits<T>::denorm_min(), T(1)},
                                  {nan<T>, nan<T>}});
}
/// 2^n exactly for every integer n, denormal results included.
template <class T>
testing::AssertionResult exact_on_integers(Function<T> f) {
    using Limits = std::numeric_limits<T>;
    for (int n = Limits::min_exponent - Limits::digits; n < Limits::max_exponent; ++n) {
        if (f(static_cast<T>(n)) != std::ldexp(T(1), n)) {
            return testing::AssertionFailure() << "2^" << n << " is not exact";
        }
    }
    return f(T(Limits::max_exponent)) == infinity<T> ? testing::AssertionSuccess()
                                                     : testing::AssertionFailure() << "overflow";
}
template <class T>
testing::AssertionResult logarithm_rules(Function<T> logarithm) {
    return gives<T>(logarithm, {{T(1), T(0)},
                                {T(0), -infinity<T>},
                                {T(-0.0), -infinity<T>},
                                {T(-1), nan<T>},
                                {-std::numeric_limits<T>::denorm_min(), nan<T>},
                                {-infinity<T>, nan<T>},
                                {infinity<T>, infinity<T>},
                                {nan<T>, nan<T>}});
}
template <class T>
testing::AssertionResult inverts_powers_of_two(Function<T> log2_under_test) {
    using Limits = std::numeric_limits<T>;
    for (int n = Limits::min_exponent - Limits::digits; n < Limits::max_exponent; ++n) {
        if (log2_under_test(std::ldexp(T(1), n)) != static_cast<T>(n)) {
            return testing::AssertionFailure() << "log2 of 2^" << n;
        }
    }
    return testing::AssertionSuccess();
}
template <class T>
testing::AssertionResult power_rules(Function2<T> power) {
    const T inf = infinity<T>;
    return gives2<T>(power, {{T(0), T(0), T(1)},    {T(-0.0), T(0), T(1)},  {nan<T>, T(0), T(1)},
                             {inf, T(0), T(1)},     {T(-2), T(-0.0), T(1)}, {T(1), nan<T>, T(1)},
                             {T(1), inf, T(1)},     {T(2), nan<T>, nan<T>}, {nan<T>, T(2), nan<T>},
                             {T(-2), T(2), nan<T>}, {-inf, T(1), nan<T>},   {T(0), T(3), T(0)},
                             {T(-0.0), T(3), T(0)}, {T(0), T(-3), inf},     {inf, T(0.5), inf},
                             {inf, T(-0.5), T(0)},  {T(2), inf, inf},       {T(2), -inf, T(0)},
                             {T(0.5), inf, T(0)},   {T(0.5), -inf, inf},    {T(0), inf, T(0)},
                             {T(0), -inf, inf},     {T(2), T(10), T(1024)}, {T(4), T(0.5), T(2)},
                             {T(2), T(1e30), inf},  {T(2), T(-1e30), T(0)}});
}
template <class T>
testing::AssertionResult sine_rules(Function<T> sine) {
    const T tiny = std::numeric_limits<T>::denorm_min();
    return gives<T>(sine, {{T(0), T(0)},
                           {T(-0.0), T(-0.0)},
                           {tiny, tiny},
                           {-tiny, -tiny},
                           {infinity<T>, nan<T>},
                           {-infinity<T>, nan<T>},
                           {nan<T>, nan<T>}});
}
/// In [-1, 1] for every finite argument.
template <class T>
testing::AssertionResult stays_in_range(Function<T> f) {
    Random random(5);
    for (int i = 0; i < 100000; ++i) {
        const T x = random.any_bits<T>();
        if (std::isfinite(x) && !(std::fabs(f(x)) <= 1)) {
            return testing::AssertionFailure() << x << " gives " << f(x);
        }
    }
    return testing::AssertionSuccess();
}
template <class T>
testing::AssertionResult arc_tangent_rules(Function2<T> arc_tangent) {
    const T pi = static_cast<T>(3.14159265358979323846);
    const T inf = infinity<T>;
    return gives2<T>(arc_tangent, {{T(0), T(0), T(0)},
                                   {T(-0.0), T(0), T(-0.0)},
                                   {T(0), T(-0.0), pi},
                                   {T(-0.0), T(-0.0), -pi},
                                   {T(0), T(1), T(0)},
                                   {T(-0.0), T(-1), -pi},
                                   {T(1), T(0), pi / 2},
                                   {T(-1), T(-0.0), -pi / 2},
                                   {inf, inf, pi / 4},
                                   {inf, T(1), pi / 2},
                                   {T(1), inf, T(0)},
                                   {T(-1), inf, T(-0.0)},
                                   {T(1), -inf, pi},
                                   {T(2), T(2), pi / 4},
                                   {nan<T>, T(1), nan<T>},
                                   {T(1), nan<T>, nan<T>},
                                   {T(1e-38), T(1e38), arc_tangent(T(1e-38), T(1e38))}});
}

template <class T>
class SpecialValues : public testing::Test {};
using Plain = testing::Types<float, double>;
TYPED_TEST_SUITE(SpecialValues, Plain);

TYPED_TEST(SpecialValues, OfExponentials) {
    using T = TypeParam;
    EXPECT_TRUE(exponential_rules<T>(quadrel::exp2));
    EXPECT_TRUE(exponential_rules<T>(quadrel::exp));
    EXPECT_TRUE(exact_on_integers<T>(quadrel::exp2));
}
TYPED_TEST(SpecialValues, OfLogarithms) {
    using T = TypeParam;
    EXPECT_TRUE(logarithm_rules<T>(quadrel::log2));
    EXPECT_TRUE(logarithm_rules<T>(quadrel::log));
    EXPECT_TRUE(inverts_powers_of_two<T>(quadrel::log2));
}
TYPED_TEST(SpecialValues, OfPowers) { EXPECT_TRUE(power_rules<TypeParam>(quadrel::pow)); }
TYPED_TEST(SpecialValues, OfSines) {
    using T = TypeParam;
    EXPECT_TRUE(sine_rules<T>(quadrel::sin));
    EXPECT_TRUE(sine_rules<T>(quadrel::tan));
    EXPECT_TRUE(stays_in_range<T>(quadrel::sin));
    EXPECT_TRUE(stays_in_range<T>(quadrel::cos));
    EXPECT_EQ(quadrel::cos(T(-0.0)), T(1));
    EXPECT_EQ(quadrel::cos(std::numeric_limits<T>::max()), T(1));  // beyond the limit: as of 0
    EXPECT_TRUE(std::isnan(quadrel::cos(infinity<T>)));
}
TYPED_TEST(SpecialValues, OfInverseTrigonometry) {
    using T = TypeParam;
    EXPECT_TRUE(arc_tangent_rules<T>(quadrel::atan2));
    EXPECT_TRUE(std::isnan(quadrel::asin(T(1.5))));
    EXPECT_TRUE(std::isnan(quadrel::acos(T(-1.5))));
    EXPECT_EQ(quadrel::acos(T(1)), T(0));
    EXPECT_TRUE(same(quadrel::asin(T(-0.0)), T(-0.0)));
}

// ---- Planted errors -----------------------------------------------------------------------------

testing::AssertionResult passes_rules(Planted error) {
    switch (error) {
        case Planted::sine_drops_sign_of_zero:
            return sine_rules<float>([](float x) { return x == 0 ? 0.0f : quadrel::sin(x); });
        case Planted::sine_escapes:
            return stays_in_range<float>([](float x) { return abs(x) > 1e30f ? x : sin(x); });
        case Planted::zero_to_zero_is_nan:
            return power_rules<float>(
                [](float x, float y) { return x == 0 && y == 0 ? nan<float> : pow(x, y); });
        case Planted::power_of_negative:
            return power_rules<float>([](float x, float y) { return pow(x < 0 ? -x : x, y); });
        case Planted::denormal_logarithm:
            return inverts_powers_of_two<float>(
                [](float x) { return log2(x < 0x1p-126f ? 0.0f : x); });
        case Planted::exp2_overflows_early:
            return exact_on_integers<float>(
                [](float x) { return x >= 127 ? infinity<float> : exp2(x); });
        case Planted::atan2_ignores_minus_zero:
            return arc_tangent_rules<float>(
                [](float y, float x) { return quadrel::atan2(y, x == 0 ? 0.0f : x); });
        default:
            return testing::AssertionSuccess() << "not planted here";
    }
}

TEST(SpecialValueRules, CatchPlantedErrors) {
    for (const Planted error :
         {Planted::sine_drops_sign_of_zero, Planted::sine_escapes, Planted::zero_to_zero_is_nan,
          Planted::power_of_negative, Planted::denormal_logarithm, Planted::exp2_overflows_early,
          Planted::atan2_ignores_minus_zero}) {
        EXPECT_FALSE(passes_rules(error)) << "planted error " << static_cast<int>(error);
    }
}

}  // namespace
}  // namespace quadrel::num_tests
