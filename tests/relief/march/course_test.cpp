// Steps of marches that add up their coordinates, left out where a bound proves that all lanes
// pass: each search has the bits that it has with every step made.
#include "quadrel/relief/trace/search/course.hpp"

#include "effort.hpp"
#include "quadrel/relief/trace/engine/babylon.hpp"
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
                                              {"height-outward@published", {{"points", 60}}},
                                              {"pom-dxsdk", {{"max_samples", 80}}},
                                              {"relief-gg3", {{"linear_steps", 50}}},
                                              {"shadow-march-thesis@published", {}},
                                              {"shadow-march-mcguire@published", {}}};
    return rows;
}

/// Engines' searches in layers.
const std::vector<BoundedRow>& engine_rows() {
    static const std::vector<BoundedRow> rows{
        {"babylon", {{"parallax_occlusion", 1}}},
        {"bevy", {{"max_layers", 4000}}},
        {"bevy", {{"max_layers", 4000}, {"relief", 1}}},
        {"godot", {{"deep", 1}, {"min_layers", 32}, {"max_layers", 64}}},
        {"jmonkey", {{"steep", 1}, {"scale", 0.5}}},
        {"learnopengl", {{"min_layers", 60}, {"max_layers", 120}}},
        {"o3de", {{"algorithm", 1}, {"quality", 3}}},
        {"o3de", {{"algorithm", 2}, {"quality", 2}}},
        {"o3de", {{"algorithm", 4}, {"quality", 1}}},
        {"three-parallax", {{"mode", 1}}},
        {"three-parallax", {{"mode", 2}}},
        {"three-parallax", {{"mode", 3}}},
        {"unity-pom", {{"steps", 100}, {"scale", 0.1}}},
        {"unity-pom", {{"mode", 1}, {"steps", 40}, {"max_steps", 200}}}};
    return rows;
}

/// And those that go by the map's greatest height alone.
std::vector<BoundedRow> all_rows() {
    std::vector<BoundedRow> rows = course_rows();
    rows.insert(rows.end(), engine_rows().begin(), engine_rows().end());
    rows.push_back({"playcanvas", {{"mode", 1}, {"height_map_factor", 160}, {"samples", 40}}});
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
    int tried = 0;
    for (const BoundedRow& row : course_rows())
        if (is_tried(tried++)) {
            EXPECT_TRUE(
                leaves_no_trace_on_all_maps({row.id}, row.parameters, fill_course, rounds(2)));
        }
}

TEST(Course, EnginesKeepTheirBits) {
    int tried = 0;
    for (const BoundedRow& row : engine_rows())
        if (is_tried(tried++)) {
            EXPECT_TRUE(
                leaves_no_trace_on_all_maps({row.id}, row.parameters, fill_course, rounds(1)));
        }
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
        const Map map = height_map(16, 16, [&](int, int) { return float(random.uniform(0, 0.6)); });
        const auto same =
            leaves_no_trace(bounded, row.parameters, fill_course, map, random, {}, looks);
        if (!same) return same;
    }
    return testing::AssertionSuccess();
}

