// Steps that are left out because a bound proves them above the surface: each search has the bits
// that it has with all of them, its own lattice walked step by step.
#include "quadrel/relief/trace/search/near_surface.hpp"
#include "effort.hpp"
#include "quadrel/relief/trace/march/pom.hpp"
#include "relief/march/no_trace.hpp"

namespace quadrel::test {
namespace {

const std::vector<BoundedRow>& lattice_rows() {
    static const std::vector<BoundedRow> rows{
        {"linear", {{"steps", 128}}},
        {"linear", {{"steps", 1000}}},
        {"steep", {{"steps", 60}}},
        {"steep-adaptive", {{"steps_grazing", 200}, {"steps_normal", 30}, {"rounding", 2}}},
        {"steep-constant-xy", {{"min_steps", 16}, {"max_steps", 400}}},
        {"steep-quality", {{"quality", 3}}},
        {"steep-mip-c", {{"steps", 128}}},
        {"steep-mip-i", {{"steps", 128}}},
        {"height-outward", {{"points", 150}}},
        {"pom", {{"steps_grazing", 200}, {"steps_normal", 80}}},
        {"relief-binary", {{"steps", 128}, {"binary_steps", 7}}},
        {"secant", {{"steps", 128}}},
        {"interval", {{"steps", 128}}},
        {"contact", {{"steps", 128}, {"fine_steps", 200}}},
        {"contact", {{"steps", 4}, {"fine_steps", 200}, {"interpolate", 1}}},
        {"thesis-linear-binary", {{"min_steps", 100}}},
        {"thesis-linear-binary@published", {{"min_steps", 100}}},
        {"shadow-march-mcguire", {{"steps_grazing", 200}, {"steps_normal", 60}}},
        {"shadow-march-thesis", {{"steps", 128}}},
        {"shadow-soft-riccardi", {{"steps", 128}}},
        {"shadow-relief", {{"steps", 128}}},
    };
    return rows;
}

/// Set QUADREL_LATTICE_RAYS for more; a million take some minutes.
int maps_of_a_kind(int usual) {
    const char* const rays = std::getenv("QUADREL_LATTICE_RAYS");
    if (rays == nullptr) return rounds(usual);
    return static_cast<int>(
        1 + std::atol(rays) / (64 * static_cast<long>(wild_maps().size() * lattice_rows().size())));
}

void fill_lattice(Batch<float>& batch, const std::string& id, const Map& map, Random& random) {
    fill_neighbouring_rays(batch, map, random);
    if (id.starts_with("shadow")) light_hits(batch, random);
}

TEST(NearSurface, RowsKeepTheirBits) {
    int tried = 0;
    for (const BoundedRow& row : lattice_rows())
        if (is_tried(tried++)) {
            EXPECT_TRUE(leaves_no_trace_on_all_maps({row.id}, row.parameters, fill_lattice,
                                                    maps_of_a_kind(2)));
        }
}

// ---- Planted errors
// ------------------------------------------------------------------------------

/// pom whose chords start at the last sample that it happened to make.
struct HastyPom : Pom {
    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        const F n =
            steps_by_angle(io.template load<Value::r>(), params.steps_grazing, params.steps_normal);
        const int most = std::max(params.steps_grazing, params.steps_normal);
        store_search(io, ray,
                     result_on_chord(first_bracket(tested_heights(io, heights), ray, n, most,
                                                   Before::not_needed)));
    }
};

void run_hasty_pom(Batch<float>& batch, const Parameters&) {
    const Pom::Params params{200, 80};
    batch.run(&run_stage<HastyPom, Quad<float>>, &params);
}

TEST(NearSurface, PlantedErrorsAreCaught) {
    const Parameters steps{{"steps", 128}};
    const auto linear = [&](const Damage& damage) {
        return leaves_no_trace_on_all_maps({"linear"}, steps, fill_lattice, 4, damage);
    };
    EXPECT_TRUE(linear([](DamagedMaxima&) {}));
    // The level above the one that is read.
    EXPECT_FALSE(linear([](DamagedMaxima& m) {
        for (int i = 0; i + 1 < m.maxima.levels; ++i) m.maxima.level[i] = m.maxima.level[i + 1];
    }));
    // Cells that do not go on at the other side, and that do where they should not.
    EXPECT_FALSE(linear([](DamagedMaxima& m) {
        for (LevelMaxima& level : m.maxima.level) level.repeat_x = 0;
    }));
    EXPECT_FALSE(linear([](DamagedMaxima& m) {
        for (LevelMaxima& level : m.maxima.level) level.repeat_y = 1;
    }));
    // Cells a texel away.
    EXPECT_FALSE(linear([](DamagedMaxima& m) {
        for (LevelMaxima& level : m.maxima.level) ++level.first_x;
    }));
    // A texel that is not a number taken for a low one.
    EXPECT_FALSE(linear([](DamagedMaxima& m) {
        for (int i = 0; i < m.maxima.levels; ++i)
            for (float& node : m.nodes(i))
                if (std::isinf(node)) node = 0;
    }));
    EXPECT_FALSE(leaves_no_trace_on_all_maps({.id = "pom", .instead = run_hasty_pom},
                                             {{"steps_grazing", 200}, {"steps_normal", 80}},
                                             fill_lattice, 4));
}

// ---- The beam
// ------------------------------------------------------------------------------------

using LastAbove = std::function<int(const Beam&, int, int, double)>;

testing::AssertionResult all_that_is_left_out_is_above(const LastAbove& last_above) {
    Random random(5);
    for (int i = 0; i < 20000; ++i) {
        const bool rises = random.chance(0.3);
        Beam beam;
        const double n = 1 + random.below(300);
        beam.height_low = {random.uniform(0, 1), (rises ? 1 : -1) / n};
        const int a = random.below(200), b = a + random.below(200);
        const double ceiling = random.chance(0.2) ? beam.height_low.at(random.integer(a, b))
                                                  : random.uniform(-0.5, 1.2);
        const int last = last_above(beam, a, b, ceiling);
        if (last < a - 1 || last > b) return testing::AssertionFailure() << last;
        for (int k = a; k <= last; ++k)
            if (!(beam.height_low.at(k) > ceiling - 1e-12))
                return testing::AssertionFailure() << "step " << k << " of " << a << " to " << b;
    }
    return testing::AssertionSuccess();
}

TEST(NearSurface, BeamsEndAboveTheCeiling) {
    EXPECT_TRUE(all_that_is_left_out_is_above([](const Beam& beam, int a, int b, double ceiling) {
        return beam.last_above(a, b, ceiling);
    }));
    // The start of an interval taken for its end.
    EXPECT_FALSE(all_that_is_left_out_is_above([](const Beam& beam, int a, int b, double ceiling) {
        return beam.height_low.at(a) > ceiling ? b : a - 1;
    }));
    EXPECT_FALSE(all_that_is_left_out_is_above([](const Beam& beam, int a, int b, double ceiling) {
        return std::min(beam.last_above(a, b, ceiling) + 1, b);
    }));
}

/// Every coordinate that a row computes lies in the box of each interval around its step.
testing::AssertionResult boxes_hold_all_samples(
    const std::function<UvBox(const Beam&, int, int)>& box) {
    Random random(6);
    using F = Quad<float>;
    for (int i = 0; i < 3000; ++i) {
        SearchRay<F> ray;
        const double size = std::pow(10.0, random.uniform(-3, 3));
        for (int lane = 0; lane < 4; ++lane) {
            ray.uv.x.lane[lane] = float(random.uniform(-size, size));
            ray.K.x.lane[lane] = float(random.uniform(-3, 3));
        }
        ray.uv.y = ray.K.y = F(0.0f);
        ray.s_polygon = float(random.uniform(0, 1));
        const int n = 1 + random.below(300);
        Beam beam;
        const auto at = [&](int k) { return ray.at(F(float(k) / float(n))).x; };
        bound_coordinate<F>({at(0), at(n)}, ray.K.x, Mask<F>(true), 0, n, beam.u_low, beam.u_high);
        const int a = random.below(n + 1), b = random.integer(a, n);
        const UvBox bounds = box(beam, a, b);
        const F u = at(random.integer(a, b));
        for (int lane = 0; lane < 4; ++lane)
            if (!(u.lane[lane] >= bounds.u_low && u.lane[lane] <= bounds.u_high))
                return testing::AssertionFailure() << u.lane[lane];
    }
    return testing::AssertionSuccess();
}

TEST(NearSurface, BoxesHoldAllSamples) {
    EXPECT_TRUE(
        boxes_hold_all_samples([](const Beam& beam, int a, int b) { return beam.box(a, b); }));
    EXPECT_FALSE(
        boxes_hold_all_samples([](const Beam& beam, int a, int) { return beam.box(a, a); }));
    EXPECT_FALSE(boxes_hold_all_samples([](const Beam& beam, int a, int b) {
        UvBox box = beam.box(a, b);
        box.u_high = box.u_low + (box.u_high - box.u_low) * 0.99;
        return box;
    }));
}

}  // namespace
}  // namespace quadrel::test
