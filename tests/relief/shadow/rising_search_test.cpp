// shadow-exact where no one counts its steps, by a pyramid: dark where the walk of all cells is.
#include "effort.hpp"
#include "quadrel/relief/shadow/exact.hpp"
#include "relief/shadow/lit_batch.hpp"

namespace quadrel::test {
namespace {

/// A stage, steps and look-ups neither asked for nor counted.
template <class Stage, class F>
void run_uncounted(const StageCall* call) {
    StageCall uncounted = *call;
    uncounted.counters = nullptr;
    run_stage<Stage, F>(&uncounted);
}

/// By one kind of axis, whatever the map, and of the parts named.
template <template <class> class Axis, template <class> class Levels = PyramidLevels>
struct RisingOf {
    template <Number F, class Leaf>
    static void run(CellSearch<F>& search, const SampledTexture& map, const RisingHeight<F>& height,
                    F s, const Leaf& leaf) {
        RisingSearch<F, Axis<F>, Levels<F>>(search, map, height).run(s, leaf);
    }
};
/// Takes the ray for a little higher than it is.
struct TooHigh {
    template <Number F, class Leaf>
    static void run(CellSearch<F>& search, const SampledTexture& map, const RisingHeight<F>& height,
                    F s, const Leaf& leaf) {
        RisingByPyramid::run(search, map, RisingHeight<F>{height.z + F(0.02f), height.rise}, s,
                             leaf);
    }
};
/// Nodes without a greatest height count as low.
template <Number F>
struct UnknownIsLow : PyramidLevels<F> {
    using PyramidLevels<F>::PyramidLevels;
    F height(Int<F> level, Int<F> index) const {
        const F h = PyramidLevels<F>::height(level, index);
        return select(is_nan(h), F(0), h);
    }
};
/// Leaves nodes a cell too late.
template <Number F>
struct LongNodes : PowerOfTwoAxis<F> {
    using PowerOfTwoAxis<F>::PowerOfTwoAxis;
    NodeSpan<F> node(Int<F> cell, Int<F> level) const {
        NodeSpan<F> span = PowerOfTwoAxis<F>::node(cell, level);
        span.ahead = span.ahead + Int<F>(1);
        return span;
    }
};

/// Hits with a map, and another of that size that throws the shadows, some of its heights no
/// numbers or out of [0, 1].
struct LitMaps {
    ExactMaps hit, shadow;

    LitMaps(Random& random, const StressMap& kind, bool powers_of_two)
        : hit(some_map(random, kind, powers_of_two), {}),
          shadow(broken(random, hit.height), {TextureSlot::max_mip}) {}

    static Map some_map(Random& random, const StressMap& kind, bool powers_of_two) {
        if (!powers_of_two) return random_stress_map(random, kind, 40);
        SamplerState sampler = plain_sampler();
        for (Wrap* const wrap : {&sampler.wrap_u, &sampler.wrap_v})
            *wrap = random.chance(0.3) ? Wrap::mirrored_repeat : Wrap::repeat;
        return make_stress_map(kind, 1 << random.below(6), 1 << random.below(6), sampler, random);
    }
    static Map broken(Random& random, const Map& map) {
        const TextureView& view = map.texture->view();
        const bool breaks = random.chance(0.4);
        return make_map(
            view.width[0], view.height[0], 1,
            [&](int x, int y, int) {
                const float h = view.texels[y * view.width[0] + x];
                if (!breaks || random.chance(0.95)) return h;
                return random.chance(0.5) ? std::numeric_limits<float>::quiet_NaN() : 9 * h - 4;
            },
            map.sampled.sampler);
    }
};

template <PlainFloat T>
testing::AssertionResult agrees_on(Batch<T> rays, const LitMaps& maps, StageFunction quick) {
    maps.shadow.bind(rays);
    Batch<T> other = rays;
    rays.run("shadow-exact");
    other.want(Value::shadow_steps, false);
    constexpr NoParams no_params;
    other.run(quick, &no_params);
    return same_bits<T>(rays, other, values(Value::shadow_visibility));
}

/// Under lights from nearly level to overhead.
template <PlainFloat T>
testing::AssertionResult agrees(StageFunction quick, bool powers_of_two, int batches = rounds(2)) {
    for (const StressMap& kind : stress_maps())
        for (int i = 0; i < batches; ++i) {
            Random random(static_cast<std::uint64_t>(i) + 300);
            const LitMaps maps(random, kind, powers_of_two);
            LitBatch lit(maps.hit.height, i);
            lit.light(random.uniform(0, 6.28), random.chance(0.2) ? 0.002 : random.uniform(0, 1.3));
            const auto result = agrees_on<T>(in_number<T>(lit.batch), maps, quick);
            if (!result)
                return testing::AssertionFailure()
                       << kind.name << ", batch " << i << ": " << result.message();
        }
    return testing::AssertionSuccess();
}

TEST(RisingSearch, IsDarkWhereTheWalkIs) {
    for (const bool powers_of_two : {false, true}) {
        EXPECT_TRUE(agrees<float>(run_uncounted<ShadowExact, Quad<float>>, powers_of_two));
        EXPECT_TRUE(agrees<double>(run_uncounted<ShadowExact, Quad<double>>, powers_of_two));
    }
    using Any = ShadowExactBy<RisingOf<AnyAxis>>;
    EXPECT_TRUE(agrees<float>(run_uncounted<Any, Quad<float>>, true));
}

TEST(RisingSearch, PlantedErrorsAreCaught) {
    using F = Quad<float>;
    EXPECT_FALSE(agrees<float>(run_uncounted<ShadowExactBy<TooHigh>, F>, true, 4));
    using LowUnknowns = ShadowExactBy<RisingOf<PowerOfTwoAxis, UnknownIsLow>>;
    EXPECT_FALSE(agrees<float>(run_uncounted<LowUnknowns, F>, true, 4));
    EXPECT_FALSE(agrees<float>(run_uncounted<ShadowExactBy<RisingOf<LongNodes>>, F>, true, 4));
}

/// Who asks for steps gets those of the walk.
TEST(RisingSearch, CountsAreTheWalks) {
    Random random(5);
    const LitMaps maps(random, stress_maps().back(), true);
    LitBatch lit(maps.hit.height, 2);
    maps.shadow.bind(lit.batch);
    Batch<float> asked = lit.batch;
    lit.batch.run("shadow-exact");
    constexpr NoParams no_params;
    constexpr auto counts = values(Value::shadow_steps);
    asked.run(run_uncounted<ShadowExact, Quad<float>>, &no_params);
    EXPECT_TRUE(same_bits<float>(lit.batch, asked, counts));
}

}  // namespace
}  // namespace quadrel::test
