// Shaders of one's own, in a program: any text over a number type, most simply a generic lambda.
//
//     using namespace quadrel;
//     using F = Quad<float>;                       // or Quad<double>, or Quad<Dual>: testing.hpp
//
//     // over one quad (testing.hpp: derivatives, mip levels, texels)
//     auto quad = unit::run_quad<F>(10, 20, [](const auto& xy) { return xy * 0.25f; });
//
//     // over a triangle: vertices as a vertex shader writes them
//     const std::array<ShaderVertex<2>, 3> triangle{{{{-1, -1, 0, 1}, {0, 0}},
//                                                    {{1, -1, 0, 1}, {1, 0}},
//                                                    {{0, 1, 0, 1}, {0, 1}}}};
//     auto picture = draw_triangle<F>({64, 64}, triangle, [](const auto& in) {
//         const auto uv = in.varying2(0);
//         return fwidth(uv.x) * 64.0f + uv.y;
//     }, 0.0f);
//     picture.at(32, 32);                          // a float
//
//     // the same quad by quad, over a raster state of one's own, with a texture
//     const SampledTexture t = texture_of_texels(texels, 2, 2);       // texture/of_texels.hpp
//     const RasterState state = raster_state({64, 64, Conventions::d3d},
//                                            hardware_model(Hardware::exact), Cull::back);
//     for (const auto& quad : shade_triangle<F>(state, triangle, [&](const auto& in) {
//              return texture(t, {}, in.varying2(0));   // its level from the quad's derivatives
//          }))
//         for (int lane = 0; lane < 4; ++lane)
//             if (quad.covered(lane))              // window coordinates, and an rgba
//                 use(lane_x(quad.coverage, lane), lane_y(quad.coverage, lane), quad.result[lane]);
//
//     // over a scene: stages (quad/stage.hpp), named in it by their ids
//     register_stages<MyStage>();
//     render(load_scene("bricks-45", {"material.relief.trace=my-stage"}), {});
//
// Plain numbers only: lanes of SIMD need the compiler flags of their instruction set, and come with
// a plugin (plugin.hpp).
#pragma once

#include <array>
#include <vector>

#include "quadrel/num/math.hpp"
#include "quadrel/raster/interpolation.hpp"
#include "quadrel/raster/quad_points.hpp"
#include "quadrel/raster/triangle_quads.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/testing.hpp"

namespace quadrel {

/// A vertex: clip-space position, and n floats to be interpolated perspective-correctly.
template <int n>
struct ShaderVertex {
    vec4<float> position;
    std::array<float, n> varyings;
};

/// What a fragment shader is given: the four fragments of a quad. Lanes that the triangle does not
/// cover are helpers, with extrapolated values.
template <Packet F, int n>
struct Fragments {
    vec4<F> frag_coord;  ///< pixel centre in window coordinates, window depth, 1 / clip w
    std::array<F, n> varyings;
    Mask<F> covered;
    bool front_facing;

    /// Throws std::out_of_range, as the next three.
    const F& varying(std::size_t i) const { return varyings.at(i); }
    /// Varyings i, i + 1 and so on, as one vector.
    vec2<F> varying2(std::size_t i) const { return {varyings.at(i), varyings.at(i + 1)}; }
    vec3<F> varying3(std::size_t i) const {
        return {varyings.at(i), varyings.at(i + 1), varyings.at(i + 2)};
    }
    vec4<F> varying4(std::size_t i) const {
        return {varyings.at(i), varyings.at(i + 1), varyings.at(i + 2), varyings.at(i + 3)};
    }
};

/// What a shader gave for one quad: which lanes count, and its value with all derivatives.
template <class V>
struct ShadedQuad {
    QuadCoverage coverage;
    unit::QuadResult<V> result;

    bool covered(int lane) const { return coverage.samples[static_cast<std::size_t>(lane)] != 0; }
};

namespace detail {

/// A piece's attributes as the interpolation reads them.
template <Packet F, int n>
class PieceVaryings {
  public:
    PieceVaryings(const AssembledTriangle& piece, const std::array<ShaderVertex<n>, 3>& triangle)
        : screen_(piece.screen) {
        for (int v = 0; v < 3; ++v) {
            const auto vertex = static_cast<std::size_t>(v);
            const auto& weight = piece.weights[vertex].perspective;
            for (std::size_t i = 0; i < n; ++i)
                values_[i][vertex] = weigh(weight, triangle[0].varyings[i], triangle[1].varyings[i],
                                           triangle[2].varyings[i]);
        }
    }

    Fragments<F, n> fragments(const QuadCoverage& quad) const {
        const EdgeValues<F> e = edges(quad);
        const PerVertex<F> w{F(screen_.vertex[0].w), F(screen_.vertex[1].w),
                             F(screen_.vertex[2].w)};
        const Barycentrics<F> b = perspective_barycentrics(e, w);
        Fragments<F, n> in{
            coordinates(quad, interpolate_w(e, w)), {}, covered(quad), screen_.front_facing};
        for (std::size_t i = 0; i < n; ++i)
            in.varyings[i] =
                interpolate(b, PerVertex<F>{F(values_[i][0]), F(values_[i][1]), F(values_[i][2])});
        return in;
    }

