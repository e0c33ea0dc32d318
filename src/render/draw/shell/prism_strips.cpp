#include "render/draw/shell/prism_strips.hpp"

#include <bit>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace quadrel {
namespace {

// GLSL's functions as num/geometric.hpp has them: the library's own differ in the last bit.

float dot_as_listed(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
glm::vec3 cross_as_listed(const glm::vec3& a, const glm::vec3& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
glm::vec3 normalize_as_listed(const glm::vec3& v) {
    return v * (1.0f / std::sqrt(dot_as_listed(v, v)));
}
float sign_as_listed(float x) { return x > 0 ? 1.0f : (x < 0 ? -1.0f : 0.0f); }

void set3(float (&to)[3], const glm::vec3& from) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

}  // namespace

PrismStrips::PrismStrips(const Mesh& mesh, const ShadedVertices& base, const Material& material,
                         const glm::mat4& projection)
    : mesh_(mesh), scale_(material.depth), vertices_(base) {
    const std::size_t n = base.eye.size();
    for (std::size_t i = 0; i < n; ++i) {
        view_nv_.push_back(normalize_as_listed(base.normal[i]));
        const glm::vec3 up = base.eye[i] + view_nv_[i] * scale_;
        vertices_.eye.push_back(up);
        vertices_.clip.push_back(projection * glm::vec4(up, 1.0f));
        vertices_.normal.push_back(base.normal[i]);
        vertices_.uv.push_back(base.uv[i]);
    }
}

// Names are those of displacement_map.geom.
void PrismStrips::append(const DrawnCorners& drawn, std::vector<StripTriangle>& out) const {
    const auto count = static_cast<std::uint32_t>(view_nv_.size());
    const std::array<std::uint32_t, 3> in = indices_of(mesh_, drawn);
    std::array<glm::vec3, 3> view_pos, nv, tv, bv;
    std::array<glm::vec2, 3> uv;
    for (std::size_t i = 0; i < 3; ++i) {
        view_pos[i] = vertices_.eye[in[i]];
        uv[i] = vertices_.uv[in[i]];
    }
    const glm::vec3 dp1 = view_pos[1] - view_pos[0], dp2 = view_pos[2] - view_pos[0];
    const glm::vec2 duv1 = uv[1] - uv[0], duv2 = uv[2] - uv[0];
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec3 dp2perp = cross_as_listed(dp2, view_nv_[in[i]]);
        const glm::vec3 dp1perp = cross_as_listed(view_nv_[in[i]], dp1);
        nv[i] = view_nv_[in[i]] * scale_;
        tv[i] = dp2perp * duv1.x + dp1perp * duv2.x;
        bv[i] = dp2perp * duv1.y + dp1perp * duv2.y;
    }
    struct Emitted {
        std::size_t corner;
        bool up;
    };
    const auto emit = [&](const std::array<Emitted, 3>& triangle, float side) {
        StripTriangle emitted;
        for (std::size_t v = 0; v < 3; ++v) {
            const auto [i, up] = triangle[v];
            emitted.index[v] = in[i] + (up ? count : 0);
            emitted.corner[v] = drawn.corner[i];
            set3(emitted.varyings.nv[v], nv[i]);
            set3(emitted.varyings.tv[v], tv[i]);
            set3(emitted.varyings.bv[v], bv[i]);
            emitted.varyings.height[v] = up ? 1.0f : 0.0f;
            emitted.varyings.side[v] = side;
        }
        out.push_back(emitted);
    };
    // On the base d.z is a distance, which nothing reads.
    emit({{{0, false}, {1, false}, {2, false}}}, 0);
    const glm::vec3 cpt_tri = (view_pos[0] + view_pos[1] + view_pos[2]) / 3.0f;
    for (std::size_t i0 = 0; i0 < 3; ++i0) {
        const std::size_t i1 = (i0 + 1) % 3;
        const glm::vec3 cpt_edge = (view_pos[i0] + view_pos[i1]) / 2.0f;
        const glm::vec3 dir_to_edge = cpt_edge - cpt_tri;
        const glm::vec3 edge = view_pos[i1] - view_pos[i0], nv_edge = nv[i0] + nv[i1];
        glm::vec3 nv_side = cross_as_listed(edge, nv_edge);
        nv_side *= sign_as_listed(dot_as_listed(nv_side, dir_to_edge));
        const float frontface = sign_as_listed(dot_as_listed(cpt_edge, -nv_side));
        // The strip's second triangle winds the other way round, so its first two are exchanged.
        emit({{{i0, false}, {i1, false}, {i0, true}}}, frontface);
        emit({{{i0, true}, {i1, false}, {i1, true}}}, frontface);
    }
}

PrimitiveVertices strip_row(const StripTriangle& triangle, const AssembledTriangle& piece) {
    const PrismStrip& at = triangle.varyings;
    PrismStrip row = at;
    row.front_facing = piece.screen.front_facing ? 1.0f : -1.0f;
    for (std::size_t v = 0; v < 3; ++v) {
        const auto& weights = piece.weights[v].perspective;
        for (int i = 0; i < 3; ++i) {
            row.nv[v][i] = weigh(weights, at.nv[0][i], at.nv[1][i], at.nv[2][i]);
            row.tv[v][i] = weigh(weights, at.tv[0][i], at.tv[1][i], at.tv[2][i]);
            row.bv[v][i] = weigh(weights, at.bv[0][i], at.bv[1][i], at.bv[2][i]);
        }
        row.height[v] = weigh(weights, at.height[0], at.height[1], at.height[2]);
        row.side[v] = weigh(weights, at.side[0], at.side[1], at.side[2]);
    }
    return std::bit_cast<PrimitiveVertices>(row);
}

}  // namespace quadrel
