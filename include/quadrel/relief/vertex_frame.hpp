// Vectors in tangent space from the vertices: what the vertex programs of listings hand on.
//
// Sources: T. Welsh, "Parallax Mapping with Offset Limiting", 2004, 4.2 and 7; M. McGuire, G3D,
// BumpMapViewer/bump.vert, 2004, which has the names (_tsE, tan_X, wsEyePos) of the shader of
// "Steep Parallax Mapping", 2005, whose page does not show one. Both take the difference of two
// points in object space along the vertex' tangent, binormal and normal, and do not normalise it.
#pragma once

#include "quadrel/quad/vertex_program.hpp"
#include "quadrel/relief/view.hpp"

namespace quadrel {

/// The interpolated vector to a point of eye space, along tangent, binormal and normal of the
/// vertices. The stage declares reads_vertices.
template <class Io, class F = typename Io::Number>
vec3<F> vertex_vector_to(const Io& io, const vec3<F>& point) {
    const VertexProgram program(io);
    const vec3<F> target = program.point_to_object(point);
    return program.varying(
        [&](const Vertex<F>& vertex) { return vertex.in_tangent_space(target - vertex.position); });
}

/// The interpolated vector to the eye: the origin of eye space, also where a projection is
/// parallel, as the listings' last row of the inverse transpose of the modelview matrix.
template <class Io, class F = typename Io::Number>
vec3<F> vertex_eye(const Io& io) {
    return vertex_vector_to(io, vec3<F>(F(0)));
}

}  // namespace quadrel