  private:
    EdgeValues<F> edges(const QuadCoverage& quad) const {
        double e[3][4];
        attribute_edges(screen_, quad_centres(quad.x, quad.y), e[0], e[1], e[2]);
        const EdgeSlopes s = edge_slopes(screen_);
        const auto edge = [&](int i) { return changing(load_wide<F>(e[i]), s.dx[i], s.dy[i]); };
        return {edge(0), edge(1), edge(2)};
    }
    /// With its derivatives, where the number type carries them.
    template <class Packet>
    static Packet changing(const Packet& value, double dx, double dy) {
        if constexpr (Differentiated<F>)
            return with_derivatives(value, dx, dy);
        else
            return value;
    }
    vec4<F> coordinates(const QuadCoverage& quad, F w) const {
        const QuadPoints centres = quad_centres(quad.x, quad.y);
        Scalar<F> x[4], y[4], z[4];
        for (int lane = 0; lane < 4; ++lane) {
            const auto i = static_cast<std::size_t>(lane);
            x[i] = static_cast<Scalar<F>>(lane_x(quad, lane)) + Scalar<F>(0.5);
            y[i] = static_cast<Scalar<F>>(lane_y(quad, lane)) + Scalar<F>(0.5);
            z[i] = static_cast<Scalar<F>>(depth_at(screen_, centres.x[i], centres.y[i]));
        }
        const EdgeSlopes s = edge_slopes(screen_);
        return {changing(load<F>(x), 1, 0), changing(load<F>(y), 0, 1),
                changing(load<F>(z), s.dx[1] * screen_.depth1 + s.dx[2] * screen_.depth2,
                         s.dy[1] * screen_.depth1 + s.dy[2] * screen_.depth2),
                F(1) / w};
    }
    static Mask<F> covered(const QuadCoverage& quad) {
        std::uint32_t lanes[4];
        for (std::size_t i = 0; i < 4; ++i) lanes[i] = quad.samples[i];
        return load_mask<F>(lanes);
    }

    const ScreenTriangle& screen_;
    std::array<std::array<float, 3>, n> values_{};
};

}  // namespace detail

/// Runs `shader(fragments)` for every quad that the triangle covers a pixel of, and gives what it
/// returned: a packet of F, or a vector of them. Clipping, snapping, fill rule and interpolation
/// are those of `render`, bit for bit. F is Quad<float>, Quad<double> or Quad<Dual>, on which every
/// varying has its exact derivatives.
template <Packet F, int n, class Shader>
auto shade_triangle(const RasterState& state, const std::array<ShaderVertex<n>, 3>& triangle,
                    const Shader& shader) {
    static_assert(lanes_of<F> == 4, "plain numbers: Quad<float>, Quad<double> or Quad<Dual>");
    using V = std::decay_t<decltype(shader(std::declval<const Fragments<F, n>&>()))>;
    std::vector<ShadedQuad<V>> out;
    for (const TriangleQuads& part : triangle_quads(
             {triangle[0].position, triangle[1].position, triangle[2].position}, state)) {
        const detail::PieceVaryings<F, n> varyings(part.piece, triangle);
        for (const QuadCoverage& quad : part.quads)
            out.push_back({quad, {shader(varyings.fragments(quad))}});
    }
    return out;
}

/// One value per pixel, in image coordinates: from the top-left, whatever the conventions.
template <class V>
struct DrawnPicture {
    int width = 0, height = 0;
    std::vector<V> pixels;

    /// Throws std::out_of_range.
    const V& at(int x, int y) const { return pixels.at(index(x, y)); }
    V& at(int x, int y) { return pixels.at(index(x, y)); }

  private:
    std::size_t index(int x, int y) const {
        if (x < 0 || x >= width || y < 0) return pixels.size();
        return std::size_t(y) * std::size_t(width) + std::size_t(x);
    }
};

/// shade_triangle as a picture of `background` with the covered pixels' values on it.
template <Packet F, int n, class Shader, class V>
DrawnPicture<V> draw_triangle(const Viewport& viewport,
                              const std::array<ShaderVertex<n>, 3>& triangle, const Shader& shader,
                              const V& background) {
    DrawnPicture<V> picture{
        viewport.width, viewport.height,
        std::vector<V>(std::size_t(viewport.width) * std::size_t(viewport.height), background)};
    const RasterState state = raster_state(viewport, hardware_model(Hardware::exact));
    for (const auto& quad : shade_triangle<F>(state, triangle, shader))
        for (int lane = 0; lane < 4; ++lane)
            if (quad.covered(lane))
                picture.at(lane_x(quad.coverage, lane),
                           flip_row(viewport, lane_y(quad.coverage, lane))) = quad.result[lane];
    return picture;
}

}  // namespace quadrel
