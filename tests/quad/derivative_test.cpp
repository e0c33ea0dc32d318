// dFdx, dFdy, fwidth, quad swaps and broadcasts, on plain floats and doubles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "quad/planted.hpp"
#include "quadrel/num/derivative.hpp"
#include "quadrel/num/functions.hpp"

namespace quadrel::quad_tests {
namespace {

/// The functions under test.
template <class F>
struct Derivatives {
    F (*dx)(F, DerivativeMode) = [](F v, DerivativeMode mode) { return dFdx(v, mode); };
    F (*dy)(F, DerivativeMode) = [](F v, DerivativeMode mode) { return dFdy(v, mode); };
    F (*width)(F, DerivativeMode) = [](F v, DerivativeMode mode) { return fwidth(v, mode); };
};

template <class F>
Derivatives<F> with(Planted error) {
    Derivatives<F> d;
    using Mode = DerivativeMode;
    if (error == Planted::left_minus_right) d.dx = [](F v, Mode m) { return -dFdx(v, m); };
    if (error == Planted::rows_for_columns) d.dy = d.dx;
    if (error == Planted::coarse_for_fine)
        d.dx = [](F v, Mode) { return dFdx(v, DerivativeMode::coarse); };
    if (error == Planted::odd_row_coarse)
        d.dx = [](F v, Mode m) {
            return m == Mode::coarse ? broadcast_lane<3>(v) - broadcast_lane<2>(v) : dFdx(v, m);
        };
    if (error == Planted::width_of_sum)
        d.width = [](F v, Mode m) { return abs(dFdx(v, m) + dFdy(v, m)); };
    return d;
}

template <class F>
testing::AssertionResult is(const char* what, F found, std::array<double, 4> expected) {
    for (std::size_t i = 0; i < 4; ++i)
        if (static_cast<double>(found.lane[i]) != expected[i] &&
            !(std::isnan(found.lane[i]) && std::isnan(expected[i])))
            return testing::AssertionFailure() << what << ", lane " << i << ": " << found.lane[i]
                                               << ", expected " << expected[i];
    return testing::AssertionSuccess();
}

/// Values whose four differences are all different.
template <class F>
testing::AssertionResult differentiates(const Derivatives<F>& d) {
    constexpr auto fine = DerivativeMode::fine, coarse = DerivativeMode::coarse;
    const F v(1, 5, 12, -8);
    for (const auto& result :
         {is("dFdx fine", d.dx(v, fine), {4, 4, -20, -20}),
          is("dFdy fine", d.dy(v, fine), {11, -13, 11, -13}),
          is("dFdx coarse", d.dx(v, coarse), {4, 4, 4, 4}),
          is("dFdy coarse", d.dy(v, coarse), {11, 11, 11, 11}),
          is("fwidth fine", d.width(v, fine), {15, 17, 31, 33}),
          is("fwidth coarse", d.width(v, coarse), {15, 15, 15, 15}),
          is("fwidth of opposite slopes", d.width(F(3, 1, 5, 3), coarse), {4, 4, 4, 4})})
        if (!result) return result;
    return testing::AssertionSuccess();
}

/// A NaN spoils the differences that it takes part in, and no others.
template <class F>
testing::AssertionResult keeps_nan_in_place(const Derivatives<F>& d) {
    constexpr auto fine = DerivativeMode::fine;
    const double nan = std::nan("");
    const F v(1, 5, 12, std::numeric_limits<Scalar<F>>::quiet_NaN());
    auto dx = is("dFdx with a NaN", d.dx(v, fine), {4, 4, nan, nan});
    return dx ? is("dFdy with a NaN", d.dy(v, fine), {11, nan, 11, nan}) : dx;
}

template <class T>
class QuadOf : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(QuadOf, Scalars);

TYPED_TEST(QuadOf, Differentiates) {
    using F = Quad<TypeParam>;
    EXPECT_TRUE(differentiates(Derivatives<F>()));
    EXPECT_TRUE(keeps_nan_in_place(Derivatives<F>()));
    for (const Planted error :
         {Planted::left_minus_right, Planted::rows_for_columns, Planted::coarse_for_fine,
          Planted::odd_row_coarse, Planted::width_of_sum})
        EXPECT_FALSE(differentiates(with<F>(error))) << static_cast<int>(error);
    EXPECT_FALSE(keeps_nan_in_place(with<F>(Planted::coarse_for_fine)));
}

TYPED_TEST(QuadOf, DifferentiatesVectorsByComponent) {
    using F = Quad<TypeParam>;
    const F a(1, 5, 12, -8), b(0, 1, 2, 4), c(3);
    const vec3<F> v(a, b, c);
    for (const DerivativeMode mode : {DerivativeMode::fine, DerivativeMode::coarse})
        for (int i = 0; i < 3; ++i) {
            const F component = i == 0 ? a : i == 1 ? b : c;
            EXPECT_TRUE(all(dFdx(v, mode)[i] == dFdx(component, mode)));
            EXPECT_TRUE(all(dFdy(v, mode)[i] == dFdy(component, mode)));
            EXPECT_TRUE(all(fwidth(v, mode)[i] == fwidth(component, mode)));
        }
}

TYPED_TEST(QuadOf, SwapsAndBroadcasts) {
    using F = Quad<TypeParam>;
    const F v(1, 2, 3, 4);
    EXPECT_TRUE(is("horizontal", swap_horizontal(v), {2, 1, 4, 3}));
    EXPECT_TRUE(is("vertical", swap_vertical(v), {3, 4, 1, 2}));
    EXPECT_TRUE(is("diagonal", swap_diagonal(v), {4, 3, 2, 1}));
    EXPECT_TRUE(is("lane 0", broadcast_lane<0>(v), {1, 1, 1, 1}));
    EXPECT_TRUE(is("lane 1", broadcast_lane<1>(v), {2, 2, 2, 2}));
    EXPECT_TRUE(is("lane 2", broadcast_lane<2>(v), {3, 3, 3, 3}));
    EXPECT_TRUE(is("lane 3", broadcast_lane<3>(v), {4, 4, 4, 4}));
    EXPECT_FALSE(is("horizontal", swap_vertical(v), {2, 1, 4, 3}));
}

}  // namespace
}  // namespace quadrel::quad_tests
