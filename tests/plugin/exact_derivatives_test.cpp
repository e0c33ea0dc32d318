// Exact derivatives for users: unit tests on dual numbers, shaders over a triangle, stages of the
// calling program.
#include <gtest/gtest.h>

#include "quadrel/error.hpp"
#include "quadrel/relief/shader.hpp"
#include "quadrel/relief/trace/search/search.hpp"
#include "quadrel/shader.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::plugin_tests {
namespace {

TEST(ExactDerivatives, ExampleOfTheHeader) {
    const auto q = unit::run_quad<Quad<Dual>>(10, 20, [](const auto& xy) { return xy.x * xy.x; });
    EXPECT_EQ(q.exact_dx(0), 21);
    EXPECT_EQ(q.dFdx_fine(0), 22);
    EXPECT_EQ(q.dFdx_coarse(3) - q.exact_dx(3), -1);
    EXPECT_EQ(q.exact_dy(2), 0);
    EXPECT_EQ(q[1], 11.5 * 11.5);
}

TEST(ExactDerivatives, StandBesideFineAndCoarse) {
    const auto q = unit::run_quad<Quad<Dual>>(
        6, 4, [](const auto& xy) { return vec2<Quad<Dual>>(xy.x * xy.y, sin(xy.y)); });
    EXPECT_EQ(q.exact_dx(3).x, 5.5);
    EXPECT_EQ(q.dFdx_fine(3).x, 5.5);
    EXPECT_EQ(q.dFdx_coarse(3).x, 4.5);
    EXPECT_EQ(q.exact_dy(1), vec2<double>(7.5, cos(4.5)));
}

/// In perspective, with a depth of its own at each vertex.
const std::array<ShaderVertex<2>, 3> perspective{{{{-0.9f, -0.8f, 0.3f, 1}, {0.25f, -3}},
                                                  {{1.4f, -1, 0.2f, 2}, {8, 1}},
                                                  {{-0.5f, 2.5f, 1, 3}, {0.5f, 4}}}};

/// d(N / D) of N = sum e_i v_i / w_i, D = sum e_i / w_i at a pixel's centre, by the edge functions'
/// whole numbers.
double gradient(const ScreenTriangle& screen, int varying, int axis, int x, int y) {
    long double n = 0, d = 0, n_step = 0, d_step = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t px = 256 * x + 128, py = 256 * y + 128;
        const EdgeFunction& edge = screen.edge[i];
        const long double at = edge(px, py) / static_cast<long double>(screen.vertex[i].w);
        const long double step =
            (edge(px + (axis == 0 ? 256 : 0), py + (axis == 1 ? 256 : 0)) - edge(px, py)) /
            static_cast<long double>(screen.vertex[i].w);
        const long double v = perspective[i].varyings[std::size_t(varying)];
        n += at * v;
        d += at;
        n_step += step * v;
        d_step += step;
    }
    return static_cast<double>((n_step - n / d * d_step) / d);
}

using DualQuads = std::vector<ShadedQuad<vec3<Quad<Dual>>>>;

/// Both varyings' gradients in every lane, and that of the depth in the window.
testing::AssertionResult has_its_gradients(const DualQuads& quads, const ScreenTriangle& screen) {
    int lanes = 0;
    for (const auto& quad : quads)
        for (int lane = 0; lane < 4; ++lane) {
            const int x = lane_x(quad.coverage, lane), y = lane_y(quad.coverage, lane);
            if (!quad.covered(lane)) continue;
            ++lanes;
            for (int v = 0; v < 2; ++v)
                for (int axis = 0; axis < 2; ++axis) {
                    const double found =
                        axis == 0 ? quad.result.exact_dx(lane)[v] : quad.result.exact_dy(lane)[v];
                    const double expected = gradient(screen, v, axis, x, y);
                    if (!(std::abs(found - expected) <= 1e-12 * (1 + std::abs(expected))))
                        return testing::AssertionFailure() << found << " for " << expected;
                }
            const auto depth = [&](int px, int py) {
                return double(depth_at(screen, 256 * px + 128, 256 * py + 128));
            };
            if (std::abs(quad.result.exact_dx(lane).z - (depth(x + 1, y) - depth(x, y))) > 1e-6)
                return testing::AssertionFailure() << "depth";
        }
    return lanes > 100 ? testing::AssertionSuccess() : testing::AssertionFailure() << lanes;
}

