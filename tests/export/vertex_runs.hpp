// Random triangles for stages that compute at the vertices: what such a stage is called with, and
// what the exported function of vertices gives, interpolated as the stage does it.
#pragma once

#include <array>

#include "export/exported.hpp"
#include "export/glsl.hpp"
#include "quadrel/quad/interpolate.hpp"
#include "random.hpp"

namespace quadrel::export_tests {

class RandomTriangles {
  public:
    explicit RandomTriangles(test::Random& random) {
        const auto fill = [&](float* to, int floats) {
            for (int i = 0; i < floats; ++i) to[i] = static_cast<float>(random.uniform(-1, 1));
        };
        float to_eye[12], to_object[12];
        fill(to_eye, 12);
        fill(to_object, 12);
        for (std::size_t t = 0; t < count; ++t) {
            PrimitiveVertices& row = vertices_[t];
            row = {};
            for (int v = 0; v < 3; ++v) {
                for (float* of : {row.position[v], row.normal[v], row.tangent[v], row.binormal[v]})
                    fill(of, 3);
                fill(row.uv[v], 2);
                row.weights[v][v] = 1;
                primitives_[t].w[v] = static_cast<float>(random.uniform(0.5, 2));
            }
            std::copy_n(to_eye, 12, row.to_eye);
            std::copy_n(to_object, 12, row.to_object);
        }
        // Where the texture coordinates are degenerate.
        std::fill_n(vertices_[1].tangent[2], 3, 0.0f);
        for (int lane = 0; lane < batch_lanes; ++lane) {
            primitive_[lane] = lane / 4 % static_cast<int>(count);
            for (auto& edge : edges_) edge[std::size_t(lane)] = random.uniform(0.1, 1);
        }
    }

    void bind(StageCall& call) const {
        call.vertices = vertices_.data();
        call.primitives = primitives_.data();
        call.primitive = primitive_.data();
        for (std::size_t v = 0; v < 3; ++v) call.edges[v] = edges_[v].data();
    }

    void set_uniforms() const {
        std::copy_n(vertices_[0].to_eye, 12, glsl::model_view);
        std::copy_n(vertices_[0].to_object, 12, glsl::inverse_model_view);
    }

    using Varyings = std::array<std::array<float, most_varying_floats>, 4>;  ///< a lane each

    /// What the function gives in the quad's lanes.
    Varyings interpolated(const ExportedFunction& function, int first_lane) const {
        Varyings found{};
        if (function.run_vertex == nullptr) return found;
        const PrimitiveVertices& row = vertices_[std::size_t(primitive_[std::size_t(first_lane)])];
        float at[3][most_varying_floats];
        for (int v = 0; v < 3; ++v)
            function.run_vertex({row.position[v], row.normal[v], row.tangent[v], row.binormal[v],
                                 row.uv[v], at[v]});
        StageCall call{};
        bind(call);
        const Interpolator<Quad<float>> interpolate(call, first_lane);
        for (int i = 0; i < function.varying_floats; ++i) {
            const Quad<float> value = interpolate({at[0][i], at[1][i], at[2][i]});
            for (std::size_t lane = 0; lane < 4; ++lane)
                found[lane][std::size_t(i)] = value.lane[lane];
        }
        return found;
    }

  private:
    static constexpr std::size_t count = 4;
    std::array<PrimitiveVertices, count> vertices_;
    std::array<PrimitiveData, count> primitives_{};
    std::array<std::int32_t, batch_lanes> primitive_;
    std::array<std::array<double, batch_lanes>, 3> edges_;
};

}  // namespace quadrel::export_tests