TEST(Course, TheGreatestHeightOfAMapLeavesNoTrace) {
    for (const BoundedRow& row : all_rows()) {
        Looks looks, wrong;
        EXPECT_TRUE(leaves_no_trace_below(0.6f, row, looks)) << row.id;
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

/// babylon, seen right-handed, whose secant starts at the last sample that it happened to make.
template <Before before>
struct BabylonWith : Babylon {
    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const vec3<F> normal = io.template load<Value::frame_normal>();
        BabylonMarch<F> march(-tangent_viewer(io), along_frame(io, normal), params.scale,
                              ray.active);
        const ImplicitHeights heights(io);
        const Course course{[&](const vec3<F>& at) { return ray.uv + vec2<F>(at); },
                            [](const vec3<F>& at, F height) { return !(height > at.z); },
                            [&](const vec3<F>& at) { return march.next(at, F(-1)); }};
        for (const auto i : steps_on_course<F, before>(course, march.at, heights, march.keepWorking,
                                                       1, march.iMaxSamples))
            march.test(heights(ray.active, course.at(march.at)), F(-1));
        SearchResult<F> result;
        result.s = F(1) - march.currRayHeight();
        result.h = march.compared;
        result.status = search_status<F>(march.hit, march.met_nan | march.lost());
        store_search(io, ray, result, course.at(march.at));
    }
};

template <Before before>
testing::AssertionResult babylon_keeps_its_bits() {
    const auto run = [](Batch<float>& batch, const Parameters&) {
        Babylon::Params params{};
        params.parallax_occlusion = params.right_handed = 1;
        batch.run(&run_stage<BabylonWith<before>, Quad<float>>, &params);
    };
    return leaves_no_trace_on_all_maps({.id = "babylon", .instead = run},
                                       {{"parallax_occlusion", 1}, {"right_handed", 1}},
                                       fill_course, 4);
}

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
    for (const BoundedRow& engine : engine_rows()) {
        EXPECT_FALSE(leaves_no_trace_on_all_maps({engine.id}, engine.parameters, fill_course, 4,
                                                 [&](DamagedMaxima& m) {
                                                     level_above(m);
                                                     texel_away(m);
                                                 }))
            << engine.id;
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
    EXPECT_TRUE(babylon_keeps_its_bits<Before::needed>());
    EXPECT_FALSE(babylon_keeps_its_bits<Before::not_needed>());
}

// ---- What a lane's own last step asks for
// ------------------------------------------------------------------------------

/// Heights that no ray comes near to.
struct FarBelow {
    static float highest() { return -1e30f; }
    static const HeightMaxima* maxima() { return nullptr; }
    static int texels() { return 1; }
    template <class M, class V>
    CeilingLevels levels_between(M, V, V, int) const {
        return {};
    }
};

using OwnLast = std::function<float(float)>;

/// The first step that is given is the least of the lanes' own last ones, or that before. `told`:
/// what the word is told of a lane's.
template <Before before>
testing::AssertionResult gives_last_steps(const OwnLast& told) {
    using F = Quad<float>;
    Random random(11);
    for (int i = 0; i < 500; ++i) {
        F position(0), own_last, wanted;
        for (int lane = 0; lane < 4; ++lane) {
            wanted.lane[lane] = random.chance(0.05) ? std::nanf("") : float(random.below(90));
            own_last.lane[lane] = told(wanted.lane[lane]);
        }
        Mask<F> active(true);
        const Course course{[](F x) { return vec2<F>(x); }, [](F, F) { return Mask<F>(true); },
                            [](F x) { return x + F(1); }};
        std::vector<int> given;
        const FarBelow heights;
        for (const auto k :
             steps_on_course<F, before>(course, position, heights, active, 3, 80, own_last)) {
            given.push_back(k);
            active = active & (F(float(int(k))) < wanted);
            if (none(active)) break;
            position = select(active, course.next(position), position);
        }
        int first_end = 80;
        for (const float lane : wanted.lane)
            first_end = std::min(first_end, std::isnan(lane) ? 3 : int(lane));
        const int expected = std::max(first_end - (before == Before::needed ? 1 : 0), 3);
        if (given.front() != expected)
            return testing::AssertionFailure() << given.front() << ", not " << expected;
    }
    return testing::AssertionSuccess();
}

TEST(Course, LastStepsAreGiven) {
    const OwnLast told = [](float last) { return last; };
    EXPECT_TRUE(gives_last_steps<Before::not_needed>(told));
    EXPECT_TRUE(gives_last_steps<Before::needed>(told));
    EXPECT_FALSE(gives_last_steps<Before::needed>([](float last) { return last + 1; }));
}

}  // namespace
}  // namespace quadrel::test