template <class Shader>
DualQuads shaded(const RasterState& state, const Shader& shader) {
    return shade_triangle<Quad<Dual>>(state, perspective, shader);
}

TEST(ExactDerivatives, VaryingsHaveTheirGradients) {
    const auto state = raster_state({32, 24}, hardware_model(Hardware::exact));
    const auto pieces = triangle_quads(
        {perspective[0].position, perspective[1].position, perspective[2].position}, state);
    ASSERT_EQ(pieces.size(), 1u);
    const ScreenTriangle& screen = pieces[0].piece.screen;
    const auto plain = [](const auto& in) {
        return vec3<Quad<Dual>>(in.varying2(0), in.frag_coord.z);
    };
    const auto swapped = [&](const auto& in) {
        return map_components(
            [](const Quad<Dual>& v) {
                return map_lanes<Quad<Dual>>(
                    [](const Dual& x) { return Dual(x.value, x.dy, x.dx); }, v);
            },
            plain(in));
    };
    EXPECT_TRUE(has_its_gradients(shaded(state, plain), screen));
    EXPECT_FALSE(has_its_gradients(shaded(state, swapped), screen));
    ScreenTriangle wrong = screen;
    std::swap(wrong.edge[0], wrong.edge[1]);
    EXPECT_FALSE(has_its_gradients(shaded(state, plain), wrong));
}

/// Half of the way down, whatever the heights.
template <bool on_duals>
struct HalfWay : StageDefaults {
    static constexpr StageText text{on_duals ? "test-half-way" : "test-half-way-plain", "trace",
                                    "half of the way", "these tests"};
    static constexpr auto inputs = search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr bool runs_on_duals = on_duals;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        SearchResult<F> result;
        result.s = F(0.5f);
        store_search(io, search_ray(io), result);
    }
};

/// README's own, on dual numbers too.
struct DualSteep : ReliefShader {
    static constexpr StageText text{"test-dual-steep", "trace", "first of 64 steps", "these tests"};
    static constexpr bool runs_on_duals = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        ReliefRay ray(io);
        for (const auto k : ray.steps(0, 64)) {
            const auto s = ray.number(k) / 64;
            const auto height = ray.height(s);
            ray.hit(height >= 1 - s, s);
            if (none(ray.active())) break;
        }
        ray.store();
    }
};

TEST(ExactDerivatives, StagesOfTheProgramMayDeclareThem) {
    register_stages<HalfWay<true>, HalfWay<false>, DualSteep>();
    const auto names = [](const char* id) { return find_stage(id)->number_types; };
    EXPECT_EQ(names("test-half-way").back(), "dual");
    EXPECT_EQ(names("test-half-way-plain").back(), "double");
    Scene scene = render_tests::empty_scene(24, 24);
    render_tests::set_perspective_camera(scene, {0.3, -1.4, 1.6}, {.near = 0.5, .far = 50});
    scene.materials = {render_tests::relief_material("relief", false)};
    render_tests::add_object(scene, make_quad(2), 0);
    scene.materials[0].trace = render_tests::stage("test-half-way", "trace");
    const Film film = render_tests::take(render, scene, {"A", "derr.dhitUVdx.U"});
    EXPECT_LT(std::abs(render_tests::value(film, "derr.dhitUVdx.U", 12, 12)), 0.01f);
    scene.materials[0].trace = render_tests::stage("test-dual-steep", "trace");
    EXPECT_NO_THROW(render_tests::take(render, scene, {"exact", "derr"}));
    scene.materials[0].trace = render_tests::stage("test-half-way-plain", "trace");
    try {
        render_tests::take(render, scene, {"exact.dUVdx", "derr.dhitUVdy"});
        FAIL();
    } catch (const UsageError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("\"derr.dhitUVdy.U\""), std::string::npos) << text;
        EXPECT_NE(text.find("\"test-half-way-plain\""), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos);
    }
    // What comes before it is served.
    EXPECT_NO_THROW(render_tests::take(render, scene, {"A", "exact.dUVdx", "derr.lod"}));
}

}  // namespace
}  // namespace quadrel::plugin_tests
