// ddm beside the walk of all cells: the same hits, fewer look-ups, and neither if its map is wrong.
#include "relief/exact/exact_search.hpp"

namespace quadrel::test {
namespace {

using Change = std::function<float(float free, int direction_a)>;

/// Rays at up to 89.9 degrees over a fractal relief, with a ddm map that `change` goes over.
template <PlainFloat T>
struct ChangedMap {
    ExactMaps maps;
    std::vector<float> texels;
    SampledTexture changed;
    Batch<float> rays;

    explicit ChangedMap(const Change& change) : maps(heights(), {TextureSlot::ddm}) {
        Random random(5);
        fill_stress_rays(rays, maps.height, random);
        const Map& ddm = maps.baked[static_cast<std::size_t>(TextureSlot::ddm)];
        changed = ddm.sampled;
        const TextureView& view = changed.view;
        const int level_0 = view.width[0] * view.height[0] * view.faces;
        texels.assign(view.texels, view.texels + view.offset[2] + view.faces);
        for (int n = 0; n < level_0; ++n)
            texels[static_cast<std::size_t>(n)] =
                change(view.texels[n], n % view.width[0] / view.width[1]);
        changed.view.texels = texels.data();
        maps.bind(rays);
    }

    Batch<T> run(const std::string& row) {
        Batch<T> batch = in_number<T>(rays);
        maps.bind(batch);
        batch.bind(TextureSlot::ddm, changed);
        batch.run(row);
        return batch;
    }

  private:
    static Map heights() {
        Random random(11);
        const auto& kinds = stress_maps();
        return make_stress_map(kinds.back(), 48, 40, plain_sampler(), random);
    }
};

template <PlainFloat T>
testing::AssertionResult hits_as_all_cells(const Change& change) {
    ChangedMap<T> map(change);
    Batch<T> walked = map.run("texel-exact"), leapt = map.run("ddm");
    return same_bits<T>(walked, leapt, agreed_values);
}

TEST(DdmSearch, LeapsAsFarAsItsMapAllows) {
    const Change as_baked = [](float free, int) { return free; };
    EXPECT_TRUE(hits_as_all_cells<float>(as_baked));
    EXPECT_TRUE(hits_as_all_cells<double>(as_baked));
    EXPECT_FALSE(hits_as_all_cells<float>([](float free, int) { return free - 0.1f; }));
    EXPECT_FALSE(hits_as_all_cells<float>([](float free, int a) { return a < 3 ? 0 : free; }));
}

template <PlainFloat T>
int look_ups(Batch<T> batch) {
    int sum = 0;
    for (int lane = 0; lane < batch.lanes; ++lane) sum += batch.integer(Value::hit_fetches, lane);
    return sum;
}

/// How many look-ups are left of those of all cells, at 80 degrees.
double share_of_look_ups(const Change& change) {
    ChangedMap<float> map(change);
    Random random(7);
    for (int lane = 0; lane < map.rays.lanes; ++lane) {
        const double turn = random.uniform(0, 6.28);
        map.rays.set(Value::K, lane, dvec2(cos(turn), sin(turn)) * 0.6);
    }
    return double(look_ups(map.run("ddm"))) / look_ups(map.run("texel-exact"));
}

TEST(DdmSearch, LooksLessOftenThanInEveryCell) {
    EXPECT_LT(share_of_look_ups([](float free, int) { return free; }), 0.9);
    EXPECT_GT(share_of_look_ups([](float, int) { return 1.0f; }), 1);
}

/// Rays flatter than the map's directions walk, and are right.
TEST(DdmSearch, WalksWhereItsMapDoesNotTell) {
    ChangedMap<float> map([](float free, int) { return free; });
    for (int lane = 0; lane < map.rays.lanes; ++lane)
        map.rays.set(Value::K, lane, dvec2(lane % 3 - 1.0, 2.5));
    Batch<float> walked = map.run("texel-exact"), leapt = map.run("ddm");
    EXPECT_TRUE(same_bits<float>(walked, leapt, agreed_values));
    EXPECT_EQ(look_ups(leapt), look_ups(walked));
}

}  // namespace
}  // namespace quadrel::test
