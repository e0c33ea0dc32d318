// What vertex programs read, made for the quads of a batch: object space is eye space unless a test
// says otherwise.
#pragma once

#include "relief/inputs.hpp"

namespace quadrel::test {

/// Tangent, binormal and normal of a vertex.
struct VertexAxes {
    dvec3 T, B, N;
};

inline void set3(float (&to)[3], const dvec3& from) {
    for (int c = 0; c < 3; ++c) to[c] = static_cast<float>(from[c]);
}

/// The row of a whole triangle, without transforms.
inline PrimitiveVertices vertex_row(const std::array<dvec3, 3>& position,
                                    const std::array<VertexAxes, 3>& axes) {
    PrimitiveVertices row{};
    for (std::size_t v = 0; v < 3; ++v) {
        set3(row.position[v], position[v]);
        set3(row.tangent[v], axes[v].T);
        set3(row.binormal[v], axes[v].B);
        set3(row.normal[v], axes[v].N);
        row.weights[v][v] = 1;
        row.to_eye[5 * v] = row.to_object[5 * v] = 1;
    }
    return row;
}

/// A triangle of its own for the quad, whose four lanes lie at P.
template <PlainFloat T>
void set_quad_vertices(Batch<T>& batch, int quad, const dvec3& P,
                       const std::array<VertexAxes, 3>& axes) {
    batch.primitives.resize(static_cast<std::size_t>(batch.lanes / 4));
    batch.vertices.resize(batch.primitives.size());
    const auto q = static_cast<std::size_t>(quad);
    const dvec3 a = axes[0].T * 0.25, b = axes[0].B * 0.25;
    batch.primitives[q] = {};
    for (float& w : batch.primitives[q].w) w = 1;
    // a quarter of the first two and half of the third
    batch.vertices[q] = vertex_row({P + a * 2.0, P + b * 2.0, P - a - b}, axes);
    for (int lane = 4 * quad; lane < 4 * quad + 4; ++lane) {
        batch.primitive[lane] = quad;
        batch.edges[0][lane] = batch.edges[1][lane] = 0.25;
        batch.edges[2][lane] = 0.5;
    }
}

/// The same axes at all three.
template <PlainFloat T>
void set_quad_vertices(Batch<T>& batch, int quad, const dvec3& P, const VertexAxes& axes) {
    set_quad_vertices(batch, quad, P, {axes, axes, axes});
}

/// A curved surface in perspective: every vertex turns its axes its own way, the three clip ws
/// differ, and the lanes lie apart, some of them outside of the triangle.
inline void bend_vertices(Batch<float>& batch, Random& random) {
    for (std::size_t quad = 0; quad < batch.vertices.size(); ++quad) {
        PrimitiveVertices& row = batch.vertices[quad];
        for (std::size_t v = 0; v < 3; ++v) {
            for (float(*axes)[3] : {row.tangent, row.binormal, row.normal})
                for (float& x : axes[v]) x += static_cast<float>(random.uniform(-0.1, 0.1));
            batch.primitives[quad].w[v] = static_cast<float>(random.uniform(1, 3));
        }
        for (std::size_t lane = 4 * quad; lane < 4 * quad + 4; ++lane)
            for (auto& edge : batch.edges) edge[lane] = static_cast<float>(random.uniform(-1, 40));
    }
}

}  // namespace quadrel::test
