// The largest error of every transcendental function, judged by MPFR, against the bound stated in
// math.hpp. The bounds are asserted here on some 100000 values a function; ulp_exhaustive.cpp
// measures the float functions on every float:
//   ninja num_ulp_exhaustive && tests/num_ulp_exhaustive all
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "num/inputs.hpp"
#include "num/mpfr_judge.hpp"
#include "num/planted.hpp"
#include "quadrel/num/math.hpp"

namespace quadrel::num_tests {
namespace {

constexpr int sample_count = 40000;

/// Where to sample: |x| in [2^smallest, 2^largest], log-uniform, both signs if `negative`.
struct Domain {
    int smallest;
    int largest;
    bool negative;
};

template <class T>
T sample(Random& random, Domain domain) {
    const T magnitude =
        static_cast<T>(random.uniform(1, 2)) *
        power_of_two(static_cast<T>(random.integer(domain.smallest, domain.largest - 1)));
    return domain.negative && random.bits() % 2 == 0 ? -magnitude : magnitude;
}

struct Largest {
    double error = 0;
    double x = 0;
    double y = 0;
};

testing::AssertionResult report(const char* name, double bound, Largest largest) {
    const std::string text = fmt::format("{}: {:.3f} ulp at ({:a}, {:a}), bound {}", name,
                                         largest.error, largest.x, largest.y, bound);
    testing::Test::RecordProperty(name, text);
    return largest.error <= bound ? testing::AssertionSuccess() << text
                                  : testing::AssertionFailure() << text;
}

template <class T>
testing::AssertionResult within(const char* name, double bound, T (*f)(T), ExactFunction exact,
                                Domain domain) {
    Random random(2);
    Largest largest;
    for (int i = 0; i < sample_count; ++i) {
        const T x = sample<T>(random, domain);
        const double error = ulp_error(f(x), exact, x);
        if (error > largest.error) largest = {error, x, 0};
    }
    return report(name, bound, largest);
}
template <class T>
testing::AssertionResult within2(const char* name, double bound, T (*f)(T, T), ExactFunction2 exact,
                                 Domain first, Domain second) {
    Random random(3);
    Largest largest;
    for (int i = 0; i < sample_count; ++i) {
        const T x = sample<T>(random, first);
        const T y = sample<T>(random, second);
        const double error = ulp_error(f(x, y), exact, x, y);
        if (error > largest.error) largest = {error, x, y};
    }
    return report(name, bound, largest);
}

// The bounds of math.hpp.
template <class T>
constexpr double exp_bound = 1.0;
template <class T>
constexpr double log_bound = 0.51;
constexpr double pow_bound = 1.0;
constexpr double sin_bound = 0.85;
constexpr double tan_bound = 2.5;
constexpr double atan_bound = 0.85;
constexpr double asin_bound = 2.0;

template <class T>
class Errors : public testing::Test {};
using Plain = testing::Types<float, double>;
TYPED_TEST_SUITE(Errors, Plain);

TYPED_TEST(Errors, OfExponentials) {
    using T = TypeParam;
    const int top = std::is_same_v<T, float> ? 7 : 10;
    const Domain domain{-30, top, true};
    EXPECT_TRUE(within<T>("exp2", exp_bound<T>, quadrel::exp2, mpfr_exp2, domain));
    EXPECT_TRUE(within<T>("exp", exp_bound<T>, quadrel::exp, mpfr_exp, domain));
}
TYPED_TEST(Errors, OfLogarithms) {
    using T = TypeParam;
    const int top = std::numeric_limits<T>::max_exponent - 1;
    for (const Domain domain : {Domain{-top + 1, top, false}, Domain{-2, 2, false}}) {
        EXPECT_TRUE(within<T>("log2", log_bound<T>, quadrel::log2, mpfr_log2, domain));
        EXPECT_TRUE(within<T>("log", log_bound<T>, quadrel::log, mpfr_log, domain));
    }
}
TYPED_TEST(Errors, OfLogarithmsOfDenormals) {
    using T = TypeParam;
    for (T x = std::numeric_limits<T>::denorm_min(); x < std::numeric_limits<T>::min();
         x *= T(1.5)) {
        const T grown = x + std::numeric_limits<T>::denorm_min();
        EXPECT_LE(ulp_error(quadrel::log2(grown), mpfr_log2, grown), log_bound<T>);
        x = grown;
    }
}
TYPED_TEST(Errors, OfPowers) {
    using T = TypeParam;
    const int top = std::numeric_limits<T>::max_exponent - 1;
    EXPECT_TRUE(
        within2<T>("pow", pow_bound, quadrel::pow, mpfr_pow, {-3, 3, false}, {-6, 6, true}));
    EXPECT_TRUE(within2<T>("pow", pow_bound, quadrel::pow, mpfr_pow, {-top + 1, top, false},
                           {-8, 1, true}));
    // Near 1, where the logarithm is small and the exponent large.
    const auto near_one = [](T x, T y) { return quadrel::pow(T(1) + x, y); };
    const auto exact = [](mpfr_ptr out, mpfr_srcptr x, mpfr_srcptr y, mpfr_rnd_t rounding) {
        const T rounded = T(1) + static_cast<T>(mpfr_get_d(x, rounding));
        const Exact base(rounded);
        return mpfr_pow(out, const_cast<Exact&>(base).get(), y, rounding);
    };
    EXPECT_TRUE(
        within2<T>("pow near 1", pow_bound, near_one, exact, {-20, -4, false}, {4, 20, true}));
}
TYPED_TEST(Errors, OfSines) {
    using T = TypeParam;
    const int top = std::numeric_limits<T>::digits - 2;
    for (const Domain domain : {Domain{-20, 4, true}, Domain{0, std::min(top, 30), true}}) {
        EXPECT_TRUE(within<T>("sin", sin_bound, quadrel::sin, mpfr_sin, domain));
        EXPECT_TRUE(within<T>("cos", sin_bound, quadrel::cos, mpfr_cos, domain));
        EXPECT_TRUE(within<T>("tan", tan_bound, quadrel::tan, mpfr_tan, domain));
    }
}
TYPED_TEST(Errors, OfSinesNearTheirZeros) {
    using T = TypeParam;
    Random random(4);
    Largest sine;
    Largest cosine;
    for (int i = 0; i < sample_count; ++i) {
        const T x = static_cast<T>(random.integer(-650000, 650000) * 1.5707963267948966);
        const double s = ulp_error(quadrel::sin(x), mpfr_sin, x);
        const double c = ulp_error(quadrel::cos(x), mpfr_cos, x);
        if (s > sine.error) sine = {s, x, 0};
        if (c > cosine.error) cosine = {c, x, 0};
    }
    EXPECT_TRUE(report("sin near zeros", sin_bound, sine));
    EXPECT_TRUE(report("cos near zeros", sin_bound, cosine));
}
TYPED_TEST(Errors, OfInverseTrigonometry) {
    using T = TypeParam;
    EXPECT_TRUE(within<T>("atan", atan_bound, quadrel::atan, mpfr_atan, {-30, 10, true}));
    EXPECT_TRUE(within<T>("asin", asin_bound, quadrel::asin, mpfr_asin, {-20, 0, true}));
    EXPECT_TRUE(within<T>("acos", asin_bound, quadrel::acos, mpfr_acos, {-20, 0, true}));
    const int top = std::numeric_limits<T>::max_exponent - 1;
    EXPECT_TRUE(
        within2<T>("atan2", atan_bound, quadrel::atan2, mpfr_atan2, {-3, 3, true}, {-3, 3, true}));
    for (const int e : {top - 5, -top + 5}) {
        const Domain extreme{e - 3, e + 3, true};
        EXPECT_TRUE(within2<T>("atan2", atan_bound, quadrel::atan2, mpfr_atan2, extreme, extreme));
    }
}

// ---- Planted errors -----------------------------------------------------------------------------

testing::AssertionResult passes_bound(Planted error) {
    switch (error) {
        case Planted::double_in_float: {
            const auto f = [](double x) { return double(quadrel::sin(static_cast<float>(x))); };
            return within<double>("sin", sin_bound, f, mpfr_sin, {-20, 4, true});
        }
        case Planted::single_word_pow: {
            const auto f = [](float x, float y) { return quadrel::exp2(y * quadrel::log2(x)); };
            return within2<float>("pow", pow_bound, f, mpfr_pow, {-3, 3, false}, {-6, 6, true});
        }
        case Planted::one_word_reduction: {
            const auto f = [](float x) {
                const float turns = round_even(x * 0.636619772f);
                const float r = x - turns * 1.57079633f;
                const float q = turns - 4 * floor(turns * 0.25f);
                const float v = q == 1 || q == 3 ? quadrel::cos(r) : quadrel::sin(r);
                return q >= 2 ? -v : v;
            };
            return within<float>("sin", sin_bound, f, mpfr_sin, {0, 4, true});
        }
        case Planted::short_polynomial: {
            const auto f = [](float x) {
                const float n = round_even(x);
                const float r = (x - n) * 0.693147181f;
                const float p = 1 + r * (1 + r * (0.5f + r * (1 / 6.0f + r / 24.0f)));
                return p * power_of_two(n);
            };
            return within<float>("exp2", exp_bound<float>, f, mpfr_exp2, {-3, 3, true});
        }
        default:
            return testing::AssertionSuccess() << "not planted here";
    }
}

TEST(ErrorBounds, CatchPlantedErrors) {
    for (const Planted error : {Planted::double_in_float, Planted::single_word_pow,
                                Planted::one_word_reduction, Planted::short_polynomial}) {
        EXPECT_FALSE(passes_bound(error)) << "planted error " << static_cast<int>(error);
    }
}

}  // namespace
}  // namespace quadrel::num_tests
