// The march against greatest heights: never late, whatever the map, and close where steps are
// short.
#include "effort.hpp"
#include "quadrel/bake/bake.hpp"
#include "relief/surface_rays.hpp"

namespace quadrel::test {
namespace {

constexpr int brute_steps = 20000;

/// Walls and spikes one texel wide over 3 to 20 texels a side, every wrap mode, any angle.
struct SpikeInputs {
    Random random;
    Map map, pyramid;
    Batch<float> batch;

    explicit SpikeInputs(int seed) : random(static_cast<std::uint64_t>(seed)), batch(32) {
        const auto spike = [this](int, int) {
            return random.chance(0.1) ? static_cast<float>(random.uniform(0.5, 1)) : 0.1f;
        };
        map = height_map(3 + random.below(18), 3 + random.below(18), spike,
                         static_cast<Wrap>(seed % 5));
        pyramid.texture = bake(*map.texture, BakeKind::max_mip, map.sampled.sampler);
        pyramid.sampled = {pyramid.texture->view(), map.sampled.sampler};
        fill_surface(batch, random, {0.1});
        batch.material.seat = static_cast<float>(random.below(3)) / 2;
        batch.bind(TextureSlot::height, map.sampled);
        batch.bind(TextureSlot::max_mip, pyramid.sampled);
    }

    /// s of the first of many samples in double that is below, 2 if none is.
    std::vector<double> crossings() {
        Batch<double> wide(batch.lanes);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            for (const Value v : {Value::uv, Value::K, Value::dUVdx, Value::dUVdy})
                wide.set(v, lane, batch.vector2(v, lane));
            wide.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
            wide.integer(Value::frame_flags, lane) = 0;
        }
        wide.material = batch.material;
        wide.bind(TextureSlot::height, map.sampled);
        wide.run("linear", {{"steps", brute_steps}});
        std::vector<double> s;
        for (int lane = 0; lane < batch.lanes; ++lane) s.push_back(wide.real(Value::hit_s, lane));
        return s;
    }
};

testing::AssertionResult never_late(const std::string& id, int maps) {
    for (int i = 0; i < maps; ++i) {
        SpikeInputs inputs(i);
        const std::vector<double> crossings = inputs.crossings();
        for (const int n : {1, 8, 64}) {
            inputs.batch.run(id, {{"steps", n}});
            for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
                const double s = inputs.batch.real(Value::hit_s, lane);
                const double late = s - crossings[static_cast<std::size_t>(lane)];
                const int status = inputs.batch.integer(Value::hit_status, lane);
                if (late < 1e-5 && status == static_cast<int>(Status::hit)) continue;
                return testing::AssertionFailure()
                       << late << " late, map " << i << ", lane " << lane << ", steps " << n;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(SteepMaxmip, IsNeverLate) {
    EXPECT_TRUE(never_late("steep-maxmip", rounds(10)));
    EXPECT_FALSE(never_late("linear", 3));
    EXPECT_FALSE(never_late("steep-mip-i", 3));
}

/// A pyramid that leaves out the last row and column of cells, or that knows no wrap mode, is late.
TEST(SteepMaxmip, NeedsTheMapsOfItsWrapMode) {
    SpikeInputs inputs(0);
    const auto pyramid = [&](Wrap wrap) {
        SamplerState sampler = inputs.map.sampled.sampler;
        sampler.wrap_u = sampler.wrap_v = wrap;
        return bake(*inputs.map.texture, BakeKind::max_mip, sampler);
    };
    const auto clamped = pyramid(Wrap::clamp_to_edge);
    const SampledTexture wrong{clamped->view(), inputs.map.sampled.sampler};
    Batch<float> other = inputs.batch;
    other.bind(TextureSlot::max_mip, wrong);
    inputs.batch.run("steep-maxmip");
    other.run("steep-maxmip");
    constexpr auto s = values(Value::hit_s);
    EXPECT_FALSE(same_bits<float>(inputs.batch, other, s));
}

/// Over smooth maps early by what the field varies over two nodes, less the shorter the steps.
TEST(SteepMaxmip, IsCloseWhereStepsAreShort) {
    Random random(1);
    const Map map = height_map(64, 64, [](int x, int y) {
        return static_cast<float>(std::abs(x - 32) + std::abs(y - 32)) / 128 + 0.25f;
    });
    const auto texels = bake(*map.texture, BakeKind::max_mip, map.sampled.sampler);
    const SampledTexture pyramid{texels->view(), map.sampled.sampler};
    Batch<float> batch(64);
    fill_surface(batch, random, {0.4});
    batch.bind(TextureSlot::height, map.sampled);
    batch.bind(TextureSlot::max_mip, pyramid);
    Batch<float> truth = batch;
    truth.run("linear", {{"steps", brute_steps}});
    double before = 1;
    for (const int n : {4, 16, 64, 256}) {
        batch.run("steep-maxmip", {{"steps", n}});
        double earliest = 0;
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const double early = truth.real(Value::hit_s, lane) - batch.real(Value::hit_s, lane);
            earliest = std::max(earliest, early);
        }
        EXPECT_LT(earliest, before) << n;
        before = earliest;
    }
    EXPECT_LT(before, 0.06);
}

TEST(SteepMaxmip, CountsNineNodesAStep) {
    SpikeInputs inputs(3);
    inputs.batch.run("steep-maxmip");
    std::uint64_t fetches = 0;
    for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
        EXPECT_EQ(inputs.batch.integer(Value::hit_fetches, lane),
                  9 * inputs.batch.integer(Value::hit_steps, lane));
        fetches += static_cast<std::uint64_t>(inputs.batch.integer(Value::hit_fetches, lane));
    }
    EXPECT_EQ(fetches, inputs.batch.fetches());
}

}  // namespace
}  // namespace quadrel::test
