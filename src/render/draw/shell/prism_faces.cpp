#include "render/draw/shell/prism_faces.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace quadrel {
namespace {

/// Corners a, b, c of a prism: indices of the mesh's vertices, and which corner of the triangle.
struct PrismCorners {
    std::array<std::uint32_t, 3> index, over;
};

PrismCorners prism_corners(const Shell& shell, const Mesh& mesh, std::uint32_t triangle) {
    const ShellTetrahedron first = shell.tetrahedra(triangle)[0];
    PrismCorners corners{{first[0], first[1], first[2]}, {}};
    const auto& of_mesh = mesh.triangles[triangle];
    for (std::size_t k = 0; k < 3; ++k)
        while (of_mesh[corners.over[k]] != corners.index[k]) ++corners.over[k];
    return corners;
}

/// Six times the prism's volume, of its three tetrahedra.
double volume_of(const Shell& shell, std::uint32_t triangle) {
    double volume = 0, sign = 1;
    for (const ShellTetrahedron& corner : shell.tetrahedra(triangle)) {
        const auto at = [&](std::size_t k) { return glm::dvec3(shell.vertices().eye[corner[k]]); };
        // Of the prism's three, the middle one's corners wind the other way round.
        volume += sign * glm::dot(at(3) - at(0), glm::cross(at(1) - at(0), at(2) - at(0)));
        sign = -sign;
    }
    return volume;
}

void copy_vector(float* to, const glm::dvec3& from) {
    for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

}  // namespace

void append_prism_faces(const Shell& shell, const Mesh& mesh, const Material& material,
                        const DrawnCorners& drawn, std::vector<PrismTriangle>& out) {
    const auto t = static_cast<std::uint32_t>(drawn.triangle);
    const PrismCorners corners = prism_corners(shell, mesh, t);
    const ShadedVertices& vertices = shell.vertices();
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    const bool flat = material.depth == 0;
    PrismFace face{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t index = corners.index[k];
        const glm::dvec3 bottom(vertices.eye[index]), top(vertices.eye[n + index]);
        const glm::dvec3 normal(unit_or_null(vertices.normal[index]));
        const double seat = material.seat;
        copy_vector(face.bottom[k], flat ? bottom - normal * seat : bottom);
        copy_vector(face.top[k], flat ? bottom + normal * (1 - seat) : top);
        for (int i = 0; i < 2; ++i) face.uv[k][i] = vertices.uv[index][i];
    }
    face.turned = volume_of(shell, t) < 0 ? -1.0f : 1.0f;
    const auto add = [&](const std::array<std::uint32_t, 3>& place,
                         const std::array<bool, 3>& at_top) {
        PrismTriangle triangle;
        triangle.face = face;
        triangle.place = place;
        for (std::size_t k = 0; k < 3; ++k) {
            triangle.index[k] = corners.index[place[k]] + (at_top[k] ? n : 0);
            triangle.corner[k] = corners.over[place[k]];
            triangle.s[k] = at_top[k] ? 0.0f : 1.0f;
        }
        out.push_back(triangle);
    };
    if (flat) {
        std::array<std::uint32_t, 3> place{};
        for (std::size_t k = 0; k < 3; ++k)
            while (corners.over[place[k]] != drawn.corner[k]) ++place[k];
        add(place, {});
        for (float& s : out.back().s) s = static_cast<float>(1 - material.seat);
        return;
    }
    for (const auto& triangle : prism_triangles) {
        std::array<std::uint32_t, 3> place{};
        std::array<bool, 3> at_top{};
        for (std::size_t k = 0; k < 3; ++k) {
            const int corner = triangle[face.turned < 0 ? 2 - k : k];
            place[k] = static_cast<std::uint32_t>(corner % 3);
            at_top[k] = corner >= 3;
        }
        add(place, at_top);
    }
}

PrimitiveVertices prism_row(const PrismTriangle& triangle, const AssembledTriangle& piece,
                            int subpixel_bits) {
    PrismFace row = triangle.face;
    row.snap = static_cast<float>(std::ldexp(1.0, -subpixel_bits));
    for (std::size_t v = 0; v < 3; ++v) {
        const auto& weights = piece.weights[v].perspective;
        row.s[v] = weigh(weights, triangle.s[0], triangle.s[1], triangle.s[2]);
        // Of a side's triangle two vertices lie over one corner.
        for (float& weight : row.weights[v]) weight = 0;
        for (std::size_t k = 0; k < 3; ++k)
            row.weights[v][triangle.place[k]] += static_cast<float>(weights[k]);
    }
    return std::bit_cast<PrimitiveVertices>(row);
}

}  // namespace quadrel
