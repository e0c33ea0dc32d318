// Vertex programs: what a text computes at the vertices, interpolated to its fragments.
//
// Listings of before per-fragment frames transform vectors into tangent space in their vertex
// shader, and hand on the result to be interpolated. On curved meshes and on sheared maps that is
// another vector than the one that a fragment makes of its interpolated position and frame. A stage
// that declares
//     static constexpr bool reads_vertices = true;
// says such a program where it needs the varying:
//     const VertexProgram program(io);
//     const vec3<F> to_eye = program.varying([&](const Vertex<F>& vertex) {
//         const vec3<F> eye = program.point_to_object(vec3<F>(F(0)));
//         return vertex.in_tangent_space(eye - vertex.position);
//     });
// The program runs at the three vertices of the triangle as it was submitted. Where the near plane
// or a guard band has cut it, the outputs are weighed for the vertices of the piece, as a clipper
// does; then they are interpolated as every varying is.
#pragma once

#include "quadrel/quad/interpolate.hpp"

namespace quadrel {

/// Attributes of one vertex of every lane's triangle, in object space. Tangent and binormal are
/// unit vectors along growing u and v: the mesh's own or, where it has none or a texture matrix
/// turns its UV, the averages of scene/tangents.hpp, normalised; null where the UV map is
/// degenerate. The normal has the length that the mesh gives it.
template <Number F>
struct Vertex {
    vec3<F> position, normal, tangent, binormal;
    vec2<F> uv;

    /// A vector along tangent, binormal and normal.
    vec3<F> in_tangent_space(const vec3<F>& v) const {
        return {dot(v, tangent), dot(v, binormal), dot(v, normal)};
    }
};

namespace detail {
/// Bytes of a row as an offset in floats.
constexpr int floats(std::size_t bytes) { return static_cast<int>(bytes / sizeof(float)); }
}  // namespace detail

/// A packet's view of the vertices of its triangles.
template <class Io>
class VertexProgram {
    static_assert(Io::reads_vertices, "the stage does not declare reads_vertices");

  public:
    using F = typename Io::Number;

    explicit VertexProgram(const Io& io)
        : row_(io.call(), io.first_lane(), io.call().vertices), interpolated_(interpolator(io)) {}

    /// The object's transforms: model view for points and vectors, the transpose of its inverse for
    /// normals, and back. Linear in float; nothing is normalised.
    vec3<F> point_to_eye(const vec3<F>& p) const { return affine(to_eye, p, F(1)); }
    vec3<F> vector_to_eye(const vec3<F>& v) const { return affine(to_eye, v, F(0)); }
    vec3<F> point_to_object(const vec3<F>& p) const { return affine(to_object, p, F(1)); }
    vec3<F> vector_to_object(const vec3<F>& v) const { return affine(to_object, v, F(0)); }
    vec3<F> normal_to_eye(const vec3<F>& n) const {
        return row3(to_object) * n.x + row3(to_object + 4) * n.y + row3(to_object + 8) * n.z;
    }

    /// What `text` gives for a vertex, F or a vector of F, perspective-correct at every fragment.
    template <class Text>
    auto varying(const Text& text) const {
        const auto a = text(vertex(0)), b = text(vertex(1)), c = text(vertex(2));
        using Output = std::decay_t<decltype(a)>;
        const PerVertex<Output> piece{weigh(0, a, b, c, a), weigh(1, a, b, c, b),
                                      weigh(2, a, b, c, c)};
        return interpolated_(piece);
    }

  private:
    static constexpr int to_eye = detail::floats(offsetof(PrimitiveVertices, to_eye));
    static constexpr int to_object = detail::floats(offsetof(PrimitiveVertices, to_object));

    vec3<F> row3(int at) const { return {row_.at(at), row_.at(at + 1), row_.at(at + 2)}; }
    vec3<F> affine(int rows, const vec3<F>& v, F w) const {
        const auto row = [&](int r) {
            return dot(row3(rows + 4 * r), v) + row_.at(rows + 4 * r + 3) * w;
        };
        return {row(0), row(1), row(2)};
    }
    Vertex<F> vertex(int v) const {
        const auto attribute = [&](std::size_t bytes) {
            return row3(detail::floats(bytes) + 3 * v);
        };
        constexpr int uv = detail::floats(offsetof(PrimitiveVertices, uv));
        return {attribute(offsetof(PrimitiveVertices, position)),
                attribute(offsetof(PrimitiveVertices, normal)),
                attribute(offsetof(PrimitiveVertices, tangent)),
                attribute(offsetof(PrimitiveVertices, binormal)),
                {row_.at(uv + 2 * v), row_.at(uv + 2 * v + 1)}};
    }
    /// The output at vertex v of the piece; `own`, bit for bit, where it is the triangle's.
    template <class Output>
    Output weigh(int v, const Output& a, const Output& b, const Output& c,
                 const Output& own) const {
        constexpr int weights = detail::floats(offsetof(PrimitiveVertices, weights));
        const F wa = row_.at(weights + 3 * v), wb = row_.at(weights + 3 * v + 1),
                wc = row_.at(weights + 3 * v + 2);
        const F whole = row_.at(weights + 4 * v);
        return select(whole == F(1), own, a * wa + b * wb + c * wc);
    }

    PrimitiveReader<F> row_;
    Interpolator<F> interpolated_;
};

template <class Io>
VertexProgram(const Io&) -> VertexProgram<Io>;

}  // namespace quadrel
