// Baking maps on one thread: fields that are easy and fields that are hard for a search.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>

#include "quadrel/bake/bake.hpp"
#include "support/clock.hpp"

namespace quadrel::bench {
namespace {

using Height = float (*)(int i, int j, int side, std::mt19937& random);

struct Field {
    const char* name;
    Height height;
};

/// Every texel apart; one in a thousand raised; a single one raised; terraces.
constexpr Field fields[] = {
    {"noise", [](int, int, int,
                 std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24f; }},
    {"spikes",
     [](int, int, int, std::mt19937& random) { return random() % 1000 == 0 ? 1.0f : 0.0f; }},
    {"impulse", [](int i, int j, int side,
                   std::mt19937&) { return i == side / 2 && j == side / 2 ? 1.0f : 0.0f; }},
    {"terraces", [](int i, int j, int side, std::mt19937&) {
         return static_cast<float>(16 * (i + j) / side) / 32.0f;
     }}};

std::shared_ptr<const Texture> make_field(const Field& field, int side) {
    std::mt19937 random(1);
    Image image;
    image.width = image.height = side;
    image.channels = 1;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) image.values.push_back(field.height(i, j, side, random));
    TextureOptions options;
    options.mip_rule = MipRule::none;
    return make_texture(image, options);
}

void bake_field(benchmark::State& state, const Field& field, BakeKind kind, int side) {
    const auto heights = make_field(field, side);
    BakeOptions options;
    options.threads = 1;
    Least least;
    for (auto _ : state) {
        const double time = timed(CLOCK_PROCESS_CPUTIME_ID, [&] {
            benchmark::DoNotOptimize(bake(*heights, kind, SamplerState(), options));
        });
        state.SetIterationTime(time);
        least.add(time);
    }
    state.counters["least_ms"] = 1e3 * least.value();
    state.counters["estimate_ms"] = 1e3 * bake_seconds_estimate(kind, side, side);
}

/// Kinds whose time grows faster than the map, or that are slow, are measured at the largest side
/// that is quick enough to repeat: hard fields take up to a hundred times as long as the estimate
/// says.
int side_of(BakeKind kind) {
    int side = 1024;
    const auto seconds = [&](int n) { return bake_seconds_estimate(kind, n, n); };
    if (seconds(1024) < std::min(5 * seconds(512), 3.0)) return side;
    while (seconds(side) > 0.425) side /= 2;
    return side;
}

const bool registered = [] {
    for (const BakeKindInfo& info : bake_kinds()) {
        const int side = side_of(info.kind);
        for (const Field& field : fields) {
            const std::string name =
                std::string("bake/") + info.name + "/" + field.name + "/" + std::to_string(side);
            benchmark::RegisterBenchmark(name.c_str(), bake_field, field, info.kind, side)
                ->UseManualTime()
                ->Iterations(3)
                ->Unit(benchmark::kMillisecond);
        }
    }
    return true;
}();

}  // namespace
}  // namespace quadrel::bench
