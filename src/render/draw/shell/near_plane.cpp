#include "render/draw/shell/near_plane.hpp"

#include <fmt/format.h>

#include <array>
#include <glm/vec4.hpp>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

using Corners = std::array<glm::dvec4, 4>;

/// Clip coordinates, corner after corner.
using ConvexPolygon = std::vector<glm::dvec4>;

/// Where an edge meets the plane of distance 0; the distances have opposite signs.
glm::dvec4 meeting(const glm::dvec4& a, double distance_a, const glm::dvec4& b, double distance_b) {
    const double t = distance_a / (distance_a - distance_b);
    return a * (1 - t) + b * t;
}

/// Where a tetrahedron meets a plane from which its corners have these distances.
ConvexPolygon section(const Corners& corner, const std::array<double, 4>& distance) {
    std::vector<std::size_t> inside, outside;
    for (std::size_t k = 0; k < 4; ++k) (distance[k] > 0 ? inside : outside).push_back(k);
    if (inside.empty() || outside.empty()) return {};
    ConvexPolygon polygon;
    const auto add = [&](std::size_t a, std::size_t b) {
        polygon.push_back(meeting(corner[a], distance[a], corner[b], distance[b]));
    };
    if (inside.size() == 2) {
        add(inside[0], outside[0]);
        add(inside[0], outside[1]);
        add(inside[1], outside[1]);
        add(inside[1], outside[0]);
        return polygon;
    }
    for (const std::size_t a : inside)
        for (const std::size_t b : outside) add(a, b);
    return polygon;
}

/// What lies within the sides of the view.
bool is_seen(ConvexPolygon polygon) {
    for (const int axis : {0, 1})
        for (const double side : {-1.0, 1.0}) {
            const auto distance = [&](const glm::dvec4& p) { return p.w - side * p[axis]; };
            ConvexPolygon kept;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec4 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                const double da = distance(a), db = distance(b);
                if (da > 0) kept.push_back(a);
                if ((da > 0) != (db > 0)) kept.push_back(meeting(a, da, b, db));
            }
            polygon = std::move(kept);
        }
    return polygon.size() >= 3;
}

}  // namespace

void check_near_plane(const Scene& scene, std::uint32_t object, const Shell& shell,
                      const Mesh& mesh) {
    const std::vector<glm::vec4>& clip = shell.vertices().clip;
    const auto distance = [&](const glm::dvec4& p) {
        if (scene.camera.reversed_z) return p.w - p.z;
        return scene.conventions == Conventions::gl ? p.z + p.w : p.z;
    };
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (const ShellTetrahedron& tetrahedron : shell.tetrahedra(t)) {
            Corners corner;
            std::array<double, 4> from_plane{};
            for (std::size_t k = 0; k < 4; ++k) {
                corner[k] = glm::dvec4(clip[tetrahedron[k]]);
                from_plane[k] = distance(corner[k]);
            }
            if (!is_seen(section(corner, from_plane))) continue;
            const Material& material = scene.materials[scene.objects[object].material];
            throw InputError(
                scene.file.string(), "camera",
                fmt::format("a near plane within the shell of object {} (material {}), over its "
                            "triangle {}",
                            object, material.name, t),
                "an eye outside of shells: rays that begin in one enter it nowhere");
        }
}

}  // namespace quadrel
