// Intervals of the judge: they hold the exact result, and no more than has to be.
#include "relief/oracle/interval.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "random.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {
namespace {

using quadrel::oracle::Interval;

/// Doubles of any size that matters, short ones among them, so that many results are exact.
double any_double(Random& random) {
    const double part = random.chance(0.3) ? random.below(64) - 32 : random.uniform(-1, 1);
    return std::ldexp(part, random.below(80) - 40);
}

Interval any_interval(Random& random) {
    const double a = any_double(random);
    if (random.chance(0.6)) return a;
    const double b = random.chance(0.5) ? a * (1 + 0x1p-50) : any_double(random);
    return {std::min(a, b), std::max(a, b)};
}

/// A point of the interval, its ends among them.
double within(const Interval& x, Random& random) {
    if (random.chance(0.3)) return x.lo;
    if (random.chance(0.3)) return x.hi;
    return std::clamp(x.lo + (x.hi - x.lo) * random.uniform(0, 1), x.lo, x.hi);
}

struct Operation {
    Interval (*computed)(Interval, Interval);
    mpq_class (*exact)(const mpq_class&, const mpq_class&);
    bool divides = false;
};
const Operation operations[] = {
    {[](Interval a, Interval b) { return a + b; },
     [](const mpq_class& a, const mpq_class& b) { return mpq_class(a + b); }},
    {[](Interval a, Interval b) { return a - b; },
     [](const mpq_class& a, const mpq_class& b) { return mpq_class(a - b); }},
    {[](Interval a, Interval b) { return a * b; },
     [](const mpq_class& a, const mpq_class& b) { return mpq_class(a * b); }},
    {[](Interval a, Interval b) { return a / b; },
     [](const mpq_class& a, const mpq_class& b) { return mpq_class(a / b); }, true},
};

/// Of points, the result is one too where it is exact, else as narrow as doubles are.
testing::AssertionResult is_tight(const Interval& result, const mpq_class& exact) {
    const bool is_double = mpq_class(exact.get_d()) == exact;
    if (is_double ? result.is_point() : quadrel::oracle::up(result.lo) == result.hi)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << "too wide: " << result.lo << " to " << result.hi;
}

testing::AssertionResult hold_exact_results(int count, bool rounds_to_nearest = false) {
    Random random(8);
    for (int k = 0; k < count; ++k)
        for (const Operation& operation : operations) {
            const Interval a = any_interval(random), b = any_interval(random);
            if (operation.divides && b.has_zero()) continue;
            Interval result = operation.computed(a, b);
            if (rounds_to_nearest) result = result.middle();
            const mpq_class x = within(a, random), y = within(b, random);
            const mpq_class exact = operation.exact(x, y);
            if (exact < result.lo || exact > result.hi)
                return testing::AssertionFailure() << exact.get_d() << " is outside";
            if (!a.is_point() || !b.is_point()) continue;
            if (const auto tight = is_tight(result, exact); !tight) return tight;
        }
    return testing::AssertionSuccess();
}

TEST(OracleIntervals, HoldTheExactResultTightly) {
    EXPECT_TRUE(hold_exact_results(20000));
    EXPECT_FALSE(hold_exact_results(200, true)) << static_cast<int>(Planted::bound_too_small);
}

TEST(OracleIntervals, StepFromDoubleToDouble) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double x : {0.0, -0.0, 1.0, -1.0, 0x1p-1074, -0x1p-1074, 0x1p-1022, 1e300}) {
        EXPECT_EQ(quadrel::oracle::up(x), std::nextafter(x, infinity)) << x;
        EXPECT_EQ(quadrel::oracle::down(x), std::nextafter(x, -infinity)) << x;
    }
    EXPECT_EQ(quadrel::oracle::up(infinity), infinity);
}

}  // namespace
}  // namespace quadrel::test
