// A prism of the shell over a mesh, as its fragments see it, without a split in tetrahedra: what
// prism-gs goes through.
//
// Over a triangle of corners a, b, c, in the order of shell_face.hpp, lies the prism of bottoms
// P_i - seat D N_i and tops P_i + (1 - seat) D N_i. Its surface is made of eight triangles: bottom,
// top, and two a side, along the diagonal from the bottom of the corner that comes first, so that
// neighbours agree on them. What is drawn are the triangles by which rays enter. Where a ray enters
// and leaves, u, v and s are those of the triangle there, linear; in between they are taken to be
// linear along the ray. (The tetrahedra bend a ray where it passes from one to the next.)
#pragma once

#include "quadrel/quad/interpolate.hpp"
#include "quadrel/relief/frame/store.hpp"

namespace quadrel {

/// A triangle of a prism's surface, in the place of the PrimitiveVertices of a triangle of the
/// mesh. Eye space and world units.
struct PrismFace {
    float s[3];           ///< depth below the shell's top, 0 to 1, at the vertices of the piece
    float weights[3][3];  ///< of the corners a, b, c, at each vertex of the piece
    float bottom[3][3], top[3][3];  ///< of a, b, c
    float uv[3][2];                 ///< likewise
    float turned;                   ///< 1: a, b, c run counter-clockwise seen from the top; -1: not
    float snap;                     ///< pixels from one place of the window's lattice to the next
    float unused[42];
};
static_assert(sizeof(PrismFace) == sizeof(PrimitiveVertices), "rows of one array");

/// The triangles of a prism's surface, outwards where a, b, c run counter-clockwise seen from the
/// top. Corners 0 to 2 are the bottoms of a, b, c, 3 to 5 their tops.
inline constexpr int prism_triangles[8][3] = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                                              {1, 2, 5}, {1, 5, 4}, {2, 0, 5}, {0, 3, 5}};

/// What a packet reads of its rows.
template <Number F>
class PrismFaces {
  public:
    template <class Io>
    explicit PrismFaces(const Io& io)
        : row_(io.call(), io.first_lane(), reinterpret_cast<const PrismFace*>(io.call().vertices)),
          interpolated_(interpolator(io)) {
        static_assert(Io::reads_vertices, "the stage does not declare reads_vertices");
    }

    F s() const { return interpolated_.at(row_, at(offsetof(PrismFace, s)), 1); }
    F weight(int k) const {
        return interpolated_.at(row_, at(offsetof(PrismFace, weights)) + k, 3);
    }
    /// 0 to 2: bottoms, 3 to 5: tops.
    vec3<F> corner(int k) const {
        const int first = at(offsetof(PrismFace, bottom)) + 3 * k;
        return {row_.at(first), row_.at(first + 1), row_.at(first + 2)};
    }
    vec2<F> uv(int k) const {
        const int first = at(offsetof(PrismFace, uv)) + 2 * k;
        return {row_.at(first), row_.at(first + 1)};
    }
    F turned() const { return row_.at(at(offsetof(PrismFace, turned))); }
    F snap() const { return row_.at(at(offsetof(PrismFace, snap))); }

  private:
    static constexpr int at(std::size_t bytes) { return static_cast<int>(bytes / sizeof(float)); }

    PrimitiveReader<F> row_;
    Interpolator<F> interpolated_;
};

/// The gradients of u, v and s where a ray enters a prism: those of
///     P(a, b, c, s) = sum of weights (bottom s + top (1 - s)),
/// exactly. Null where it has no volume there.
template <Number F>
struct PrismGradients {
    vec3<F> u, v, s;

    explicit PrismGradients(const PrismFaces<F>& face) {
        const F depth = face.s();
        vec3<F> at_height[3], up(F(0));
        for (int k = 0; k < 3; ++k) {
            const vec3<F> bottom = face.corner(k), rise = face.corner(k + 3) - bottom;
            at_height[k] = bottom + rise * (F(1) - depth);
            up = up + rise * face.weight(k);
        }
        vec3<F> to_b = at_height[1] - at_height[0], to_c = at_height[2] - at_height[0];
        const F size =
            max(largest_component(up), max(largest_component(to_b), largest_component(to_c)));
        const F scale = ordinary_scale(size);
        to_b = to_b * scale;
        to_c = to_c * scale;
        up = up * scale;
        const vec3<F> across_b = cross(to_c, up), across_c = cross(up, to_b);
        const F volume = dot(to_b, across_b);
        const F part = select(volume != F(0), scale / volume, F(0));
        const vec2<F> uv = face.uv(0), b = face.uv(1) - uv, c = face.uv(2) - uv;
        u = (across_b * b.x + across_c * c.x) * part;
        v = (across_b * b.y + across_c * c.y) * part;
        s = cross(to_b, to_c) * -part;
    }
};

}  // namespace quadrel
