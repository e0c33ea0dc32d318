// A shader over a triangle sees what a render of that triangle sees.
#include "quadrel/shader.hpp"

#include "plugin/planted.hpp"
#include "plugin/support.hpp"

namespace quadrel::plugin_tests {
namespace {

using render_tests::bits;
using F = Quad<float>;
using Triangle = std::array<ShaderVertex<2>, 3>;
using UvQuads = std::vector<ShadedQuad<vec2<F>>>;

Scene triangle_scene(const glm::vec3& eye, Conventions conventions) {
    Scene scene = render_tests::empty_scene(37, 27);
    scene.conventions = conventions;
    render_tests::set_perspective_camera(scene, eye, {.near = 0.5, .far = 50});
    scene.materials = {render_tests::plain_material("plain")};
    render_tests::add_object(
        scene, render_tests::triangle({-1, -0.8f, 0.3f}, {1.2f, -0.5f, -0.4f}, {0.1f, 1, 0}), 0);
    return scene;
}

/// The scene's triangle after the vertex stage.
Triangle shaded_vertices(const Scene& scene) {
    Triangle triangle;
    const Mesh& mesh = scene.meshes[0];
    const glm::mat4 model_view = scene.camera.view * scene.objects[0].transform;
    for (std::size_t v = 0; v < 3; ++v) {
        const glm::vec4 eye = model_view * glm::vec4(mesh.positions[v], 1.0f);
        triangle[v] = {scene.camera.projection * eye, {mesh.uvs[v].x, mesh.uvs[v].y}};
    }
    return triangle;
}

RasterState state_of(const Scene& scene) {
    return raster_state({scene.width, scene.height, scene.conventions},
                        hardware_model(scene.hardware));
}

UvQuads uv_quads(const Scene& scene) {
    return shade_triangle<F>(state_of(scene), shaded_vertices(scene),
                             [](const auto& in) { return in.varying2(0); });
}

std::uint32_t float_bits(float x) { return std::bit_cast<std::uint32_t>(x); }

/// Texture coordinates and their differences in all covered pixels, which are all there are.
testing::AssertionResult agrees_with_render(const Scene& scene, const UvQuads& quads) {
    RenderOptions options;
    options.channels = {"A", "uv", "dUVdx", "dUVdy"};
    const Film film = render(scene, options);
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    int covered = 0, differ = 0;
    for (const auto& quad : quads) {
        for (int lane = 0; lane < 4; ++lane) {
            if (!quad.covered(lane)) continue;
            const int x = lane_x(quad.coverage, lane);
            const int y = flip_row(viewport, lane_y(quad.coverage, lane));
            ++covered;
            const auto same = [&](const std::string& channel, const vec2<float>& v) {
                return bits(film, channel + ".U", x, y) == float_bits(v.x) &&
                       bits(film, channel + ".V", x, y) == float_bits(v.y);
            };
            differ += !same("uv", quad.result[lane]) ||
                      !same("dUVdx", quad.result.dFdx_fine(lane)) ||
                      !same("dUVdy", quad.result.dFdy_fine(lane));
        }
    }
    const Plane* alpha = film.find("A");
    const auto drawn = std::count(alpha->bits.begin(), alpha->bits.end(), float_bits(1.0f));
    if (covered == 0 || covered != drawn || differ != 0)
        return testing::AssertionFailure()
               << covered << " covered, " << drawn << " drawn, " << differ << " differ";
    return testing::AssertionSuccess();
}

TEST(TriangleShader, SeesWhatARenderSees) {
    for (const Conventions conventions : {Conventions::gl, Conventions::vulkan, Conventions::d3d}) {
        for (const glm::vec3 eye : {glm::vec3(0.2f, 0.4f, 3), glm::vec3(0.3f, 0.2f, 0.7f)}) {
            const Scene scene = triangle_scene(eye, conventions);
            UvQuads quads = uv_quads(scene);
            EXPECT_TRUE(agrees_with_render(scene, quads));
            ASSERT_GT(quads.size(), 2u);
            std::swap(quads[0].result, quads[1].result);
            EXPECT_FALSE(agrees_with_render(scene, quads))
                << static_cast<int>(Planted::shifted_quad);
        }
    }
}

/// The near plane cuts the second view's triangle: the pieces share no pixel.
TEST(TriangleShader, PiecesOfAClippedTriangleShareNoPixel) {
    const Scene scene = triangle_scene({0.3f, 0.2f, 0.7f}, Conventions::gl);
    const Triangle triangle = shaded_vertices(scene);
    const auto pieces = triangle_quads(
        {triangle[0].position, triangle[1].position, triangle[2].position}, state_of(scene));
    EXPECT_GT(pieces.size(), 1u);
    std::vector<int> owners(std::size_t(scene.width) * std::size_t(scene.height), 0);
    for (const auto& quad : uv_quads(scene))
        for (int lane = 0; lane < 4; ++lane)
            if (quad.covered(lane))
                ++owners[std::size_t(lane_y(quad.coverage, lane)) * std::size_t(scene.width) +
                         std::size_t(lane_x(quad.coverage, lane))];
    EXPECT_EQ(std::count_if(owners.begin(), owners.end(), [](int n) { return n > 1; }), 0);
}

// ---- A triangle whose every value is known ------------------------------------------------------

/// Covers the lower left half of a 16x16 window; the varyings are window x and y.
const Triangle half{{{{-1, -1, 0, 1}, {0, 0}}, {{1, -1, 0, 1}, {16, 0}}, {{-1, 1, 0, 1}, {0, 16}}}};

template <class Number>
void varyings_are_window_coordinates() {
    const auto state = raster_state({16, 16}, hardware_model(Hardware::exact));
    int helpers = 0;
    const auto quads = shade_triangle<Number>(state, half, [&](const auto& in) {
        helpers += count(!in.covered);
        EXPECT_TRUE(in.front_facing);
        EXPECT_TRUE(all(in.frag_coord.w == Number(1)));
        EXPECT_TRUE(all(in.frag_coord.z == Number(0.5f)));
        EXPECT_TRUE(all(in.varying(0) == in.frag_coord.x) && all(in.varying(1) == in.frag_coord.y));
        return vec3<Number>(in.varying2(0), dFdx(in.varying(0)) + dFdy(in.varying(1)));
    });
    EXPECT_GT(helpers, 0);
    for (const auto& quad : quads) EXPECT_EQ(quad.result[3].z, 2);
    EXPECT_EQ(quads.size(), 36u);  // of 8x8, those on or below the diagonal
}

TEST(TriangleShader, InterpolatesInFloatAndDouble) {
    varyings_are_window_coordinates<Quad<float>>();
    varyings_are_window_coordinates<Quad<double>>();
}

TEST(TriangleShader, TakesVaryingsAsVectors) {
    const std::array<ShaderVertex<6>, 3> triangle{{{{-1, -1, 0, 1}, {1, 2, 3, 4, 5, 6}},
                                                   {{1, -1, 0, 1}, {2, 3, 5, 7, 11, 13}},
                                                   {{-1, 1, 0, 1}, {1, 2, 3, 4, 5, 6}}}};
    const auto state = raster_state({4, 4}, hardware_model(Hardware::exact));
    shade_triangle<F>(state, triangle, [](const auto& in) {
        const vec3<F> three = in.varying3(3);
        const vec4<F> four = in.varying4(1);
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_TRUE(all(three[static_cast<int>(k)] == in.varying(3 + k)));
        EXPECT_TRUE(all(four.x == in.varying(1)) && all(four.y == in.varying(2)));
        EXPECT_TRUE(all(four.z == in.varying(3)) && all(four.w == in.varying(4)));
        EXPECT_THROW(in.varying4(3), std::out_of_range);
        return F(0);
    });
}

TEST(TriangleShader, DrawsAPictureFromTheTopLeft) {
    const auto y = [](const auto& in) { return in.varying(1); };
    const DrawnPicture<float> up = draw_triangle<F>({16, 16}, half, y, -1.0f);
    EXPECT_EQ(up.at(0, 15), 0.5f);
    EXPECT_EQ(up.at(0, 1), 14.5f);
    EXPECT_EQ(up.at(15, 0), -1.0f);
    const DrawnPicture<float> down =
        draw_triangle<F>({16, 16, Conventions::vulkan}, half, y, -1.0f);
    EXPECT_EQ(down.at(0, 0), 0.5f);
    EXPECT_EQ(down.at(15, 15), -1.0f);
    EXPECT_THROW(up.at(16, 0), std::out_of_range);
}

/// The example at the head of shader.hpp, and what it comes to.
TEST(TriangleShader, ExampleOfTheHeader) {
    const auto quad = unit::run_quad<F>(10, 20, [](const auto& xy) { return xy * 0.25f; });
    EXPECT_EQ(quad.dFdx_fine(0), vec2<float>(0.25f, 0));
    const std::array<ShaderVertex<2>, 3> triangle{
        {{{-1, -1, 0, 1}, {0, 0}}, {{1, -1, 0, 1}, {1, 0}}, {{0, 1, 0, 1}, {0, 1}}}};
    const auto picture = draw_triangle<F>(
        {64, 64}, triangle,
        [](const auto& in) {
            const auto uv = in.varying2(0);
            return fwidth(uv.x) * 64.0f + uv.y;
        },
        0.0f);
    // u grows by 1/64 per column and falls by 1/128 per row: 1 + 1/2; v at the middle row: 31.5/64.
    EXPECT_NEAR(picture.at(32, 32), 1.5f + 31.5f / 64, 1e-5f);
    EXPECT_EQ(picture.at(0, 0), 0.0f);
}

TEST(TriangleShader, CullsWhatItIsToldTo) {
    const auto none = [](const auto& in) { return in.varying(0); };
    const Viewport window{16, 16};
    const auto model = hardware_model(Hardware::exact);
    EXPECT_FALSE(shade_triangle<F>(raster_state(window, model, Cull::back), half, none).empty());
    EXPECT_TRUE(shade_triangle<F>(raster_state(window, model, Cull::front), half, none).empty());
}

}  // namespace
}  // namespace quadrel::plugin_tests
