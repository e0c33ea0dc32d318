// What holds for a good mesh.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <tuple>

#include "quadrel/num/functions.hpp"
#include "quadrel/scene/mesh.hpp"

namespace quadrel {

inline std::array<glm::dvec3, 3> corners_of(const Mesh& mesh,
                                            const std::array<std::uint32_t, 3>& triangle) {
    return {glm::dvec3(mesh.positions[triangle[0]]), glm::dvec3(mesh.positions[triangle[1]]),
            glm::dvec3(mesh.positions[triangle[2]])};
}

/// Every array is empty or as long as the positions, every index in range, every number finite.
inline testing::AssertionResult is_consistent(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
    if (!fits(mesh.normals.size()) || !fits(mesh.uvs.size()) || !fits(mesh.tangents.size()))
        return testing::AssertionFailure() << "arrays of different lengths";
    for (const auto& triangle : mesh.triangles)
        for (std::uint32_t corner : triangle)
            if (corner >= count) return testing::AssertionFailure() << "index " << corner;
    for (const auto& p : mesh.positions)
        if (!std::isfinite(p.x + p.y + p.z)) return testing::AssertionFailure() << "a position";
    return testing::AssertionSuccess() << mesh.triangles.size();
}

/// Every directed edge, told apart by the bits of its ends, has exactly one opposite: closed, and
/// of one orientation.
inline testing::AssertionResult is_closed(const Mesh& mesh) {
    using Key = std::tuple<float, float, float, float, float, float>;
    std::map<Key, int> edges;
    for (const auto& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 a = mesh.positions[triangle[i]];
            const glm::vec3 b = mesh.positions[triangle[(i + 1) % 3]];
            ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
        }
    }
    for (const auto& [edge, count] : edges) {
        const auto& [ax, ay, az, bx, by, bz] = edge;
        const auto back = edges.find({bx, by, bz, ax, ay, az});
        if (count != 1 || back == edges.end() || back->second != 1)
            return testing::AssertionFailure()
                   << "edge (" << ax << " " << ay << " " << az << ") (" << bx << " " << by << " "
                   << bz << ") " << count << " times, back "
                   << (back == edges.end() ? 0 : back->second);
    }
    return testing::AssertionSuccess();
}

/// Normals of unit length that agree with the triangles' orientation.
inline testing::AssertionResult normals_agree(const Mesh& mesh) {
    for (const auto& n : mesh.normals)
        if (!(std::abs(length(glm::dvec3(n)) - 1) < 1e-6))
            return testing::AssertionFailure() << "a normal of length " << length(glm::dvec3(n));
    for (const auto& triangle : mesh.triangles) {
        const auto [a, b, c] = corners_of(mesh, triangle);
        const glm::dvec3 area = cross(b - a, c - a);
        for (std::uint32_t corner : triangle)
            if (!(dot(area, glm::dvec3(mesh.normals[corner])) > 0))
                return testing::AssertionFailure() << "a normal against its triangle at (" << a.x
                                                   << " " << a.y << " " << a.z << ")";
    }
    return testing::AssertionSuccess();
}

/// Six times the enclosed volume; positive when triangles face outwards.
inline double signed_volume(const Mesh& mesh) {
    double sum = 0;
    for (const auto& triangle : mesh.triangles) {
        const auto [a, b, c] = corners_of(mesh, triangle);
        sum += dot(a, cross(b, c));
    }
    return sum;
}

/// `distance` from the surface is within `tolerance` for every vertex, and its gradient the normal.
inline testing::AssertionResult lies_on(const Mesh& mesh,
                                        const std::function<double(const glm::dvec3&)>& distance,
                                        double tolerance) {
    for (const auto& p : mesh.positions)
        if (!(std::abs(distance(glm::dvec3(p))) <= tolerance))
            return testing::AssertionFailure() << "a vertex off by " << distance(glm::dvec3(p));
    return testing::AssertionSuccess();
}

/// No triangle has a uv area of the other sign: textures are nowhere seen mirrored.
inline testing::AssertionResult uvs_not_mirrored(const Mesh& mesh) {
    for (const auto& triangle : mesh.triangles) {
        const glm::dvec2 a(mesh.uvs[triangle[0]]), b(mesh.uvs[triangle[1]]),
            c(mesh.uvs[triangle[2]]);
        const glm::dvec2 ab = b - a, ac = c - a;
        if (!(ab.x * ac.y - ab.y * ac.x > 0))
            return testing::AssertionFailure() << "uv area of the wrong sign";
    }
    return testing::AssertionSuccess();
}

}  // namespace quadrel
