// Ranges hold what they must: the exact result, what double computes, and whatever an
// implementation may give within its permitted errors.
#include <gtest/gtest.h>

#include "num/mpfr_judge.hpp"
#include "num/planted.hpp"
#include "num/range_support.hpp"
#include "quadrel/num/range/geometry.hpp"
#include "random.hpp"

namespace quadrel::num_tests {
namespace {

using test::Random;

/// A function of ranges, in double, and by MPFR.
struct RangeCase {
    const char* name;
    Ranged (*range)(const Ranged&, const Ranged&);
    double (*computed)(double, double);
    ExactFunction2 exact;
    double low, high;  ///< of the arguments
    double second_low = 1, second_high = 1;
};

template <ExactFunction f>
int of_one(mpfr_ptr to, mpfr_srcptr x, mpfr_srcptr, mpfr_rnd_t mode) {
    return f(to, x, mode);
}
int inverse_root(mpfr_ptr to, mpfr_srcptr x, mpfr_srcptr, mpfr_rnd_t mode) {
    return mpfr_rec_sqrt(to, x, mode);
}

#define QUADREL_ONE(f)                                   \
    [](const Ranged& a, const Ranged&) { return f(a); }, \
        [](double a, double) { return static_cast<double>(f(a)); }
#define QUADREL_TWO(f) \
    [](const Ranged& a, const Ranged& b) { return f; }, [](double a, double b) { return f; }

const RangeCase range_cases[] = {
    {"+", QUADREL_TWO(a + b), mpfr_add, -1000, 1000, -1000, 1000},
    {"-", QUADREL_TWO(a - b), mpfr_sub, -1000, 1000, -1000, 1000},
    {"*", QUADREL_TWO(a* b), mpfr_mul, -1000, 1000, -1000, 1000},
    {"/", QUADREL_TWO(a / b), mpfr_div, -1000, 1000, 0.001, 1000},
    {"sqrt", QUADREL_ONE(sqrt), of_one<mpfr_sqrt>, 0, 1000},
    {"inversesqrt", QUADREL_ONE(inversesqrt), inverse_root, 0.001, 1000},
    {"exp2", QUADREL_ONE(exp2), of_one<mpfr_exp2>, -60, 60},
    {"exp", QUADREL_ONE(exp), of_one<mpfr_exp>, -40, 40},
    {"log2", QUADREL_ONE(log2), of_one<mpfr_log2>, 0.001, 1000},
    {"log", QUADREL_ONE(log), of_one<mpfr_log>, 0.001, 1000},
    {"pow", QUADREL_TWO(pow(a, b)), mpfr_pow, 0.01, 4, -8, 8},
    {"sin", QUADREL_ONE(sin), of_one<mpfr_sin>, -3.14, 3.14},
    {"cos", QUADREL_ONE(cos), of_one<mpfr_cos>, -3.14, 3.14},
    {"atan", QUADREL_ONE(atan), of_one<mpfr_atan>, -100, 100},
    {"atan2", QUADREL_TWO(atan2(a, b)), mpfr_atan2, -10, 10, 0.01, 10},
    {"min", QUADREL_TWO(min(a, b)), mpfr_min, -10, 10, -10, 10},
    {"max", QUADREL_TWO(max(a, b)), mpfr_max, -10, 10, -10, 10},
    {"abs", QUADREL_ONE(abs), of_one<mpfr_abs>, -10, 10},
};

/// Floats, some of them short, as a range of one or of more.
RealInterval any_argument(Random& random, double low, double high) {
    const auto any = [&] {
        const double x = random.uniform(low, high);
        return random.chance(0.3) ? std::clamp(std::nearbyint(x), low, high)
                                  : static_cast<double>(static_cast<float>(x));
    };
    const double a = any();
    if (random.chance(0.4)) return a;
    const double b = random.chance(0.5) ? std::clamp(a + (high - low) * 1e-5, low, high) : any();
    return {std::min(a, b), std::max(a, b)};
}
double within(const RealInterval& x, Random& random) {
    if (random.chance(0.25)) return x.lo;
    if (random.chance(0.25)) return x.hi;
    const double part = random.uniform(0, 1);
    return std::clamp(x.lo + (x.hi - x.lo) * part, x.lo, x.hi);
}

bool holds(const RealInterval& range, double x) { return range.lo <= x && x <= range.hi; }
bool holds(const RealInterval& range, Exact& x) {
    return mpfr_cmp_d(x.get(), range.lo) >= 0 && mpfr_cmp_d(x.get(), range.hi) <= 0;
}

/// What a careless implementation would do instead.
enum class Careless { nothing, ends_to_middle, upper_end_of_lower };

testing::AssertionResult holds_results(const RangeCase& of, int count, Careless careless) {
    Random random(11);
    range_context().budget = ErrorBudget();
    for (int k = 0; k < count; ++k) {
        const RealInterval a = any_argument(random, of.low, of.high);
        const RealInterval b = any_argument(random, of.second_low, of.second_high);
        RealInterval result = of.range(a, b).range();
        if (careless == Careless::ends_to_middle) result = result.middle();
        if (careless == Careless::upper_end_of_lower) result = of.range(a.lo, b.lo).range();
        const double x = within(a, random), y = within(b, random);
        Exact exact(x), second(y);
        of.exact(exact.get(), exact.get(), second.get(), MPFR_RNDN);
        if (!holds(result, exact))
            return testing::AssertionFailure()
                   << of.name << "(" << x << ", " << y << ") is outside";
        if (!holds(result, of.computed(x, y)))
            return testing::AssertionFailure() << of.name << " in double is outside";
    }
    return testing::AssertionSuccess();
}

/// Set QUADREL_RANGE_INPUTS for more than 60 000 an operation.
int range_inputs() {
    const char* const wanted = std::getenv("QUADREL_RANGE_INPUTS");
    return wanted != nullptr ? std::atoi(wanted) : 60000;
}

TEST(Ranges, HoldExactResultsAndThoseOfDouble) {
    for (const RangeCase& of : range_cases)
        EXPECT_TRUE(holds_results(of, range_inputs(), Careless::nothing));
}
TEST(Ranges, OfCarelessArithmeticAreFound) {
    for (const RangeCase& of : range_cases) {
        if (of.exact == mpfr_min || of.exact == mpfr_max) continue;
        EXPECT_FALSE(holds_results(of, 400, Careless::ends_to_middle)) << of.name;
        EXPECT_FALSE(holds_results(of, 400, Careless::upper_end_of_lower)) << of.name;
    }
}

// ---- An implementation's errors -----------------------------------------------------------------

/// x as some float beside it.
double any_rounding(double x, Random& random) {
    const auto f = static_cast<float>(x);
    const float other = std::nextafter(f, f < x ? std::numeric_limits<float>::infinity()
                                                : -std::numeric_limits<float>::infinity());
    return f == x || random.chance(0.5) ? f : other;
}

/// Sums of products in any order, some of them fused: what compilers make of dot(a, b) + c.
double any_dot(const float* a, const float* b, float c, Random& random) {
    double terms[4];
    int left = 0;
    bool exact[4];
    for (int i = 0; i < 3; ++i) {
        const double product = static_cast<double>(a[i]) * b[i];
        exact[left] = random.chance(0.5);  // to be fused with a sum
        terms[left++] = product;
    }
    exact[left] = false;
    terms[left++] = c;
    while (left > 1) {
        const int i = random.below(left);
        std::swap(terms[i], terms[left - 1]);
        std::swap(exact[i], exact[left - 1]);
        const int j = random.below(left - 1);
        double x = terms[left - 1], y = terms[j];
        if (!exact[left - 1] || exact[j]) x = any_rounding(x, random);
        if (!exact[j]) y = any_rounding(y, random);
        terms[j] = any_rounding(x + y, random);
        exact[j] = false;
        --left;
    }
    return terms[0];
}

testing::AssertionResult holds_every_order(int count, bool sums_as_written) {
    Random random(5);
    range_context().budget = gpu_like();
    for (int k = 0; k < count; ++k) {
        float a[3], b[3];
        for (int i = 0; i < 3; ++i) {
            a[i] = static_cast<float>(random.uniform(-4, 4));
            b[i] = static_cast<float>(random.uniform(-4, 4));
        }
        // Often nearly nothing is left.
        const float c = random.chance(0.7)
                            ? static_cast<float>(-(double(a[0]) * b[0] + double(a[1]) * b[1]))
                            : 1;
        const auto product = [&](int i) { return Ranged(a[i]) * Ranged(b[i]); };
        Ranged sum = product(0) + product(1);
        if (sums_as_written) sum = sum.range();
        sum = sum + product(2);
        if (sums_as_written) sum = sum.range();
        const RealInterval range = (sum + Ranged(c)).range();
        if (!holds(range, any_dot(a, b, c, random)))
            return testing::AssertionFailure() << "an order of the sum is outside";
    }
    return testing::AssertionSuccess();
}

TEST(Ranges, HoldSumsInEveryOrder) {
    EXPECT_TRUE(holds_every_order(100000, false));
    EXPECT_FALSE(holds_every_order(100000, true));
}

/// `ulps` too few are found.
testing::AssertionResult holds_permitted_quotients(int count, double share) {
    Random random(6);
    range_context().budget = gpu_like();
    range_context().budget.division *= share;
    for (int k = 0; k < count; ++k) {
        const double x = static_cast<float>(random.uniform(-9, 9));
        const double y = static_cast<float>(random.uniform(0.1, 9));
        const double quotient = x / y;
        const double found = quotient * (1 + random.uniform(-2.5, 2.5) * 0x1p-23);
        if (!holds((Ranged(x) / Ranged(y)).range(), found))
            return testing::AssertionFailure() << x << " / " << y;
    }
    return testing::AssertionSuccess();
}

TEST(Ranges, HoldPermittedQuotients) {
    EXPECT_TRUE(holds_permitted_quotients(50000, 1));
    EXPECT_FALSE(holds_permitted_quotients(5000, 0.8));
}

TEST(Ranges, OfWhatMayBeFlushedHoldZero) {
    range_context().budget = gpu_like();
    const RealInterval product = (Ranged(0x1p-70) * Ranged(0x1p-70)).range();
    EXPECT_TRUE(holds(product, 0));
    EXPECT_TRUE(holds(product, 0x1p-140));
    range_context().budget = ErrorBudget();
    EXPECT_EQ((Ranged(0x1p-70) * Ranged(0x1p-70)).range().lo, 0x1p-140);
}

TEST(Ranges, OfWhatMayBeNoNumberAreAnything) {
    range_context().budget = gpu_like();
    const Ranged around_zero(-1, 1), one(1), huge(3e38);
    for (const Ranged& x : {one / around_zero, sqrt(around_zero), log2(around_zero), huge * huge,
                            huge + huge, Ranged(std::nan("")), one / around_zero * Ranged(2),
                            min(one / around_zero, one), pow(around_zero, one)})
        EXPECT_FALSE(x.is_bounded());
    EXPECT_TRUE((one / around_zero * Ranged(0.0)).is_null() ||
                !(one / around_zero * Ranged(0.0)).is_bounded());
}

TEST(Ranges, ThatShareErrorsDifferByLittle) {
    range_context().budget = gpu_like();
    Ranged a(0.5), b(0.501);
    a.named = b.named = 1;
    a.part[0] = 0x1p-10;
    b.part[0] = 0x1p-10 + 0x1p-20;
    const RealInterval apart = (b - a).range();
    EXPECT_LT(apart.width(), 0x1p-18);
    EXPECT_TRUE(holds(apart, 0.501f - 0.5 + 0x1p-20));
    EXPECT_TRUE(holds(apart, 0.501f - 0.5 - 0x1p-20));
    b.named = 2;
    EXPECT_GT((b - a).range().width(), 0x1p-9);
}

// ---- Ways ---------------------------------------------------------------------------------------

/// What a lane of `text` may be, way by way.
template <class Text>
std::vector<RealInterval> ways_of(int lane, const Text& text) {
    RangeContext& context = range_context();
    std::vector<RealInterval> ways;
    context.begin_lane(lane);
    do {
        context.begin_run();
        ways.push_back(text().lane[lane < 0 ? 0 : lane].range());
    } while (!context.too_many && ways.size() < 100 && context.next_way());
    return ways;
}

Ranges lanes(double a, double b, double c, double d) {
    Ranges v;
    const double all[] = {a, b, c, d};
    for (int i = 0; i < 4; ++i) v.lane[i] = Ranged(all[i]);
    return v;
}

/// Implementations may take a quad's differences from whichever row and column they like.
TEST(Ranges, OfDerivativesHoldBothRowsAndColumns) {
    const Ranges v = lanes(0, 1, 4, 9);
    range_context().budget = gpu_like();
    for (int i = 0; i < 4; ++i) {
        for (const double x : {1.0, 5.0}) EXPECT_TRUE(holds(dFdx(v).lane[i].range(), x)) << i;
        for (const double y : {4.0, 8.0}) EXPECT_TRUE(holds(dFdy(v).lane[i].range(), y)) << i;
    }
    range_context().budget = ErrorBudget();
    EXPECT_FALSE(holds(dFdx(v).lane[0].range(), 5));
    EXPECT_FALSE(holds(dFdy(v).lane[0].range(), 8));
}

/// Along a known row and column they are the same in all lanes, and nothing else.
TEST(Ranges, OfDerivativesAreThoseOfAKnownRowAndColumn) {
    const Ranges v = lanes(0, 1, 4, 9);
    RangeContext& context = range_context();
    context.budget = gpu_like();
    for (context.row_and_column = 0; context.row_and_column < 4; ++context.row_and_column)
        for (int i = 0; i < 4; ++i) {
            const bool lower = context.row_and_column % 2 != 0, right = context.row_and_column > 1;
            const RealInterval x = dFdx(v).lane[i].range(), y = dFdy(v).lane[i].range();
            EXPECT_EQ(holds(x, 1), !lower);
            EXPECT_EQ(holds(x, 5), lower);
            EXPECT_EQ(holds(y, 4), !right);
            EXPECT_EQ(holds(y, 8), right);
        }
    context.row_and_column = -1;
}

/// Near t = 1 the form that compilers make of mix loses all of a small b.
TEST(Ranges, OfMixHoldBothForms) {
    const Ranges a(1), b(0x1p-30), t(1);
    range_context().budget = gpu_like();
    const RealInterval either = mix(a, b, t).lane[0].range();
    EXPECT_TRUE(holds(either, 0x1p-30));
    EXPECT_TRUE(holds(either, 0.0));
    range_context().budget = ErrorBudget();
    EXPECT_FALSE(holds(mix(a, b, t).lane[0].range(), 0));
}

TEST(RangeWays, AreGoneThroughOneByOne) {
    range_context().budget = ErrorBudget();
    const auto staircase = [] {
        const Ranges x(Ranged(0.0, 3.0));
        Ranges sum(0);
        for (const double k : {0.5, 1.5, 2.5})
            sum = sum + select(x > Ranges(k), Ranges(1), Ranges(0));
        return sum;
    };
    const auto ways = ways_of(2, staircase);
    EXPECT_EQ(ways.size(), 8u);  // it does not know that 2.5 is above 1.5
    for (const RealInterval& way : ways) EXPECT_TRUE(way.is_point());
    const auto together = ways_of(-1, staircase);
    ASSERT_EQ(together.size(), 1u);
    EXPECT_EQ(together[0].lo, 0);
    EXPECT_EQ(together[0].hi, 3);
    EXPECT_EQ(range_context().joined & 1u, 1u);
}

TEST(RangeWays, KeepTheirAnswers) {
    range_context().budget = ErrorBudget();
    const auto ways = ways_of(0, [] {
        const RangeMask m = Ranges(Ranged(0.0, 2.0)) < Ranges(1);
        const Ranges a = select(m, Ranges(1), Ranges(0)), b = select(!m, Ranges(1), Ranges(0));
        return a + b;
    });
    ASSERT_EQ(ways.size(), 2u);
    for (const RealInterval& way : ways) EXPECT_EQ(way.lo, 1);
}

TEST(RangeWays, AreNotTakenForWhatDoesNotMatter) {
    range_context().budget = ErrorBudget();
    const auto ways = ways_of(0, [] {
        const RangeMask m = Ranges(Ranged(0.0, 2.0)) < Ranges(1);
        return select(m & RangeMask(false), Ranges(1), Ranges(5)) + select(m, Ranges(7), Ranges(7));
    });
    ASSERT_EQ(ways.size(), 1u);
    EXPECT_EQ(ways[0].lo, 12);
}

TEST(RangeWays, OfFloorAreItsIntegers) {
    range_context().budget = ErrorBudget();
    const auto ways = ways_of(1, [] { return floor(Ranges(Ranged(0.5, 2.5))); });
    ASSERT_EQ(ways.size(), 3u);
    for (const RealInterval& way : ways) EXPECT_TRUE(way.is_point());
}

/// The first step at or below a surface that may be at 1.5 to 3.5; 9 if there is none.
Ranges first_step_below_surface(int* steps) {
    const Ranges surface(Ranged(1.5, 3.5));
    Ranges found(9);
    RangeMask active(true);
    int k = 0;
    for (; k < 9 && any(active); ++k) {
        const RangeMask below = active & (Ranges(k) >= surface);
        found = select(below, Ranges(k), found);
        active = active & !below;
    }
    *steps = k;
    return found;
}

/// Where both sides are taken together, a search ends at the step that is certain, and what it
/// began with is not among its results.
TEST(RangeWays, OfSearchesEndTogetherWhereTheyMust) {
    range_context().budget = ErrorBudget();
    range_context().kind = Undecided::hit;
    int steps = 0;
    const auto apart = ways_of(0, [&] { return first_step_below_surface(&steps); });
    EXPECT_EQ(apart.size(), 3u);
    for (const bool followed : {false, true}) {
        range_context().together = RangeContext::all_kinds;
        const auto together =
            ways_of(followed ? 0 : -1, [&] { return first_step_below_surface(&steps); });
        range_context().together = 0;
        ASSERT_EQ(together.size(), 1u);
        EXPECT_EQ(together[0].lo, 2);
        EXPECT_EQ(together[0].hi, 4);
        EXPECT_EQ(steps, 5);
    }
}

TEST(RangeWays, OverTheLimitAreSaid) {
    range_context().budget = ErrorBudget();
    ways_of(0, [] {
        Ranges sum(0);
        for (int k = 0; k < 100; ++k)
            sum = sum + select(Ranges(Ranged(0.0, 1.0)) < Ranges(0.5), Ranges(1), Ranges(0));
        return sum;
    });
    EXPECT_TRUE(range_context().too_many);
}

}  // namespace
}  // namespace quadrel::num_tests
