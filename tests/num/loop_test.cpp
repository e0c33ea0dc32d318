// The words of loops, where they could fail: empty ranges, the ends of int, numbers that a float
// has not, masks of some lanes.
#include "quadrel/num/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "num/planted.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/num/quad.hpp"

namespace quadrel::num_tests {
namespace {

using F = Quad<float>;
constexpr int first_int = std::numeric_limits<int>::min();
constexpr int last_int = std::numeric_limits<int>::max();

/// The numbers of a loop, `most` of them at most.
template <class Range>
std::vector<int> walked(const Range& range, std::size_t most) {
    std::vector<int> numbers;
    for (const auto k : range) {
        if (numbers.size() == most) break;
        numbers.push_back(k);
    }
    return numbers;
}

/// range(first, last) names first, ..., last, and nothing where last < first.
template <class Range>
testing::AssertionResult names_each_step(Range range) {
    struct Case {
        int first, last;
        std::vector<int> numbers;
    };
    const Case cases[] = {{0, 3, {0, 1, 2, 3}},
                          {1, 1, {1}},
                          {-2, 1, {-2, -1, 0, 1}},
                          {1, 0, {}},
                          {0, -1, {}},
                          {5, 2, {}},
                          {last_int, first_int, {}},
                          {last_int - 1, last_int, {last_int - 1, last_int}},
                          {last_int, last_int, {last_int}},
                          {first_int, first_int + 1, {first_int, first_int + 1}}};
    for (const Case& of : cases)
        if (walked(range(of.first, of.last), 10) != of.numbers)
            return testing::AssertionFailure() << of.first << " to " << of.last;
    return testing::AssertionSuccess();
}

template <class Rounds>
testing::AssertionResult goes_on(const Rounds& rounds) {
    const std::vector<int> numbers = walked(rounds, 100000);
    const bool whole = numbers.size() == 100000 && numbers.front() == 0 && numbers.back() == 99999;
    return whole ? testing::AssertionSuccess() : testing::AssertionFailure() << numbers.size();
}

/// number(k) is k in every lane, rounded to the type that lanes have.
template <class T, class ToNumber>
testing::AssertionResult gives_the_number(ToNumber to_number) {
    for (const int k : {0, 1, -1, 16777216, 16777217, -16777219, last_int, first_int}) {
        const Quad<T> x = to_number(k);
        for (int lane = 0; lane < 4; ++lane)
            if (x.lane[lane] != static_cast<T>(k)) return testing::AssertionFailure() << k;
    }
    return testing::AssertionSuccess();
}

/// when(mask): some lane; none(mask): no lane; of all sixteen masks of a quad.
template <class When, class None>
testing::AssertionResult asks_for_some_lane(When some, None no) {
    for (int bits = 0; bits < 16; ++bits) {
        F x(0);
        for (int lane = 0; lane < 4; ++lane) x.lane[lane] = static_cast<float>(bits >> lane & 1);
        const Mask<F> mask = x > F(0);
        if (some(mask) != (bits != 0) || no(mask) != (bits == 0))
            return testing::AssertionFailure() << "mask " << bits;
    }
    return testing::AssertionSuccess();
}

TEST(LoopWords, StepsAreThoseOfTheRange) {
    EXPECT_TRUE(names_each_step([](int first, int last) { return steps<F>(first, last); }));
    EXPECT_FALSE(names_each_step([](int first, int last) {
        return steps<F>(first, last == first_int ? last : last - 1);
    })) << static_cast<int>(Planted::last_step_left_out);
    EXPECT_FALSE(names_each_step([](int first, int last) {
        return steps<F>(first, std::max(first, last));
    })) << static_cast<int>(Planted::empty_range_walked);
    EXPECT_FALSE(names_each_step([](int first, int last) {
        return last == last_int ? steps<F>(1, 0) : steps<F>(first, last);
    })) << static_cast<int>(Planted::last_int_wraps);
}

TEST(LoopWords, RoundsGoOn) {
    EXPECT_TRUE(goes_on(rounds<F>()));
    EXPECT_FALSE(goes_on(steps<F>(0, 999))) << static_cast<int>(Planted::rounds_end);
}

TEST(LoopWords, NumbersAreThoseOfTheLanes) {
    EXPECT_TRUE(gives_the_number<float>([](int k) { return number<F>(k); }));
    EXPECT_TRUE(gives_the_number<double>([](int k) { return number<Quad<double>>(k); }));
    EXPECT_FALSE(gives_the_number<double>([](int k) {
        return Quad<double>(static_cast<double>(static_cast<float>(k)));
    })) << static_cast<int>(Planted::number_by_float);
    for (const auto k : steps<double>(7, 7)) EXPECT_EQ(number<double>(k + 1), 8.0);
}

TEST(LoopWords, MasksAreAskedForSomeLane) {
    const auto some = [](const Mask<F>& mask) { return when(mask); };
    const auto no = [](const Mask<F>& mask) { return none(mask); };
    EXPECT_TRUE(asks_for_some_lane(some, no));
    EXPECT_FALSE(asks_for_some_lane([](const Mask<F>& mask) { return all(mask); }, no))
        << static_cast<int>(Planted::when_all_lanes);
    EXPECT_TRUE(none(false) && when(true));
}

/// A shader's loop as texts write it, against one written out: each lane leaves at its own step.
TEST(LoopWords, LanesLeaveALoopOneByOne) {
    F x(0);
    for (int lane = 0; lane < 4; ++lane) x.lane[lane] = static_cast<float>(3 * lane);
    Mask<F> active(true);
    F sum(0);
    int bodies = 0;
    for (const auto k : steps<F>(0, 100)) {
        active = active & (number<F>(k) < x);
        if (none(active)) break;
        sum = select(active, sum + number<F>(k), sum);
        ++bodies;
    }
    EXPECT_EQ(bodies, 9);
    for (int lane = 0; lane < 4; ++lane)
        EXPECT_EQ(sum.lane[lane], static_cast<float>(3 * lane * (3 * lane - 1) / 2));
}

}  // namespace
}  // namespace quadrel::num_tests
