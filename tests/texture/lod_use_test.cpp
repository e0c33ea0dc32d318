// Records that look-ups take a shorter way to: they read what the record of compute_lod reads.
#include "texture/support.hpp"

namespace quadrel::test {
namespace {

using F = Quad<float>;
using Record =
    std::function<LodRecord<F>(const SampledTexture&, const vec2<F>&, const vec2<F>&, F bias)>;

LodRecord<F> for_look_ups(const SampledTexture& t, const vec2<F>& dx, const vec2<F>& dy, F bias) {
    return lod_for(LodUse::look_up, t, dx, dy, bias);
}

template <class T>
T any_of(std::initializer_list<T> of, std::mt19937& random) {
    return of.begin()[random() % of.size()];
}

SamplerState any_sampler(std::mt19937& random) {
    SamplerState s;
    s.mag = any_of({Filter::nearest, Filter::linear}, random);
    s.min = any_of({Filter::nearest, Filter::linear}, random);
    s.mip = any_of({MipFilter::none, MipFilter::nearest, MipFilter::linear}, random);
    s.lod_form = any_of(
        {LodForm::sqrt_max, LodForm::ellipse, LodForm::linear_log2, LodForm::quartic_log2}, random);
    s.lod_bits = any_of({0, 8}, random);
    s.lod_bias = any_of({0.0f, 0.0f, 1.5f, -1.0f}, random);
    s.lod_min = any_of({-1000.0f, 0.0f, 0.75f}, random);
    s.lod_max = any_of({-0.5f, 1.25f, 1000.0f}, random);
    return s;
}

/// A gradient in texels: of quads that are all magnified, of those that are all but so, and others.
float any_gradient(std::mt19937& random) {
    const float part = float(random() >> 8) * 0x1p-24f - 0.5f;
    return random() % 500 == 0 ? std::nanf("")
                               : part * any_of({0.0f, 1.0f, 1.4f, 2.0f, 9.0f}, random);
}

testing::AssertionResult reads_the_same(const Record& record) {
    std::mt19937 random(7);
    RandomTexture mipped(16, 32, 1), single(16, 1, 1);
    single.sampled.view.levels = 1;
    for (int i = 0; i < 20000; ++i) {
        SampledTexture& t = random() % 4 == 0 ? single.sampled : mipped.sampled;
        t.sampler = any_sampler(random);
        vec2<F> dx, dy, uv;
        F bias(0);
        for (int lane = 0; lane < 4; ++lane) {
            for (vec2<F>* v : {&dx, &dy}) {
                v->x.lane[lane] = any_gradient(random) / 16;
                v->y.lane[lane] = any_gradient(random) / float(t.view.height[0]);
            }
            uv.x.lane[lane] = float(random() % 1000) / 500;
            uv.y.lane[lane] = float(random() % 1000) / 500;
            if (random() % 4 == 0) bias.lane[lane] = any_of({-1.0f, 0.5f, 3.0f}, random);
        }
        const F want = sample_expanded(t, {}, uv, compute_lod(t, dx, dy, bias)).x;
        const F got = sample_expanded(t, {}, uv, record(t, dx, dy, bias)).x;
        if (!all(want == got)) return testing::AssertionFailure() << "sampler " << i;
    }
    return testing::AssertionSuccess();
}

TEST(LodUse, LookUpsReadWhatTheShownRecordSays) { EXPECT_TRUE(reads_the_same(for_look_ups)); }

TEST(LodUse, PlantedErrorsAreCaught) {
    const auto shortcut = [](auto&& is_finest) {
        return [=](const SampledTexture& t, const vec2<F>& dx, const vec2<F>& dy, F bias) {
            const Gradients<F> texels = texel_gradients<F>(t, {dx, dy});
            const F square = largest_square(texels.x, texels.y);
            return is_finest(t, square, total_bias(t, bias)) ? finest_lod<F>()
                                                             : compute_lod(t, dx, dy, bias);
        };
    };
    // One level, but two filters.
    EXPECT_FALSE(reads_the_same(shortcut([](const SampledTexture& t, F, F) {
        return t.sampler.mip == MipFilter::none || t.view.levels == 1;
    })));
    // The bias, the least level, the other form of the scale factor forgotten.
    EXPECT_FALSE(reads_the_same(shortcut([](const SampledTexture& t, F square, F) {
        return t.sampler.lod_form != LodForm::ellipse && t.sampler.lod_min <= 0 &&
               all(square <= F(1));
    })));
    EXPECT_FALSE(reads_the_same(shortcut([](const SampledTexture& t, F square, F total) {
        return t.sampler.lod_form != LodForm::ellipse && all((square <= F(1)) & (total <= F(0)));
    })));
    EXPECT_FALSE(reads_the_same(shortcut([](const SampledTexture& t, F square, F total) {
        return t.sampler.lod_min <= 0 && all((square <= F(1)) & (total <= F(0)));
    })));
    // One lane magnified for all.
    EXPECT_FALSE(reads_the_same(shortcut([](const SampledTexture& t, F square, F total) {
        return t.sampler.lod_form != LodForm::ellipse && t.sampler.lod_min <= 0 &&
               any((square <= F(1)) & (total <= F(0)));
    })));
}

}  // namespace
}  // namespace quadrel::test
