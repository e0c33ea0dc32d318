// What the fragment shader of Rabbid76's prisms sees: the triangles that its geometry shader emits,
// and the view ray in their texture space.
//
// Source: Rabbid76, graphics-snippets, example/python/parallax,
// parallax_010_generalized_disp_mapping_geo_tbn, displacement_map.geom and displacement_map.frag.
// Of each triangle the geometry shader makes the triangle itself, of height 0, and a strip of two
// triangles over each edge, from height 0 at P_i to height 1 at P_i + scale N_i; no top. Varyings
// are pos, uvh, and the columns nv = scale N_i, tv, bv of a matrix: gradients of u and v in the
// triangle's plane turned by each N_i, times twice its area and without its area in the texture.
// As published; which errors that makes is said in prism_gs_published.hpp. Of d only the sign of z
// is ever used: whether a side's plane faces the eye. The distances to the prism's sides, that of
// the top and col are computed and dropped, there and so not here.
#pragma once

#include "quadrel/quad/interpolate.hpp"
#include "quadrel/relief/frame/rabbid_direction.hpp"

namespace quadrel {

/// An emitted triangle, in the place of the PrimitiveVertices of a triangle of the mesh. Names are
/// the listing's; pos and uvh.st are the PrimitiveData's.
struct PrismStrip {
    float nv[3][3], tv[3][3], bv[3][3];  ///< at the vertices of the piece
    float height[3];                     ///< uvh.p
    float side[3];                       ///< d.z on sides: 1 where one faces the eye, else -1 or 0
    float front_facing;                  ///< gl_FrontFacing: 1 or -1
    float unused[46];
};
static_assert(sizeof(PrismStrip) == sizeof(PrimitiveVertices), "rows of one array");

/// What a packet reads of its rows.
template <Number F>
class StripRows {
  public:
    template <class Io>
    explicit StripRows(const Io& io)
        : row_(io.call(), io.first_lane(), reinterpret_cast<const PrismStrip*>(io.call().vertices)),
          interpolated_(interpolator(io)) {
        static_assert(Io::reads_vertices, "the stage does not declare reads_vertices");
    }

    vec3<F> nv() const { return vector(offsetof(PrismStrip, nv)); }
    vec3<F> tv() const { return vector(offsetof(PrismStrip, tv)); }
    vec3<F> bv() const { return vector(offsetof(PrismStrip, bv)); }
    F height() const { return interpolated_.at(row_, at(offsetof(PrismStrip, height)), 1); }
    F side() const { return interpolated_.at(row_, at(offsetof(PrismStrip, side)), 1); }
    F front_facing() const { return row_.at(at(offsetof(PrismStrip, front_facing))); }

  private:
    static constexpr int at(std::size_t bytes) { return static_cast<int>(bytes / sizeof(float)); }
    vec3<F> vector(std::size_t bytes) const {
        return interpolated_.template vector<3>(row_, at(bytes));
    }

    PrimitiveReader<F> row_;
    Interpolator<F> interpolated_;
};

/// The variables of the listing's main, named as there.
template <Number F>
struct PrismStripVaryings {
    vec3<F> objPosEs, texCoords;
    F d_z, frontFace, invmax;
    mat3<F> tbnMat, inv_tbnMat;
    vec3<F> tbnDir;

    template <class Io>
    explicit PrismStripVaryings(const Io& io) {
        const StripRows<F> row(io);
        objPosEs = io.template load<Value::P>();
        texCoords = vec3<F>(io.template load<Value::uv>(), row.height());
        d_z = row.side();
        frontFace = select(texCoords.z > F(0), F(1), row.front_facing());
        const vec3<F> N = row.nv() * frontFace, T = row.tv(), B = row.bv();
        invmax = inversesqrt(max(dot(T, T), dot(B, B)));
        tbnMat = mat3<F>(T * invmax, B * invmax, N * invmax);
        inv_tbnMat = inverse(tbnMat);
        tbnDir = normalize(inv_tbnMat * objPosEs);
    }

    /// tbnMat * tex_offst / invmax.
    vec3<F> displ_vec(const vec3<F>& tex_offst) const { return (tbnMat * tex_offst) / invmax; }
};

/// What it loads.
inline constexpr auto prism_strip_inputs = values(Value::P, Value::uv);

}  // namespace quadrel
