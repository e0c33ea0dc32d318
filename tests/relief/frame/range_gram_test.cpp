// J on ranges holds J of any numbers in them, and is narrower than the text makes it.
#include <gtest/gtest.h>

#include "effort.hpp"
#include "quadrel/num/quad.hpp"
#include "quadrel/relief/frame/range_gram.hpp"
#include "random.hpp"

namespace quadrel::test {
namespace {

using Number = Quad<double>;

/// The inputs of J: px, py, qx, qy.
struct GramInputs {
    double x[10];

    template <class F, class Lane>
    SurfaceJacobian<F> jacobian(const Lane& lane, auto function) const {
        const auto at = [&](int i) { return lane(x[i], i); };
        return function(vec3<F>(at(0), at(1), at(2)), vec3<F>(at(3), at(4), at(5)),
                        vec2<F>(at(6), at(7)), vec2<F>(at(8), at(9)));
    }
};

GramInputs random_inputs(Random& random) {
    GramInputs inputs;
    for (double& x : inputs.x) x = random.uniform(-1, 1) * 0.01;
    inputs.x[0] += 0.02;
    inputs.x[4] += 0.02;
    return inputs;
}

struct GramWidths {
    double narrowed = 0, natural = 0;
    bool held = true;
};

/// J of inputs up to `off` of a hundredth away, in ranges as if they were no further than
/// `claimed`.
GramWidths compare_jacobians(double off, double claimed, int samples) {
    Random random(31);
    GramWidths widths;
    for (int i = 0; i < samples; ++i) {
        const GramInputs middle = random_inputs(random);
        const auto range = [&](double x, int) {
            return Ranges(Ranged(x - 0.01 * claimed, x + 0.01 * claimed));
        };
        const auto narrowed =
            middle.jacobian<Ranges>(range, [](auto... inputs) { return gram_jacobian(inputs...); });
        const auto natural = middle.jacobian<Ranges>(
            range, [](auto... inputs) { return gram_jacobian<Ranges>(inputs...); });
        const auto one = middle.jacobian<Number>(
            [&](double x, int) { return Number(x + 0.01 * off * random.uniform(-1, 1)); },
            [](auto... inputs) { return gram_jacobian<Number>(inputs...); });
        for (int c = 0; c < 3; ++c) {
            const RealInterval u = narrowed.grad_u[c].lane[0].range();
            const double exact = one.grad_u[c].lane[0], slack = 1e-9 * (1 + std::fabs(exact));
            widths.held &= exact >= u.lo - slack && exact <= u.hi + slack;
            widths.narrowed += u.width();
            widths.natural += natural.grad_u[c].lane[0].range().width();
        }
    }
    return widths;
}

TEST(RangeGram, HoldsEveryJacobianAndIsNarrow) {
    for (const double off : {1e-6, 1e-3, 1e-2}) {
        const GramWidths widths = compare_jacobians(off, off, rounds(300));
        EXPECT_TRUE(widths.held) << off;
        EXPECT_LT(widths.narrowed, 0.6 * widths.natural) << off;
    }
}

TEST(RangeGram, DoesNotHoldThoseOfOthers) {
    EXPECT_FALSE(compare_jacobians(1e-2, 1e-3, rounds(300)).held);
}

}  // namespace
}  // namespace quadrel::test
