// Steps of marches that add up their coordinates, left out where a bound proves that all lanes
// pass: each search has the bits that it has with every step made.
#include "quadrel/relief/trace/search/course.hpp"

#include "effort.hpp"
#include "quadrel/relief/trace/march/linear_thesis.hpp"
#include "relief/march/no_trace.hpp"
#include "relief/vertex_inputs.hpp"

namespace quadrel::test {
namespace {

const std::vector<BoundedRow>& course_rows() {
    static const std::vector<BoundedRow> rows{{"linear-thesis", {}},
                                              {"rabbid-pom", {}},
                                              {"rabbid-relief", {}},
                                              {"steep@published", {{"steps", 80}}},
                                              {"shadow-march-thesis@published", {}},
                                              {"shadow-march-mcguire@published", {}}};
    return rows;
}

/// What the rows read beside the rays: fragments of the plane z = -1 of eye space, packets of
/// quads side by side, seen from straight above or nearly so, some of them from behind.
void fill_fragments(Batch<float>& batch, Random& random) {
    batch.material.depth = 1;
    const dvec3 T(1, 0, 0), B(0, 1, 0), N(0, 0, 1);
    dvec3 origin;
    bool behind = false;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        if (lane % 16 == 0) {
            const double aside = std::pow(10.0, random.uniform(-4, -0.5));
            origin = {random.uniform(-aside, aside), random.uniform(-aside, aside), -1};
            behind = random.chance(0.1);
        }
        const double x = lane / 4 % 4 * 2 + lane % 2, y = lane % 4 / 2;
        const dvec3 P = origin + dvec3(x, y, 0) * 1e-4;
        const float slow = static_cast<float>(std::pow(10.0, random.uniform(-3, -2.9)));
        batch.set(Value::K, lane, batch.vector2(Value::K, lane) * slow);
        batch.set(Value::uv_rate, lane, batch.vector2(Value::K, lane));
        batch.set(Value::P, lane, P);
        batch.set(Value::Ng, lane, behind ? -N : N);
        for (const Value v : {Value::vertex_normal, Value::frame_normal, Value::N})
            batch.set(v, lane, N);
        batch.set(Value::T, lane, T);
        batch.set(Value::B, lane, B);
        batch.set(Value::dPdx, lane, T * 1e-2);
        batch.set(Value::dPdy, lane, B * 1e-2);
    }
    for (int quad = 0; quad < batch.lanes / 4; ++quad)
        set_quad_vertices(batch, quad, batch.vector3(Value::P, 4 * quad), VertexAxes{T, B, N});
}

/// Hits somewhere above the surface or on it, and a light nearly overhead.
void fill_hits(Batch<float>& batch, Random& random) {
    const double aside = std::pow(10.0, random.uniform(-3, 0.5));
    const dvec3 light = normalize(dvec3(random.uniform(-aside, aside), aside, 1));
    batch.frame.lights[0].directional = 1;
    for (int c = 0; c < 3; ++c) batch.frame.lights[0].position[c] = static_cast<float>(light[c]);
    double depth = 0;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        if (lane % 4 == 0) depth = random.uniform(0.3, 1);
        batch.set(Value::hit_uv, lane, batch.vector2(Value::uv, lane));
        batch.set(Value::hit_P, lane, batch.vector3(Value::P, lane));
        batch.real(Value::hit_depth, lane) = static_cast<float>(depth + random.uniform(0, 0.02));
        batch.real(Value::hit_h, lane) = static_cast<float>(1 - depth);
    }
}

void fill_course(Batch<float>& batch, const std::string& id, const Map& map, Random& random) {
    fill_neighbouring_rays(batch, map, random);
    fill_fragments(batch, random);
    if (id.starts_with("shadow")) fill_hits(batch, random);
}

TEST(Course, RowsKeepTheirBits) {
    for (const BoundedRow& row : course_rows())
        EXPECT_TRUE(leaves_no_trace_on_all_maps({row.id}, row.parameters, fill_course, rounds(2)));
}

/// Steps are left out by the map's greatest height alone, `high`.
testing::AssertionResult leaves_no_trace_below(float high, const BoundedRow& row, Looks& looks) {
    Random random(3);
    const StageUnderTest<float> bounded{.id = row.id, .before = [=](Batch<float>& batch) {
                                            batch.material.maxima = nullptr;
                                            batch.material.heights_bounded = 1;
                                            batch.material.height_high = high;
                                        }};
    for (int i = 0; i < 8; ++i) {
        const Map map = height_map(16, 16, [&](int, int) { return float(random.uniform(0, 0.4)); });
        const auto same =
            leaves_no_trace(bounded, row.parameters, fill_course, map, random, {}, looks);
        if (!same) return same;
    }
    return testing::AssertionSuccess();
}

TEST(Course, TheGreatestHeightOfAMapLeavesNoTrace) {
    for (const BoundedRow& row : course_rows()) {
        Looks looks, wrong;
        EXPECT_TRUE(leaves_no_trace_below(0.4f, row, looks)) << row.id;
        EXPECT_LT(looks.made, looks.all) << row.id;
        EXPECT_FALSE(leaves_no_trace_below(0.1f, row, wrong)) << row.id;
    }
}

// ---- Planted errors
// ------------------------------------------------------------------------------

/// linear-thesis, a step of which goes on by less than it should know of: what is between two
/// points is taken for what is at the first.
struct ShortSighted : LinearThesis {
    template <class Io>
    struct Heights : ImplicitHeights<Io> {
        using ImplicitHeights<Io>::ImplicitHeights;
        CeilingLevels levels_between(auto active, const auto& from, const auto&, int) const {
            CeilingLevels levels = ImplicitHeights<Io>::levels_between(active, from, from, 1);
            levels.finest = levels.coarsest;
            return levels;
        }
    };

    template <class Io>
    void operator()(Io& io, const Params&) const {
        run(io, Heights<Io>(io));
    }
};

TEST(Course, PlantedErrorsAreCaught) {
    const auto row = [](const std::string& id, const Damage& damage) {
        return leaves_no_trace_on_all_maps({id}, {}, fill_course, 4, damage);
    };
    const Damage level_above = [](DamagedMaxima& m) {
        for (int i = 0; i + 1 < m.maxima.levels; ++i) m.maxima.level[i] = m.maxima.level[i + 1];
    };
    const Damage texel_away = [](DamagedMaxima& m) {
        for (LevelMaxima& level : m.maxima.level) ++level.first_x;
    };
    for (const std::string id : {"linear-thesis", "rabbid-pom"}) {
        EXPECT_FALSE(row(id, level_above)) << id;
        EXPECT_FALSE(row(id, texel_away)) << id;
    }
    EXPECT_FALSE(leaves_no_trace_on_all_maps({"shadow-march-thesis@published"}, {}, fill_course, 8,
                                             level_above));
    // A texel that is not a number taken for a low one.
    EXPECT_FALSE(row("linear-thesis", [](DamagedMaxima& m) {
        for (int i = 0; i < m.maxima.levels; ++i)
            for (float& node : m.nodes(i))
                if (std::isinf(node)) node = 0;
    }));
    const auto run_short_sighted = [](Batch<float>& batch, const Parameters&) {
        const LinearThesis::Params params{};
        batch.run(&run_stage<ShortSighted, Quad<float>>, &params);
    };
    EXPECT_FALSE(leaves_no_trace_on_all_maps({.id = "linear-thesis", .instead = run_short_sighted},
                                             {}, fill_course, 4));
}

}  // namespace
}  // namespace quadrel::test
