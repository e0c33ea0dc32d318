// The shell over a mesh, as its fragments see it.
//
// Over each triangle of the mesh lies a prism between P_i - seat D N_i and P_i + (1 - seat) D N_i.
// Three tetrahedra make it up, whose diagonals run from the bottom at the vertex that comes first
// to the top at the one that comes later, so that neighbours agree on the faces between them. What
// is drawn are the faces by which rays enter tetrahedra; in a tetrahedron uv and the depth below
// the shell's top, s, are affine functions of position, and a ray is a straight piece of texture
// space.
//
// Sources: J. Hirche, A. Ehlert, S. Guthe, M. Doggett, "Hardware Accelerated Per-Pixel Displacement
// Mapping", Graphics Interface 2004 (tetrahedra); J. Dompierre, P. Labbe, M.-G. Vallet, R.
// Camarero, "How to Subdivide Pyramids, Prisms and Hexahedra into Tetrahedra", 8th International
// Meshing Roundtable, 1999 (their order).
//
// How the tetrahedra differ from the prism with bilinear sides: there a point is P + (h - seat) D N
// with P and N interpolated over the triangle, and uv and h at a given point are roots of a cubic.
// Both agree at the corners and on top and bottom. With weights a, b, c of the vertices in order,
// the tetrahedra have the point of (a, b, c, h) at
//     sum of bottoms + D (rise_a N_a + rise_b N_b + rise_c N_c),
// where the rises add up to h: as much of it as its weight to the last vertex, then to the one
// before. That is off by D times a difference of means of the normals of which no weight is above
// 1/4: at most D / 4 max |N_i - N_j|, half as much over edges half as long. Where sides twist,
// neighbours still share their triangles: there are no gaps. bench/README.md has a table.
#pragma once

#include "quadrel/quad/interpolate.hpp"

namespace quadrel {

/// A face of a tetrahedron, in the place of the PrimitiveVertices of a triangle of the mesh. The
/// face's corners are counted from 0 to 2; the tetrahedron's fourth lies opposite. Clipping cuts
/// faces as it does triangles. All in eye space and world units.
struct ShellFace {
    float s[3];            ///< depth below the shell's top, 0 to 1, at the vertices of the piece
    float weights[3][3];   ///< of the face's corners, at each vertex of the piece
    float gradient[3][3];  ///< of the barycentric coordinates of the face's corners
    float J[6];            ///< gradients of u and v
    float s_gradient[3];   ///< gradient of s
    float to_floor;        ///< which of the face's corners lies opposite of the bottom; -1: none
    float snap;            ///< pixels from one place of the window's lattice to the next
    float unused[47];
    std::int32_t cell;  ///< row of its tetrahedron (shell_cell.hpp); -1 where nothing reads it
};
static_assert(sizeof(ShellFace) == sizeof(PrimitiveVertices), "rows of one array");

/// What a packet reads of its rows.
template <Number F>
class ShellFaces {
  public:
    template <class Io>
    explicit ShellFaces(const Io& io)
        : row_(io.call(), io.first_lane(), reinterpret_cast<const ShellFace*>(io.call().vertices)),
          interpolated_(interpolator(io)) {
        static_assert(Io::reads_vertices, "the stage does not declare reads_vertices");
    }

    /// Depth below the shell's top where the ray enters.
    F s() const { return interpolated_.at(row_, at(offsetof(ShellFace, s)), 1); }
    /// Barycentric coordinate of corner `k` there; that of the fourth is 0.
    F weight(int k) const {
        return interpolated_.at(row_, at(offsetof(ShellFace, weights)) + k, 3);
    }
    vec3<F> gradient(int k) const { return vector(at(offsetof(ShellFace, gradient)) + 3 * k); }
    vec3<F> grad_u() const { return vector(at(offsetof(ShellFace, J))); }
    vec3<F> grad_v() const { return vector(at(offsetof(ShellFace, J)) + 3); }
    vec3<F> s_gradient() const { return vector(at(offsetof(ShellFace, s_gradient))); }
    F snap() const { return row_.at(at(offsetof(ShellFace, snap))); }
    F to_floor() const { return row_.at(at(offsetof(ShellFace, to_floor))); }

  private:
    static constexpr int at(std::size_t bytes) { return static_cast<int>(bytes / sizeof(float)); }
    vec3<F> vector(int first) const {
        return {row_.at(first), row_.at(first + 1), row_.at(first + 2)};
    }

    PrimitiveReader<F> row_;
    Interpolator<F> interpolated_;
};

}  // namespace quadrel
