// Which footprint maps are filtered with at the hit: of the undisplaced coordinate, or of the
// displaced one where a scene asks for it.
#include <algorithm>

#include "relief/stage_inputs.hpp"
#include "relief/tangent_listings.hpp"

namespace quadrel::test::tangent {
namespace {

bool asks(const StageInfo& stage) {
    return std::any_of(stage.parameters.begin(), stage.parameters.end(),
                       [](const ParameterText& p) { return p.name == std::string("gradients"); });
}

constexpr TextureSlot mapped[] = {TextureSlot::color, TextureSlot::gloss, TextureSlot::emissive,
                                  TextureSlot::normal};

/// Fragments whose hits jump, over maps with levels.
struct Jumps {
    Batch<float> batch;
    std::array<Map, std::size(mapped)> maps;

    explicit Jumps(int seed) : batch(StageInputs(seed).batch) {
        Random random(static_cast<std::uint64_t>(seed));
        for (std::size_t i = 0; i < maps.size(); ++i) {
            maps[i] = mip_map(random, 4);
            batch.bind(mapped[i], maps[i].sampled);
        }
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const dvec2 jump(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
            batch.set(Value::hit_uv, lane, dvec2(batch.vector2(Value::uv, lane)) + jump);
        }
    }
    Jumps(const Jumps&) = delete;
};

/// Puts the differences of the displaced coordinate in the place of the undisplaced one's.
void displace_gradients(Batch<float>& batch) {
    for (int quad = 0; quad < batch.lanes / 4; ++quad) {
        const Vec2 uv = lanes2(batch, Value::hit_uv, quad), dx = dFdx(uv), dy = dFdy(uv);
        for (int i = 0; i < 4; ++i)
            for (int c = 0; c < 2; ++c) {
                batch.real(Value::dUVdx, 4 * quad + i, c) = dx[c].lane[i];
                batch.real(Value::dUVdy, 4 * quad + i, c) = dy[c].lane[i];
            }
    }
}

/// The stage, told `gradients`, gives what it gives by default with the displaced differences.
testing::AssertionResult takes_the_displaced(const StageInfo& stage, double gradients) {
    for (int seed = 20; seed < 22; ++seed) {
        Jumps jumps(seed);
        Batch<float> told = jumps.batch, given = jumps.batch;
        told.run(stage.text.id, {{"gradients", gradients}});
        displace_gradients(given);
        given.run(stage.text.id);
        const auto same = same_bits<float>(told, given, stage.outputs);
        if (!same) return testing::AssertionFailure() << stage.text.id << ": " << same.message();
    }
    return testing::AssertionSuccess();
}

TEST(MapGradients, AreTheDisplacedOnesWhereAskedFor) {
    int stages = 0;
    for (const StageInfo& stage : all_stages()) {
        if (!asks(stage)) continue;
        ++stages;
        EXPECT_FALSE(takes_the_displaced(stage, 0)) << stage.text.id;
        // It looks up another coordinate as well, which has differences of its own.
        if (stage.text.id == std::string("normal-smooth-mcguire")) continue;
        EXPECT_TRUE(takes_the_displaced(stage, 1));
    }
    EXPECT_GE(stages, 11);
}

}  // namespace
}  // namespace quadrel::test::tangent
