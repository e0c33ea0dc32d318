// Varyings of a stage's own vertex program, against the same program in double; errors planted.
#include "quadrel/quad/vertex_program.hpp"

#include <gtest/gtest.h>

#include "quad/stage_bench.hpp"

namespace quadrel::quad_tests {
namespace {

/// The eye along the vertices' axes, in P; an affine map there and back, in dPdx and dPdy; the
/// normal in eye space, in Ng; uv.
template <bool per_fragment>
struct ProgramStage : StageDefaults {
    static constexpr StageText text{"program", "quad", "a vertex program", "-"};
    static constexpr std::array<Value, 0> inputs{};
    static constexpr auto outputs =
        values(Value::P, Value::dPdx, Value::dPdy, Value::Ng, Value::uv);
    static constexpr bool reads_vertices = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const VertexProgram program(io);
        const vec3<F> eye = program.point_to_object(vec3<F>(F(0)));
        if constexpr (per_fragment) {
            Vertex<F> vertex;
            for (const auto attribute : {&Vertex<F>::position, &Vertex<F>::tangent,
                                         &Vertex<F>::binormal, &Vertex<F>::normal})
                vertex.*attribute =
                    program.varying([&](const Vertex<F>& v) { return v.*attribute; });
            io.template store<Value::P>(vertex.in_tangent_space(eye - vertex.position));
        } else {
            io.template store<Value::P>(program.varying([&](const Vertex<F>& vertex) {
                return vertex.in_tangent_space(eye - vertex.position);
            }));
        }
        io.template store<Value::dPdx>(
            program.varying([&](const Vertex<F>& v) { return program.point_to_eye(v.position); }));
        io.template store<Value::dPdy>(program.varying([&](const Vertex<F>& v) {
            return program.vector_to_object(program.vector_to_eye(v.tangent));
        }));
        io.template store<Value::Ng>(
            program.varying([&](const Vertex<F>& v) { return program.normal_to_eye(v.normal); }));
        io.template store<Value::uv>(program.varying([](const Vertex<F>& v) { return v.uv; }));
    }
};

/// A triangle with a scale of (2, 1/2, 1) and a shift of (0, 0, -4) to eye space.
PrimitiveVertices row() {
    return {{{-1, 0, 0}, {1, 0, 0.5f}, {0, 1, -0.25f}},
            {{0, 0, 1}, {0.6f, 0, 0.8f}, {0, -0.28f, 0.96f}},
            {{1, 0, 0}, {0.8f, 0, -0.6f}, {1, 0, 0}},
            {{0, 1, 0}, {0, 1, 0}, {0, 0.96f, 0.28f}},
            {{0, 0}, {1, 0}, {0, 1}},
            {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            {2, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 1, -4},
            {0.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 4},
            {}};
}

using Barycentrics = std::array<double, 3>;

vec3<double> wide(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// The program's output at barycentrics of the whole triangle.
vec3<double> expected_eye(const PrimitiveVertices& row, const Barycentrics& b) {
    vec3<double> sum(0.0);
    for (std::size_t v = 0; v < 3; ++v) {
        const vec3<double> eye = vec3<double>(0, 0, 4) - wide(row.position[v]);
        sum += vec3<double>(dot(eye, wide(row.tangent[v])), dot(eye, wide(row.binormal[v])),
                            dot(eye, wide(row.normal[v]))) *
               b[v];
    }
    return sum;
}

/// Barycentrics of the vertices of a piece: the triangle itself, or its part beyond a cut.
using Piece = std::array<Barycentrics, 3>;
constexpr Piece whole{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Piece cut{{{1, 0, 0}, {0.75, 0.25, 0}, {0.25, 0, 0.75}}};

template <class T>
testing::AssertionResult near(const char* what, T found, double expected) {
    const double tolerance = 16 * static_cast<double>(std::numeric_limits<float>::epsilon());
    if (std::abs(static_cast<double>(found) - expected) <= tolerance)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << what << " is " << found << ", expected " << expected;
}

/// Lanes inside and outside of a piece in perspective. `weights`: what the row says of the piece.
template <class T>
testing::AssertionResult interpolates(StageFunction stage, const Piece& piece,
                                      const Piece& weights) {
    StageBench<T> bench;
    PrimitiveData data{};
    const float w[] = {1, 2, 4};
    for (int v = 0; v < 3; ++v) data.w[v] = w[v];
    PrimitiveVertices vertices = row();
    for (std::size_t v = 0; v < 3; ++v)
        for (std::size_t i = 0; i < 3; ++i)
            vertices.weights[v][i] = static_cast<float>(weights[v][i]);
    for (const Value v : {Value::P, Value::dPdx, Value::dPdy, Value::Ng, Value::uv}) bench.want(v);
    const auto edge = [](std::size_t v, int lane) {
        return v == 0 ? lane - 2.0 : v == 1 ? 7.0 - lane / 2 : 3.0 + lane % 4;
    };
    for (std::size_t v = 0; v < 3; ++v)
        for (int lane = 0; lane < 16; ++lane) bench.edges[v][std::size_t(lane)] = edge(v, lane);
    bench.call().primitives = &data;
    bench.call().vertices = &vertices;
    stage(&bench.call());
    for (int lane = 0; lane < 16; ++lane) {
        double sum = 0;
        for (std::size_t v = 0; v < 3; ++v) sum += edge(v, lane) / w[v];
        Barycentrics b{};
        for (std::size_t v = 0; v < 3; ++v)
            for (std::size_t i = 0; i < 3; ++i) b[i] += edge(v, lane) / w[v] / sum * piece[v][i];
        const auto eye = expected_eye(vertices, b);
        for (int c = 0; c < 3; ++c)
            if (auto r = near("eye", bench.at(Value::P, c, lane), eye[c]); !r) return r;
        for (int c = 0; c < 2; ++c)
            if (auto r = near("uv", bench.at(Value::uv, c, lane), b[std::size_t(c + 1)]); !r)
                return r;
        const double Z = 0.5 * b[1] - 0.25 * b[2] - 4, normal_y = 2 * -0.28 * b[2];
        if (auto r = near("P.Z", bench.at(Value::dPdx, 2, lane), Z); !r) return r;
        if (auto r = near("P.X", bench.at(Value::dPdx, 0, lane), 2 * (b[1] - b[0])); !r) return r;
        if (auto r = near("T", bench.at(Value::dPdy, 2, lane), -0.6 * b[1]); !r) return r;
        if (auto r = near("N", bench.at(Value::Ng, 1, lane), normal_y); !r) return r;
    }
    return testing::AssertionSuccess();
}

template <class T>
void check_all() {
    const StageFunction stage = &run_stage<ProgramStage<false>, Quad<T>>;
    EXPECT_TRUE(interpolates<T>(stage, whole, whole));
    EXPECT_TRUE(interpolates<T>(stage, cut, cut));
    // the program run on interpolated attributes
    EXPECT_FALSE(interpolates<T>(&run_stage<ProgramStage<true>, Quad<T>>, whole, whole));
    // at the vertices of the piece as if they were the triangle's
    EXPECT_FALSE(interpolates<T>(stage, cut, whole));
}

TEST(VertexProgram, IsInterpolatedFromTheTrianglesVertices) {
    check_all<float>();
    check_all<double>();
}

/// At a vertex of a whole triangle: the bits of the output there, -0 included.
TEST(VertexProgram, KeepsTheBitsOfItsOutputs) {
    StageBench<float> bench;
    PrimitiveData data{};
    for (float& w : data.w) w = 1;
    PrimitiveVertices vertices = row();
    for (auto& uv : vertices.uv) uv[0] = 0.1f, uv[1] = -0.0f;
    bench.want(Value::uv);
    for (int lane = 0; lane < 16; ++lane) bench.edges[0][std::size_t(lane)] = 3;
    bench.call().primitives = &data;
    bench.call().vertices = &vertices;
    run_stage<ProgramStage<false>, Quad<float>>(&bench.call());
    for (int lane = 0; lane < 16; ++lane) {
        EXPECT_EQ(bench.at(Value::uv, 0, lane), 0.1f);
        EXPECT_TRUE(std::signbit(bench.at(Value::uv, 1, lane)));
    }
}

}  // namespace
}  // namespace quadrel::quad_tests
