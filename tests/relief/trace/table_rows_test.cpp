// Rows that look distances up: exact where their table has a node, nearer to the judge the finer
// the table is, and over a curved base where the parabola says.
#include "quadrel/relief/direction_table.hpp"
#include "relief/exact/exact_search.hpp"
#include "relief/exact/oracle.hpp"

namespace quadrel::test {
namespace {

constexpr double depth = 0.1;
constexpr int side = 24;

BakeOptions shape(TextureSlot slot, int columns, int layers, int directions) {
    BakeOptions options;
    options.parameters = {{"columns", columns}, {"directions", directions}, {"depth", depth}};
    options.parameters[slot == TextureSlot::gdm ? "slices" : "curvatures"] = layers;
    if (slot == TextureSlot::vdm) options.parameters["curvature"] = 24;
    return options;
}

TextureSlot slot_of_row(const std::string& row) {
    return row == "gdm" ? TextureSlot::gdm : TextureSlot::vdm;
}

/// Rays over a height map, and its table.
template <PlainFloat T>
struct TableBatch {
    Map heights, table;
    Batch<T> batch;

    TableBatch(const Map& map, TextureSlot slot, const BakeOptions& options) : heights(map) {
        table.texture = bake(*heights.texture, bake_kind_from_name(slot_name(slot)),
                             heights.sampled.sampler, options);
        table.sampled = {table.texture->view(), heights.sampled.sampler};
        batch.bind(TextureSlot::height, heights.sampled);
        batch.bind(slot, table.sampled);
        batch.material.depth = 0.1f;
        for (int lane = 0; lane < batch.lanes; ++lane) {
            set_ray(lane, dvec2(0), dvec2(0));
            batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
            batch.integer(Value::frame_flags, lane) = 0;
            batch.set(Value::frame_normal, lane, dvec3(0, 0, 1));
            batch.set(Value::dPdx, lane, dvec3(0.01, 0, 0));
            batch.set(Value::dPdy, lane, dvec3(0, 0.01, 0));
            batch.set(Value::dUVdx, lane, dvec2(0.01, 0));
            batch.set(Value::dUVdy, lane, dvec2(0, 0.01));
        }
    }
    TableBatch(const TableBatch&) = delete;

