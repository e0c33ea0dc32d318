// Searches of the field of blocks against the oracle and one another.
#include "relief/exact/exact_flaws.hpp"

namespace quadrel::test {
namespace {

using Check = std::function<testing::AssertionResult(const oracle::Field&, Batch<float>&)>;

testing::AssertionResult on_maps(const Check& check) {
    for (const StressMap& kind : stress_maps()) {
        for (int i = 0; i < 3; ++i) {
            Random random(static_cast<std::uint64_t>(i) + 40);
            const ExactMaps maps = random_exact_maps(random, kind);
            Batch<float> rays;
            fill_stress_rays(rays, maps.height, random);
            maps.bind(rays);
            const auto result = check(oracle::Field(maps.height.sampled), rays);
            if (!result) {
                return testing::AssertionFailure()
                       << kind.name << ", batch " << i << ": " << result.message();
            }
        }
    }
    return testing::AssertionSuccess();
}

/// Whatever the ascent, the same hits.
testing::AssertionResult ascents_agree(const std::function<void(Batch<float>&)>& change) {
    return on_maps([&](const oracle::Field&, Batch<float>& rays) {
        Batch<float> once = rays;
        once.run("qdm");
        for (const int ascent : {0, 2}) {
            Batch<float> other = rays;
            other.run("qdm", {{"ascent", ascent}});
            change(other);
            const auto result = same_bits<float>(once, other, agreed_values);
            if (!result) return testing::AssertionFailure() << ascent << result.message();
        }
        Batch<float> down = searched(rays, "pyramid");
        return same_bits<float>(once, down, agreed_values);
    });
}

TEST(Blocks, HitsDoNotDependOnTheAscent) {
    EXPECT_TRUE(ascents_agree([](Batch<float>&) {}));
    EXPECT_FALSE(ascents_agree([](Batch<float>& batch) { batch.real(Value::hit_s, 7) *= 0.999f; }));
}

/// In float and in double.
testing::AssertionResult is_never_wrong(const std::string& row, float late) {
    return on_maps([&](const oracle::Field& field, Batch<float>& rays) {
        Batch<float> found = searched(rays, row);
        Batch<double> wide = searched(in_double(rays), row);
        for (int lane = 0; lane < rays.lanes; ++lane) {
            const oracle::Ray ray = oracle_ray(rays, lane);
            auto result = is_not_wrong_of_blocks(field, ray, found.real(Value::hit_s, lane) + late);
            if (result) {
                result = is_not_wrong_of_blocks(field, ray,
                                                wide.real(Value::hit_s, lane) + double(late));
            }
            if (!result) return testing::AssertionFailure() << "lane " << lane << result.message();
        }
        return testing::AssertionSuccess();
    });
}

TEST(Blocks, NoHitIsWrong) {
    EXPECT_TRUE(is_never_wrong("qdm", 0));
    EXPECT_FALSE(is_never_wrong("qdm", 0.01f));
    EXPECT_FALSE(is_never_wrong("qdm", -0.01f));
    EXPECT_FALSE(is_never_wrong("texel-exact", 0));
}

}  // namespace
}  // namespace quadrel::test
