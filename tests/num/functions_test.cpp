// The table of built-ins: each composition as its comment writes it, bit for bit, and what it is
// for, as properties in double.
#include "quadrel/num/functions.hpp"

#include <gtest/gtest.h>

#include "num/inputs.hpp"
#include "num/planted.hpp"
#include "quadrel/num/double_word.hpp"

namespace quadrel::num_tests {
namespace {

using D = double;
using V = vec3<double>;

V draw_vector(Random& random) {
    return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}
bool near(const V& a, const V& b, double tolerance = 1e-12) { return length(a - b) <= tolerance; }

/// property(random) on 1000 draws.
template <class Property>
testing::AssertionResult holds(Property property) {
    Random random(6);
    for (int i = 0; i < 1000; ++i) {
        if (!property(random)) return testing::AssertionFailure() << "draw " << i;
    }
    return testing::AssertionSuccess();
}

template <class Normalize>
testing::AssertionResult normalizes(Normalize normalized) {
    return holds([&](Random& random) {
        const V v = draw_vector(random);
        const V n = normalized(v);
        return abs(length(n) - 1) < 1e-14 && near(n * length(v), v);
    });
}
template <class Inverse>
testing::AssertionResult inverts(Inverse inverted) {
    return holds([&](Random& random) {
        const mat3<D> m(draw_vector(random), draw_vector(random), draw_vector(random));
        if (abs(determinant(m)) < 1e-3) return true;
        const V v = draw_vector(random);
        return near(inverted(m) * (m * v), v, 1e-9) && near(m * (inverted(m) * v), v, 1e-9);
    });
}
template <class Mix>
testing::AssertionResult mixes(Mix mixed) {
    return holds([&](Random& random) {
        const D a = random.uniform(-1, 1);
        const D b = random.uniform(-1, 1);
        return mixed(a, b, 0.0) == a && mixed(a, b, 1.0) == b;
    });
}
/// Snell's law: eta times the sine of incidence is the sine of refraction; nothing beyond.
template <class Refract>
testing::AssertionResult refracts(Refract refracted) {
    return holds([&](Random& random) {
        const V n = normalize(draw_vector(random));
        const V drawn = normalize(draw_vector(random));
        const V i = dot(drawn, n) > 0 ? -drawn : drawn;
        const D eta = random.uniform(0.5, 2);
        const D sine = eta * length(cross(i, n));
        const V out = refracted(i, n, eta);
        if (sine > 1) return out == V(0.0);
        return abs(length(out) - 1) < 1e-9 && abs(length(cross(out, n)) - sine) < 1e-9 &&
               dot(out, n) <= 0;
    });
}

TEST(Functions, NormalizeGivesUnitVectorsOfTheSameDirection) {
    EXPECT_TRUE(normalizes([](const V& v) { return normalize(v); }));
    EXPECT_NE(normalize(V(0.0)).x, normalize(V(0.0)).x);  // NaN
}
TEST(Functions, InverseUndoesTheMatrix) {
    EXPECT_TRUE(inverts([](const mat3<D>& m) { return inverse(m); }));
    const mat2<D> m(1.0, 2.0, 3.0, 4.0);
    EXPECT_EQ(inverse(m) * (m * vec2<D>(5.0, 6.0)), vec2<D>(5.0, 6.0));
}
TEST(Functions, MixHitsBothEnds) {
    EXPECT_TRUE(mixes([](D a, D b, D t) { return mix(a, b, t); }));
}
TEST(Functions, RefractObeysSnell) {
    EXPECT_TRUE(refracts([](const V& i, const V& n, D eta) { return refract(i, n, eta); }));
}
TEST(Functions, ReflectKeepsLengthAndFlipsTheNormalPart) {
    EXPECT_TRUE(holds([](Random& random) {
        const V n = normalize(draw_vector(random));
        const V i = draw_vector(random);
        const V r = reflect(i, n);
        return abs(length(r) - length(i)) < 1e-12 && abs(dot(r, n) + dot(i, n)) < 1e-12;
    }));
}
TEST(Functions, DeterminantIsTheVolumeAndTransposeKeepsIt) {
    EXPECT_TRUE(holds([](Random& random) {
        const mat3<D> m(draw_vector(random), draw_vector(random), draw_vector(random));
        return abs(determinant(m) - determinant(transpose(m))) < 1e-14 &&
               transpose(transpose(m)) == m;
    }));
    EXPECT_EQ(determinant(mat3<D>(2.0)), 8.0);
    EXPECT_EQ(outerProduct(V(1, 2, 3), V(4, 5, 6))[2], V(6, 12, 18));
}
TEST(Functions, MinMaxAndClampHaveTheWrittenRuleForNanAndZero) {
    const D nan = std::numeric_limits<D>::quiet_NaN();
    EXPECT_TRUE(is_nan(min(nan, 1.0)));
    EXPECT_EQ(min(1.0, nan), 1.0);
    EXPECT_TRUE(is_nan(max(nan, 1.0)));
    EXPECT_EQ(max(1.0, nan), 1.0);
    EXPECT_TRUE(is_nan(clamp(nan, 0.0, 1.0)));
    EXPECT_TRUE(std::signbit(min(-0.0, 0.0)));
    EXPECT_FALSE(std::signbit(min(0.0, -0.0)));
    EXPECT_EQ(sign(nan), 0.0);
}
TEST(Functions, SmoothstepRisesFromZeroToOne) {
    EXPECT_EQ(smoothstep(1.0, 2.0, 0.5), 0.0);
    EXPECT_EQ(smoothstep(1.0, 2.0, 1.5), 0.5);
    EXPECT_EQ(smoothstep(1.0, 2.0, 2.5), 1.0);
    EXPECT_EQ(mod(-0.25, 1.0), 0.75);
    EXPECT_EQ(fract(-0.25), 0.75);
    EXPECT_EQ(step(1.0, 1.0), 1.0);
}
TEST(Functions, PlainNumbersMixWithPackets) {
    using Q = Quad<float>;
    const Q x(-1.0f, 0.25f, 0.5f, 2.0f);
    EXPECT_TRUE(all(max(x, 0.0f) == max(x, Q(0.0f))));
    EXPECT_TRUE(all(clamp(x, 0, 1) == saturate(x)));
    EXPECT_TRUE(all(mix(1.0f, x, 0.5) == mix(Q(1.0f), x, Q(0.5f))));
    EXPECT_TRUE(all(select(x < 0.0f, 0.0f, x) == max(x, 0.0f)));
    const vec3<Q> v(x, x, Q(1.0f));
    EXPECT_TRUE(all((v * 0.5f + 0.5f).x == x * 0.5f + 0.5f));
    EXPECT_TRUE(all(mix(v, v * 2.0f, 0.25f).y == mix(x, x * 2.0f, Q(0.25f))));
}

TEST(Functions, CatchPlantedErrors) {
    EXPECT_FALSE(normalizes([](const V& v) { return v / dot(v, v); }))
        << static_cast<int>(Planted::normalize_without_root);
    EXPECT_FALSE(inverts([](const mat3<D>& m) { return transpose(inverse(m)); }))
        << static_cast<int>(Planted::inverse_without_transpose);
    EXPECT_FALSE(mixes([](D a, D b, D t) { return mix(b, a, t); }))
        << static_cast<int>(Planted::mix_swapped);
    EXPECT_FALSE(refracts([](const V& i, const V& n, D eta) {
        const D cosine = dot(n, i);
        const D k = 1 - eta * eta * (1 - cosine * cosine);
        return k < 0 ? V(0.0) : i * eta - n * (eta * cosine + k);
    })) << static_cast<int>(Planted::refract_without_root);
}

/// Whether two words hold what a product leaves, for factors in [scale, 2 scale).
testing::AssertionResult leaves_nothing(float scale) {
    return holds([&](Random& random) {
        const auto factor = [&] { return static_cast<float>(random.uniform(1, 2)) * scale; };
        const float a = factor(), b = factor();
        const DoubleWord<float> product = two_product(a, b);
        return static_cast<D>(product.hi) + static_cast<D>(product.lo) ==
               static_cast<D>(a) * static_cast<D>(b);
    });
}

/// So that one number is the error of an OrdinaryProduct, whichever instructions yield it.
TEST(Functions, ProductsAreExactUnlessTheirErrorUnderflows) {
    for (const float scale : {0x1p-50f, 0x1p-30f, 1.0f, 0x1p+40f}) {
        EXPECT_TRUE(leaves_nothing(scale)) << scale;
    }
    EXPECT_FALSE(leaves_nothing(0x1p-65f));
}

}  // namespace
}  // namespace quadrel::num_tests
