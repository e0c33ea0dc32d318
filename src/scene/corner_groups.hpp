// Sums over the corners of triangles that belong together, in an order that no renumbering changes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// Position, normal and UV: corners with equal ones are one vertex.
using CornerKey = std::array<float, 8>;

/// One corner's share in its group. Triangles without an orientation in UV have no terms and take
/// part in no sum.
template <std::size_t terms>
struct CornerShare {
    CornerKey key;
    int orientation = 0;  ///< -1, 0, 1
    std::array<double, terms> term{};
    std::uint32_t corner = 0;  ///< 3 * triangle + corner
};

/// A triangle as one of its corners sees it: itself first, then in the triangle's own sense.
struct CornerView {
    std::array<std::uint32_t, 3> index;
    glm::dvec3 edge[2];  ///< to the next and the previous corner
    double u[2], v[2];   ///< differences of UV along them
    double uv_area;      ///< twice the signed area in UV
    glm::dvec3 normal;   ///< of the triangle, twice its area long

    int orientation() const { return (uv_area > 0) - (uv_area < 0); }
    /// dP/du and dP/dv times uv_area.
    glm::dvec3 scaled_dPdu() const { return edge[0] * v[1] - edge[1] * v[0]; }
    glm::dvec3 scaled_dPdv() const { return edge[1] * u[0] - edge[0] * u[1]; }
};

CornerView view_corner(const Mesh& mesh, std::size_t triangle, int corner);

/// The normal that the corner shades with: the vertex's, or the triangle's in a mesh without.
glm::dvec3 corner_normal(const Mesh& mesh, const CornerView& view);

CornerKey corner_key(const Mesh& mesh, const CornerView& view);

/// Calls finish(corner, sums, orientation) for every corner with the sums of its group's terms.
/// Corners without orientation get the sums of the vertex's group of positive orientation, else of
/// negative, else zeros and 0.
template <std::size_t terms, class Finish>
void sum_corner_groups(std::vector<CornerShare<terms>> shares, const Finish& finish) {
    std::sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) {
        if (a.key != b.key) return a.key < b.key;
        if (a.orientation != b.orientation) return a.orientation > b.orientation;
        return a.term < b.term;
    });
    using Sums = std::array<double, terms>;
    for (std::size_t first = 0; first < shares.size();) {
        std::size_t end = first;
        Sums sums[2] = {};  // of positive and of negative orientation
        bool present[2] = {false, false};
        for (; end < shares.size() && shares[end].key == shares[first].key; ++end) {
            const int orientation = shares[end].orientation;
            if (orientation == 0) continue;
            present[orientation < 0] = true;
            for (std::size_t i = 0; i < terms; ++i) sums[orientation < 0][i] += shares[end].term[i];
        }
        const int borrowed = present[0] ? 1 : present[1] ? -1 : 0;
        for (; first < end; ++first) {
            const int own = shares[first].orientation;
            const int orientation = own == 0 ? borrowed : own;
            finish(shares[first].corner, sums[orientation < 0], orientation);
        }
    }
}

}  // namespace quadrel
