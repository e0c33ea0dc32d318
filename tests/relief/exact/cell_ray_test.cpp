// Where a ray is among the cells of a grid, with and without divisions.
#include "quadrel/relief/trace/exact/forward_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random.hpp"

namespace quadrel::test {
namespace {

/// A ray over some cells, often along borders or through whole numbers of them.
template <PlainFloat T>
CellRayAxis<T> random_axis(Random& random, const GridAxis& grid) {
    const auto number = [&](double range) {
        const T x = static_cast<T>(random.uniform(-range, range));
        if (random.chance(0.3)) return std::round(x);
        return random.chance(0.1) ? std::round(x * 4) / 4 : x;
    };
    CellRayAxis<T> axis;
    axis.start = number(random.chance(0.1) ? 4000 : 20);
    axis.rate = random.chance(0.1) ? T(0) : number(random.chance(0.2) ? 0.01 : 30);
    axis.grid = grid;
    axis.slack =
        unit_roundoff<T> * (T(4) * std::abs(axis.start) + T(6) * std::abs(axis.rate) + T(2));
    return axis;
}

/// Border after border, by their parameters alone.
template <PlainFloat T>
int walked(const CellRayAxis<T>& axis, T s, bool closed) {
    int cell = axis.first();
    while (axis.exit(cell) < s || (closed && axis.exit(cell) == s)) cell += axis.step();
    return cell;
}

/// s in [0, 1], often at a border's parameter or next to it.
template <PlainFloat T>
T random_s(Random& random, const CellRayAxis<T>& axis) {
    const T some = static_cast<T>(random.uniform(0, 1));
    if (random.chance(0.3)) return some;
    const T border = axis.border(to_int(std::floor(axis.at(some))));
    const T near = random.chance(0.5)   ? border
                   : random.chance(0.5) ? std::nextafter(border, T(2))
                                        : std::nextafter(border, T(-1));
    return near >= 0 && near <= 1 ? near : some;
}

/// `change` plants an error in the axis that is asked.
template <PlainFloat T, class Change>
testing::AssertionResult locates_as_a_walk(const Change& change) {
    Random random(11);
    const GridAxis grids[] = {{0, 8, true}, {0, 7, true}, {-1, 9, false}, {-9, 17, false}};
    for (int k = 0; k < 40000; ++k) {
        const CellRayAxis<T> axis = random_axis<T>(random, grids[k % 4]);
        const T s = random_s(random, axis);
        const bool closed = random.chance(0.5);
        CellRayAxis<T> asked = axis;
        change(asked);
        const int found = asked.locate(true, s, closed), expected = walked(axis, s, closed);
        // At s = 0 a walk is already where borders at 0 have been crossed or not.
        if (axis.later(axis.first(), found) != expected)
            return testing::AssertionFailure() << found << " for " << expected << " at " << s
                                               << " from " << axis.start << " by " << axis.rate;
    }
    return testing::AssertionSuccess();
}

TEST(CellRay, LocateCrossesTheBordersOfAWalk) {
    EXPECT_TRUE(locates_as_a_walk<float>([](auto&) {}));
    EXPECT_TRUE(locates_as_a_walk<double>([](auto&) {}));
    // As if positions had no error: near borders, the cell of the position is not the ray's.
    EXPECT_FALSE(locates_as_a_walk<float>([](auto& axis) { axis.slack = -1; }));
    EXPECT_FALSE(locates_as_a_walk<double>([](auto& axis) { axis.slack = -1; }));
}

/// Mirrored or not, the cell of a position that lies between borders is the ray's.
template <class Axis, PlainFloat T>
testing::AssertionResult forward_cells_are_a_walks() {
    Random random(13);
    const GridAxis grids[] = {{0, 8, true}, {0, 7, true}, {-1, 9, false}, {-9, 17, false}};
    for (int k = 0; k < 40000; ++k) {
        const CellRayAxis<T> axis = random_axis<T>(random, grids[k % 4]);
        if (k % 4 != 0 && std::same_as<Axis, PowerOfTwoAxis<T>>) continue;
        const T s = random_s(random, axis);
        const Axis forward(axis);
        const T position = forward.at(s);
        if (!forward.is_between_borders(position)) continue;
        const int cell = forward.mirrored(forward.cell(std::floor(position)));
        const int expected = walked(axis, s, random.chance(0.5));
        if (cell != expected || forward.at(s) != (axis.rate < 0 ? -axis.at(s) : axis.at(s)))
            return testing::AssertionFailure() << cell << " for " << expected << " at " << s
                                               << " from " << axis.start << " by " << axis.rate;
    }
    return testing::AssertionSuccess();
}

/// Takes the cell of the position, however near its border is.
template <PlainFloat T>
struct NoBorders : AnyAxis<T> {
    using AnyAxis<T>::AnyAxis;
    bool is_between_borders(T) const { return true; }
};

TEST(CellRay, ForwardAxesFindTheSameCells) {
    EXPECT_TRUE((forward_cells_are_a_walks<AnyAxis<float>, float>()));
    EXPECT_TRUE((forward_cells_are_a_walks<AnyAxis<double>, double>()));
    EXPECT_TRUE((forward_cells_are_a_walks<PowerOfTwoAxis<float>, float>()));
    EXPECT_FALSE((forward_cells_are_a_walks<NoBorders<float>, float>()));
    EXPECT_FALSE((forward_cells_are_a_walks<NoBorders<double>, double>()));
}

/// `convert` on whole numbers as far as positions go, and a little further.
template <class Convert>
bool converts_whole_numbers(const Convert& convert) {
    Random random(13);
    for (int k = 0; k < 2000; ++k) {
        const int n = k < 20 ? k - 10 : random.below(0x7ffffe) - 0x3fffff;
        if (convert(static_cast<float>(n)) != n) return false;
    }
    return true;
}

TEST(CellRay, WholeNumbersAreConverted) {
    EXPECT_TRUE(converts_whole_numbers([](float x) { return whole_number<float>(x); }));
    EXPECT_TRUE(converts_whole_numbers([](float x) { return whole_number<double>(x); }));
    EXPECT_TRUE(converts_whole_numbers(
        [](float x) { return whole_number(Quad<float>(0, x, 1, 2)).lane[1]; }));
    // Of numbers above 0 alone.
    EXPECT_FALSE(
        converts_whole_numbers([](float x) { return quadrel::as_int(x + 0x1p23f) - 0x4b000000; }));
}

/// Far from borders no division is made: what locate is quick by.
TEST(CellRay, MostPositionsAreBetweenBorders) {
    Random random(12);
    int between = 0;
    for (int k = 0; k < 1000; ++k) {
        const auto axis = random_axis<float>(random, {0, 8, true});
        const float s = static_cast<float>(random.uniform(0, 1));
        between += is_between_borders(axis.at(s) + 0.3f, axis.slack);
    }
    EXPECT_GT(between, 950);
}

}  // namespace
}  // namespace quadrel::test
