// Every instruction set gives the bits of Quad<float>, for every sampler state, at coordinates that
// include NaN, infinities and numbers far outside.
#include <dlfcn.h>

#include <bit>
#include <cstring>

#include "texture/modules/sweep.hpp"
#include "texture/planted.hpp"
#include "texture/support.hpp"

namespace quadrel::test {
namespace {

bool runs_here(const std::string& isa) {
#if defined(__x86_64__)
    if (isa == "sse4") return __builtin_cpu_supports("sse4.2");
    if (isa == "avx2") return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq");
#else
    return isa == "neon";
#endif
}

SweepFunction* open_sweep(const std::string& isa) {
    const std::string file =
        std::string(QUADREL_TEST_MODULE_DIR) + "/quadrel-texture-sweep-" + isa + ".so";
    void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) return nullptr;
    return reinterpret_cast<SweepFunction*>(dlsym(module, "quadrel_texture_sweep"));
}

void sweep_reference(SweepRequest* request) { sweep<Quad<float>>(*request); }

constexpr int sweep_lanes = 128;

struct Sweep {
    std::vector<float> input, output;
    RandomTexture flat, height, cube;
    FetchCounters counters;

    Sweep(std::uint32_t seed, int width, int height_, int channels)
        : input(sweep_inputs * sweep_lanes),
          output(sweep_outputs * sweep_lanes),
          flat(width, height_, channels, 1, seed),
          height(width, height_, 1, 1, seed + 1),
          cube(std::min(width, 8), std::min(width, 8), 4, 6, seed + 2) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> uniform(-1, 1), exponent(-6, 3);
        for (int i = 0; i < sweep_inputs * sweep_lanes; ++i) {
            const int array = i / sweep_lanes;
            const float size = array >= 3 ? std::exp2(exponent(random)) / 8 : 3;
            input[i] = uniform(random) * size;
            if (random() % 32 == 0) input[i] = std::round(input[i] * 8) / 8;
            if (random() % 256 == 0) input[i] = odd_number(random() % 8);
        }
    }

    static float odd_number(unsigned which) {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const float odd[] = {std::numeric_limits<float>::quiet_NaN(),
                             infinity,
                             -infinity,
                             1e30f,
                             -1e30f,
                             0,
                             -0.0f,
                             std::nextafter(1.0f, 0.0f)};
        return odd[which];
    }

    std::int32_t run(SweepFunction* function) {
        counters = {};
        SweepRequest request{
            &flat.sampled, &height.sampled, &cube.sampled, {}, {}, sweep_lanes, &counters, 0};
        for (int i = 0; i < sweep_inputs; ++i) request.input[i] = &input[i * sweep_lanes];
        for (int i = 0; i < sweep_outputs; ++i) request.output[i] = &output[i * sweep_lanes];
        function(&request);
        return request.lanes;
    }
};

/// All NaNs sweep_lanes as one value.
std::uint32_t bits(float x) { return x != x ? 0x7fc00000u : std::bit_cast<std::uint32_t>(x); }

testing::AssertionResult equal_bits(const Sweep& a, const std::vector<float>& want,
                                    const FetchCounters& counters) {
    for (std::size_t i = 0; i < want.size(); ++i) {
        if (bits(a.output[i]) == bits(want[i])) continue;
        return testing::AssertionFailure()
               << "output " << i / sweep_lanes << " lane " << i % sweep_lanes << ": " << a.output[i]
               << ", want " << want[i];
    }
    if (std::memcmp(&counters, &a.counters, sizeof counters) != 0) {
        return testing::AssertionFailure() << "counters differ";
    }
    return testing::AssertionSuccess();
}

/// Sets the samplers to combination `index` of wraps, filters and mips, and to one of each mode.
void choose_state(Sweep& s, int index) {
    SamplerState& state = s.flat.sampled.sampler;
    state.wrap_u = all_wraps[index % 5];
    state.wrap_v = all_wraps[index / 5 % 5];
    state.mag = static_cast<Filter>(index / 25 % 2);
    state.min = static_cast<Filter>(index / 50 % 2);
    state.mip = static_cast<MipFilter>(index / 100 % 3);
    state.lod_form = static_cast<LodForm>(index % 4);
    state.weight_bits = index % 3 == 0 ? 8 : 0;
    state.lod_bits = index % 7 == 0 ? 8 : 0;
    state.scale_first = index % 2;
    state.quad_lod = index / 2 % 2;
    state.level_rounding = static_cast<LevelRounding>(index / 4 % 2);
    state.border[0] = state.border[2] = -3;
    s.height.sampled.sampler = s.cube.sampled.sampler = state;
}

constexpr int combinations = 300;

testing::AssertionResult gives_the_same_bits(SweepFunction* function, int width) {
    constexpr int sizes[][3] = {{16, 16, 4}, {1, 1, 1}, {1, 9, 2}, {13, 6, 4}, {32, 16, 1}};
    for (int index = 0; index < combinations; ++index) {
        const auto [w, h, channels] = sizes[index % 5];
        Sweep s(static_cast<std::uint32_t>(index), w, h, channels);
        choose_state(s, index * 7 % combinations);
        s.run(sweep_reference);
        const std::vector<float> want = s.output;
        const FetchCounters counters = s.counters;
        std::fill(s.output.begin(), s.output.end(), -1.0f);
        if (s.run(function) != width) return testing::AssertionFailure() << "lanes";
        const auto result = equal_bits(s, want, counters);
        if (!result)
            return testing::AssertionFailure() << "state " << index << ": " << result.message();
    }
    return testing::AssertionSuccess();
}

TEST(InstructionSets, SameBits) {
    for (const auto& [isa, width] : {std::pair("sse4", 4), std::pair("avx2", 8),
                                     std::pair("avx512", 16), std::pair("neon", 4)}) {
        SweepFunction* const function = runs_here(isa) ? open_sweep(isa) : nullptr;
        if (function == nullptr) continue;
        EXPECT_TRUE(gives_the_same_bits(function, width)) << isa;
    }
}

TEST(InstructionSets, DifferencesAreCaught) {
    EXPECT_TRUE(gives_the_same_bits(sweep_reference, 4));
    EXPECT_FALSE(gives_the_same_bits(  // one lane, one output, one unit in the last place
        [](SweepRequest* request) {
            sweep_reference(request);
            float& value = request->output[34][100];
            value = std::nextafter(value, 10.0f);
        },
        4));
    EXPECT_FALSE(gives_the_same_bits(  // an event not counted
        [](SweepRequest* request) {
            sweep_reference(request);
            --request->counters->fetches;
        },
        4));
}

}  // namespace
}  // namespace quadrel::test