    void set_ray(int lane, const dvec2& uv, const dvec2& K) {
        batch.set(Value::uv, lane, uv);
        batch.set(Value::K, lane, K);
        batch.set(Value::uv_rate, lane, K / depth);
    }
    double s_of_oracle(int lane) {
        return static_cast<double>(
            oracle::meet_bilinear(oracle::Field(heights.sampled), oracle_ray(batch, lane)).s);
    }
    Status status(int lane) { return static_cast<Status>(batch.integer(Value::hit_status, lane)); }
};

Map fractal(int seed) {
    Random random(static_cast<std::uint64_t>(seed));
    return make_stress_map(stress_maps().back(), side, side, plain_sampler(), random);
}

/// From nodes of place towards nodes of direction the judge's hit is found. `change` may do so to
/// K.
template <PlainFloat T>
testing::AssertionResult is_exact_at_nodes(const std::string& row,
                                           const std::function<dvec2(dvec2)>& change) {
    constexpr int directions = 7, columns = 12;
    const TextureSlot slot = slot_of_row(row);
    TableBatch<T> rays(fractal(3), slot,
                       shape(slot, columns, slot == TextureSlot::gdm ? 4 : 3, directions));
    Random random(41);
    for (int lane = 0; lane < rays.batch.lanes; ++lane) {
        // Of the border the tables' rays are as flat as float can tell.
        const auto node = [&] {
            return 2.0 * (1 + random.below(directions - 2)) / (directions - 1) - 1;
        };
        const dvec2 uv((random.below(3 * columns) + 0.5) / columns - 1,
                       (random.below(columns) + 0.5) / columns);
        const double e = node(), f = node();
        rays.set_ray(lane, uv, direction_of_square(e, f) * depth);
    }
    std::vector<double> expected;
    for (int lane = 0; lane < rays.batch.lanes; ++lane) expected.push_back(rays.s_of_oracle(lane));
    for (int lane = 0; lane < rays.batch.lanes; ++lane)
        rays.set_ray(lane, rays.batch.vector2(Value::uv, lane),
                     change(rays.batch.vector2(Value::K, lane)));
    rays.batch.run(row, row == "gdm" ? Parameters{{"prisms", 1}} : Parameters{});
    int seen = 0;
    for (int lane = 0; lane < rays.batch.lanes; ++lane) {
        const double s = rays.batch.real(Value::hit_s, lane);
        // A ray that leaves its prism is looked up again, between nodes.
        if (rays.batch.integer(Value::hit_steps, lane) > 1) continue;
        ++seen;
        if (rays.status(lane) != Status::hit || std::abs(s - expected[lane]) > 2e-4)
            return testing::AssertionFailure()
                   << row << ", lane " << lane << ": " << s << " for " << expected[lane];
    }
    return seen > 100 ? testing::AssertionSuccess() : testing::AssertionFailure() << seen;
}

TEST(TableRows, AreExactAtNodes) {
    const auto as_is = [](const dvec2& K) { return K; };
    const auto turned = [](const dvec2& K) { return dvec2(K.y, K.x); };
    const auto longer = [](const dvec2& K) { return K * 1.1; };
    for (const char* row : {"gdm", "vdm"}) {
        EXPECT_TRUE(is_exact_at_nodes<float>(row, as_is));
        EXPECT_TRUE(is_exact_at_nodes<double>(row, as_is));
        EXPECT_FALSE(is_exact_at_nodes<float>(row, turned));
        EXPECT_FALSE(is_exact_at_nodes<float>(row, longer));
    }
}

/// The mean distance from the judge's hit, in s, of rays anywhere at up to 75 degrees.
double mean_error(const std::string& row, int columns, int layers, int directions) {
    const TextureSlot slot = slot_of_row(row);
    TableBatch<float> rays(fractal(3), slot, shape(slot, columns, layers, directions));
    Random random(43);
    for (int lane = 0; lane < rays.batch.lanes; ++lane) {
        const double turn = random.uniform(0, 6.28), tangent = random.uniform(0, 3.7);
        rays.set_ray(lane, dvec2(random.uniform(0, 1), random.uniform(0, 1)),
                     dvec2(cos(turn), sin(turn)) * (tangent * depth));
    }
    rays.batch.run(row);
    double sum = 0;
    for (int lane = 0; lane < rays.batch.lanes; ++lane)
        sum += std::abs(rays.batch.real(Value::hit_s, lane) - rays.s_of_oracle(lane));
    return sum / rays.batch.lanes;
}

TEST(TableRows, ComeNearerWithFinerTables) {
    for (const char* row : {"gdm", "vdm"}) {
        const double fine = mean_error(row, 24, 5, 17);
        EXPECT_LT(fine, 0.1) << row;
        EXPECT_LT(fine, 0.9 * mean_error(row, 6, 5, 17)) << row;
        EXPECT_LT(fine, 0.9 * mean_error(row, 24, 5, 5)) << row;
    }
}

/// Over a plane at 1/2 a ray along a node's direction comes down there, through prisms of any size.
testing::AssertionResult passes_prisms(int prisms, float level) {
    TableBatch<float> rays(flat_map(level, 8), TextureSlot::gdm, shape(TextureSlot::gdm, 8, 4, 9));
    Random random(47);
    for (int lane = 0; lane < rays.batch.lanes; ++lane) {
        const double e = random.below(9) / 4.0 - 1, f = random.below(9) / 4.0 - 1;
        rays.set_ray(lane, dvec2(random.uniform(-2, 2), random.uniform(-2, 2)),
                     direction_of_square(e * 0.999999, f * 0.999999) * depth);
    }
    rays.batch.run("gdm", {{"prisms", prisms}});
    for (int lane = 0; lane < rays.batch.lanes; ++lane) {
        const double s = rays.batch.real(Value::hit_s, lane);
        if (rays.status(lane) != Status::hit || std::abs(s - 0.5) > 1e-4)
            return testing::AssertionFailure() << prisms << " prisms, lane " << lane << ": " << s;
    }
    return testing::AssertionSuccess();
}

TEST(TableRows, GoFromPrismToPrism) {
    for (const int prisms : {1, 3, 64}) EXPECT_TRUE(passes_prisms(prisms, 0.5f));
    EXPECT_FALSE(passes_prisms(3, 0.52f));
}

/// Over a sphere whose top is a relief's of height `level`, rays meet it where the parabola says,
/// and those that it does not reach are clipped.
testing::AssertionResult follows_the_base(double curvature, double told) {
    constexpr float level = 0.25f;
    TableBatch<float> rays(flat_map(level, 8), TextureSlot::vdm, shape(TextureSlot::vdm, 8, 3, 9));
    Random random(53);
    for (int lane = 0; lane < rays.batch.lanes; ++lane) {
        const double e = random.below(5) / 4.0 - 0.5, f = random.below(5) / 4.0 - 0.5;
        rays.set_ray(lane, dvec2(random.uniform(-1, 1), random.uniform(-1, 1)),
                     direction_of_square(e, f) * depth);
        // A tile is one unit: dN = curvature dP, quads of pixels 0.01 apart.
        const double x = lane % 2 * 0.01, y = lane / 2 % 2 * 0.01;
        rays.batch.set(Value::frame_normal, lane, dvec3(x * curvature, y * curvature, 1));
    }
    rays.batch.run("vdm");
    int clipped = 0;
    for (int lane = 0; lane < rays.batch.lanes; ++lane) {
        const auto K = rays.batch.vector2(Value::K, lane);
        const double bend = told / 2 * dot(K, K) / depth;
        // 1 - t + bend t^2 = level
        const double square = 1 - 4 * bend * (1 - level);
        if (square < 0) {
            if (rays.status(lane) != Status::clip)
                return testing::AssertionFailure() << "lane " << lane << " not clipped";
            ++clipped;
            continue;
        }
        // 2c / (b + root) has no cancellation, and no quotient by 0 on a plane.
        const double t = 2 * (1 - level) / (1 + std::sqrt(square));
        const auto way =
            rays.batch.vector2(Value::hit_uv, lane) - rays.batch.vector2(Value::uv, lane);
        if (rays.status(lane) != Status::hit || std::abs(way.x - K.x * t) > 1e-4 ||
            std::abs(way.y - K.y * t) > 1e-4 ||
            std::abs(rays.batch.real(Value::hit_s, lane) - (1 - level)) > 1e-4)
            return testing::AssertionFailure() << "lane " << lane << ": " << way.x << " " << way.y;
    }
    if (curvature > 0 && clipped < 8) return testing::AssertionFailure() << clipped << " clipped";
    return testing::AssertionSuccess();
}

TEST(TableRows, FollowACurvedBase) {
    for (const double curvature : {-24, 0, 24}) EXPECT_TRUE(follows_the_base(curvature, curvature));
    EXPECT_FALSE(follows_the_base(-24, 24));
    EXPECT_FALSE(follows_the_base(0, -24));
}

}  // namespace
}  // namespace quadrel::test
