#include "quadrel/scene/quadrics.hpp"

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>

#include "quadrel/num/functions.hpp"
#include "quadrel/scene/tangents.hpp"
#include "scene/direction.hpp"

namespace quadrel {
namespace {

using Position = std::array<float, 3>;
/// Position and normal.
using VertexKey = std::array<float, 6>;

// + 0: negative zeros are zeros.
Position point_of(const glm::vec3& v) { return {v.x + 0.0f, v.y + 0.0f, v.z + 0.0f}; }

VertexKey key_of(const Mesh& mesh, std::uint32_t index) {
    const Position p = point_of(mesh.positions[index]), n = point_of(mesh.normals[index]);
    return {p[0], p[1], p[2], n[0], n[1], n[2]};
}

/// What lies around a vertex: points on the far ends of its edges, in an order of their own, each
/// once.
using Neighbours = std::map<VertexKey, std::vector<Position>>;

Neighbours neighbours_of(const Mesh& mesh) {
    Neighbours all;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<Position>& points = all[key_of(mesh, triangle[c])];
            for (std::size_t other = 1; other < 3; ++other)
                points.push_back(point_of(mesh.positions[triangle[(c + other) % 3]]));
        }
    for (auto& [key, points] : all) {
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
    }
    return all;
}

struct TangentAxes {
    glm::dvec3 x, y, normal;
};

/// Perpendicular to the normal, x towards growing u.
TangentAxes axes_of(const glm::dvec3& normal, const glm::dvec3& dPdu) {
    const glm::dvec3 n = direction(normal), x = direction(dPdu - n * dot(n, dPdu));
    return {x, cross(n, x), n};
}

glm::vec2 fitted_quadric(const glm::dvec3& P, const TangentAxes& axes,
                         const std::vector<Position>& points) {
    double xx = 0, xy = 0, yy = 0, x_depth = 0, y_depth = 0;
    for (const Position& point : points) {
        const glm::dvec3 d = glm::dvec3(point[0], point[1], point[2]) - P;
        const double x = dot(d, axes.x), y = dot(d, axes.y), depth = -dot(d, axes.normal);
        const double x2 = x * x, y2 = y * y;
        xx += x2 * x2;
        xy += x2 * y2;
        yy += y2 * y2;
        x_depth += x2 * depth;
        y_depth += y2 * depth;
    }
    const double determinant = xx * yy - xy * xy, both = xx + 2 * xy + yy;
    if (determinant > 1e-9 * xx * yy)
        return {static_cast<float>((x_depth * yy - y_depth * xy) / determinant),
                static_cast<float>((y_depth * xx - x_depth * xy) / determinant)};
    if (!(both > 0)) return glm::vec2(0);
    return glm::vec2(static_cast<float>((x_depth + y_depth) / both));
}

}  // namespace

std::vector<std::array<glm::vec2, 3>> fitted_quadrics(const Mesh& mesh) {
    std::vector<std::array<glm::vec2, 3>> all(mesh.triangles.size());
    if (mesh.normals.empty() || mesh.uvs.empty()) return all;
    const Neighbours neighbours = neighbours_of(mesh);
    const auto tangents = uv_tangents(mesh);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t index = mesh.triangles[t][c];
            const TangentAxes axes =
                axes_of(glm::dvec3(mesh.normals[index]), glm::dvec3(tangents[t][c].dPdu));
            if (!(dot(axes.x, axes.x) > 0)) continue;
            all[t][c] = fitted_quadric(glm::dvec3(mesh.positions[index]), axes,
                                       neighbours.at(key_of(mesh, index)));
        }
    return all;
}

}  // namespace quadrel
