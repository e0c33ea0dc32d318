// Searches of a pyramid that no one counts the steps of: the hits of those that are counted.
#include "effort.hpp"
#include "quadrel/relief/trace/exact/pyramid.hpp"
#include "quadrel/relief/trace/exact/qdm.hpp"
#include "relief/exact/exact_flaws.hpp"

namespace quadrel::test {
namespace {

/// A stage, steps and look-ups neither asked for nor counted.
template <class Stage, class F>
void run_uncounted(const StageCall* call) {
    StageCall uncounted = *call;
    uncounted.counters = nullptr;
    run_stage<Stage, F>(&uncounted);
}

/// max-mip by the quick search alone, made of the parts named.
template <template <class> class Axis, template <class> class Levels = PyramidLevels,
          class Wait = Waiting>
struct QuickMaxMip : MaxMip {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        QuickPyramidSearch<F, Axis<F>, Levels<F>, Wait> quick(
            search, *io.template texture<TextureSlot::max_mip>());
        quick.run([&](Mask<F> mask, const CellExit<F>& exit, F) { search.test(mask, exit); });
        search.store();
    }
};

/// Loses the highest bit of where a node is stored.
template <Number F>
struct WrongMask : PowerOfTwoAxis<F> {
    using PowerOfTwoAxis<F>::PowerOfTwoAxis;
    NodeSpan<F> node(Int<F> cell, Int<F> level) const {
        NodeSpan<F> span = PowerOfTwoAxis<F>::node(cell, level);
        span.index = shift_right(this->mirrored(cell) & Int<F>(7), level);
        return span;
    }
};
/// Nodes without a greatest height count as low.
template <Number F>
struct NanIsLow : PyramidLevels<F> {
    using PyramidLevels<F>::PyramidLevels;
    F height(Int<F> level, Int<F> index) const {
        const F h = PyramidLevels<F>::height(level, index);
        return select(is_nan(h), F(0), h);
    }
};
/// Lanes go on when testing does not pay.
struct Impatient : Waiting {
    template <class M>
    static M held(const M&) {
        return M(false);
    }
};

enum class Sizes { any, powers_of_two };

/// `breaks`: with heights that are no numbers.
ExactMaps varied_maps(Random& random, const StressMap& kind, Sizes sizes, bool breaks) {
    const StressMap broken{kind.name, [&](int x, int y, int n, Random& r) {
                               const bool here = breaks && r.chance(0.02);
                               return here ? std::numeric_limits<float>::quiet_NaN()
                                           : kind.height(x, y, n, r);
                           }};
    const auto pyramids = {TextureSlot::max_mip, TextureSlot::texel_max};
    if (sizes == Sizes::any) return ExactMaps(random_stress_map(random, broken), pyramids);
    SamplerState sampler = plain_sampler();
    for (Wrap* const wrap : {&sampler.wrap_u, &sampler.wrap_v})
        *wrap = random.chance(0.3) ? Wrap::mirrored_repeat : Wrap::repeat;
    const int width = 1 << random.below(7), height = 1 << random.below(7);
    return ExactMaps(make_stress_map(broken, width, height, sampler, random), pyramids);
}

/// The same hits and flags as `row` has when it counts.
template <PlainFloat T>
testing::AssertionResult agrees_on(Batch<T> rays, const ExactMaps& maps, StageFunction quick,
                                   const char* row, const void* params) {
    maps.bind(rays);
    Batch<T> other = rays;
    rays.run(row);
    for (const Value v : {Value::hit_steps, Value::hit_fetches}) other.want(v, false);
    other.run(quick, params);
    return same_bits<T>(rays, other, agreed_values);
}

constexpr NoParams no_params;

/// On random rays, whatever the map.
template <PlainFloat T>
testing::AssertionResult agrees(StageFunction quick, Sizes sizes, const char* row = "max-mip",
                                const void* params = &no_params, int batches = rounds(6)) {
    for (const StressMap& kind : stress_maps()) {
        for (int i = 0; i < batches; ++i) {
            Random random(static_cast<std::uint64_t>(i) + 90);
            const ExactMaps maps = varied_maps(random, kind, sizes, i % 3 == 0);
            Batch<float> rays(64);
            fill_stress_rays(rays, maps.height, random);
            Batch<T> batch = in_number<T>(rays);
            batch.material.seat = static_cast<float>(random.below(5)) / 4;
            const auto result = agrees_on<T>(batch, maps, quick, row, params);
            if (!result)
                return testing::AssertionFailure()
                       << row << ", " << kind.name << ", batch " << i << ": " << result.message();
        }
    }
    return testing::AssertionSuccess();
}

/// So far from where rays begin that positions are off by a hundredth of a cell. (What that does is
/// seen in cell_ray_test: hits show it once in a hundred thousand rays.)
testing::AssertionResult agrees_far_away(StageFunction quick) {
    Random random(17);
    const ExactMaps maps(
        height_map(64, 64, [&](int, int) { return float(random.below(256)) / 1024; }),
        {TextureSlot::max_mip});
    for (int i = 0; i < rounds(2); ++i) {
        Batch<float> rays(32);
        fill_stress_rays(rays, maps.height, random);
        for (int lane = 0; lane < rays.lanes; ++lane)
            rays.set(Value::K, lane, dvec2(random.uniform(600, 1000), random.uniform(-1000, -600)));
        const auto result = agrees_on<float>(rays, maps, quick, "max-mip", &no_params);
        if (!result) return result;
    }
    return testing::AssertionSuccess();
}

TEST(QuickPyramid, HasTheHitsOfTheCountedSearch) {
    EXPECT_TRUE(agrees<float>(run_uncounted<MaxMip, Quad<float>>, Sizes::any));
    EXPECT_TRUE(agrees<double>(run_uncounted<MaxMip, Quad<double>>, Sizes::any));
    EXPECT_TRUE(agrees<float>(run_uncounted<MaxMip, Quad<float>>, Sizes::powers_of_two));
    EXPECT_TRUE(agrees<double>(run_uncounted<MaxMip, Quad<double>>, Sizes::powers_of_two));
    EXPECT_TRUE(agrees_far_away(run_uncounted<MaxMip, Quad<float>>));
}

TEST(QuickPyramid, OfBlocksToo) {
    for (const std::int32_t ascent : {0, 1}) {
        const Qdm::Params params{ascent};
        for (const Sizes sizes : {Sizes::any, Sizes::powers_of_two})
            EXPECT_TRUE(agrees<float>(run_uncounted<Qdm, Quad<float>>, sizes, "qdm", &params));
    }
    EXPECT_TRUE(agrees<double>(run_uncounted<Pyramid, Quad<double>>, Sizes::any, "pyramid"));
}

/// Both ways to find a node.
TEST(QuickPyramid, MasksAndShiftsAgreeWithAnyAxis) {
    using F = Quad<float>;
    const Sizes powers = Sizes::powers_of_two;
    EXPECT_TRUE(agrees<float>(run_stage<QuickMaxMip<AnyAxis>, F>, powers));
    EXPECT_TRUE(agrees<float>(run_stage<QuickMaxMip<PowerOfTwoAxis>, F>, powers));
}

TEST(QuickPyramid, PlantedErrorsAreCaught) {
    using F = Quad<float>;
    // With few rays only: in time it reads beyond the map.
    EXPECT_FALSE(agrees<float>(run_stage<QuickMaxMip<WrongMask>, F>, Sizes::powers_of_two));
    // As many batches under the sanitizers, too: the first do not show every error.
    const auto passes = [](StageFunction quick) {
        return agrees<float>(quick, Sizes::powers_of_two, "max-mip", &no_params, 6);
    };
    EXPECT_FALSE(passes(run_stage<QuickMaxMip<PowerOfTwoAxis, NanIsLow>, F>));
    EXPECT_FALSE(passes(run_stage<QuickMaxMip<PowerOfTwoAxis, PyramidLevels, Impatient>, F>));
}

/// Where no one asks for flags, grazes are not told, and nothing else differs.
TEST(QuickPyramid, FlagsThatNoOneAsksForChangeNothing) {
    Random random(6);
    const ExactMaps maps = varied_maps(random, stress_maps().front(), Sizes::any, true);
    Batch<float> rays(64);
    fill_stress_rays(rays, maps.height, random);
    maps.bind(rays);
    Batch<float> silent = rays;
    silent.want(Value::hit_flags, false);
    rays.run("max-mip");
    silent.run("max-mip");
    constexpr auto others = values(Value::hit_uv, Value::hit_s, Value::hit_h, Value::hit_depth,
                                   Value::hit_status, Value::hit_steps);
    EXPECT_TRUE(same_bits<float>(rays, silent, others));
    EXPECT_FALSE(same_bits<float>(rays, silent, values(Value::hit_flags)));
}

/// A render that asks for counts is not searched quickly.
TEST(QuickPyramid, CountsAreTheSources) {
    Random random(5);
    const ExactMaps maps = varied_maps(random, stress_maps().back(), Sizes::powers_of_two, false);
    Batch<float> rays(64);
    fill_stress_rays(rays, maps.height, random);
    maps.bind(rays);
    Batch<float> asked = rays, counted = rays;
    asked.run(run_uncounted<MaxMip, Quad<float>>, &no_params);
    counted.run("max-mip");
    constexpr auto counts = values(Value::hit_steps, Value::hit_fetches);
    EXPECT_TRUE(same_bits<float>(asked, counted, counts));
    Batch<float> quick = rays;
    quick.run(run_stage<QuickMaxMip<PowerOfTwoAxis>, Quad<float>>, &no_params);
    EXPECT_FALSE(same_bits<float>(quick, counted, counts));
}

}  // namespace
}  // namespace quadrel::test
