#include "quadrel/scene/refine.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "quadrel/num/functions.hpp"
#include "scene/direction.hpp"
#include "scene/mesh_corners.hpp"

namespace quadrel {
namespace {

/// A point of the surface, common to all vertices at its position.
struct Point {
    glm::dvec3 position, normal;
};

/// A mesh whose vertices know their points.
struct Surface {
    Mesh mesh;
    std::vector<Point> points;
    std::vector<std::uint32_t> point_of;  ///< of each vertex
};

using PositionKey = std::array<float, 3>;

PositionKey key_of(const glm::vec3& p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }

/// Vertices at one position get one point; without normals so far.
void find_points(Surface& surface) {
    const auto& positions = surface.mesh.positions;
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t v) { return key_of(positions[v]); };
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return key(a) < key(b); });
    surface.point_of.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i]) != key(order[i - 1]))
            surface.points.push_back({glm::dvec3(positions[order[i]]), glm::dvec3(0)});
        surface.point_of[order[i]] = static_cast<std::uint32_t>(surface.points.size() - 1);
    }
}

/// A normal for the mean of a point: of a vertex, or of a corner in a mesh without normals.
struct NormalShare {
    std::uint32_t point;
    std::array<double, 3> normal;
};

std::vector<NormalShare> normal_shares(const Surface& surface) {
    const Mesh& mesh = surface.mesh;
    std::vector<NormalShare> shares;
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
        const glm::dvec3 n = direction(glm::dvec3(mesh.normals[v]));
        shares.push_back({surface.point_of[v], {n.x, n.y, n.z}});
    }
    if (!mesh.normals.empty()) return shares;
    for (const auto& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t[0]]);
        const glm::dvec3 n = direction(
            cross(glm::dvec3(mesh.positions[t[1]]) - a, glm::dvec3(mesh.positions[t[2]]) - a));
        for (const std::uint32_t v : t) shares.push_back({surface.point_of[v], {n.x, n.y, n.z}});
    }
    return shares;
}

/// Means of normals, summed in an order that no renumbering changes; each different normal once,
/// so that it does not matter how often the mesh repeats a vertex.
void find_normals(Surface& surface) {
    std::vector<NormalShare> shares = normal_shares(surface);
    const auto same = [](const NormalShare& a, const NormalShare& b) {
        return a.point == b.point && a.normal == b.normal;
    };
    std::sort(shares.begin(), shares.end(), [](const NormalShare& a, const NormalShare& b) {
        return a.point != b.point ? a.point < b.point : a.normal < b.normal;
    });
    shares.erase(std::unique(shares.begin(), shares.end(), same), shares.end());
    for (const NormalShare& share : shares)
        surface.points[share.point].normal +=
            glm::dvec3(share.normal[0], share.normal[1], share.normal[2]);
    for (Point& point : surface.points) point.normal = direction(point.normal);
}

/// The middle of the PN edge between two points; the same for both orders of them.
Point edge_point(const Point& a, const Point& b) {
    const glm::dvec3 edge = b.position - a.position;
    const glm::dvec3 lift = a.normal * dot(edge, a.normal) - b.normal * dot(edge, b.normal);
    const double squared = dot(edge, edge);
    const glm::dvec3 sum = a.normal + b.normal;
    const glm::dvec3 reflected =
        squared > 0 ? direction(sum - edge * (2 * dot(edge, sum) / squared)) : direction(sum);
    Point middle;
    middle.position = (a.position + b.position) * 0.5 - lift * 0.125;
    middle.normal = direction(sum + reflected);
    return middle;
}

/// Finds or makes the vertex and the point in the middle of an edge.
class EdgeCutter {
  public:
    explicit EdgeCutter(Surface& surface) : surface_(surface) {}

    std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] = vertices_.try_emplace(
            key(a, b), static_cast<std::uint32_t>(surface_.mesh.positions.size()));
        if (is_new) add_vertex(std::min(a, b), std::max(a, b));
        return found->second;
    }

  private:
    static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
        return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
    }
    std::uint32_t middle_point(std::uint32_t a, std::uint32_t b) {
        auto& points = surface_.points;
        const auto [found, is_new] =
            points_.try_emplace(key(a, b), static_cast<std::uint32_t>(points.size()));
        if (is_new) points.push_back(edge_point(points[std::min(a, b)], points[std::max(a, b)]));
        return found->second;
    }
    void add_vertex(std::uint32_t a, std::uint32_t b) {
        Mesh& mesh = surface_.mesh;
        const std::uint32_t point = middle_point(surface_.point_of[a], surface_.point_of[b]);
        surface_.point_of.push_back(point);
        mesh.positions.emplace_back(surface_.points[point].position);
        if (!mesh.uvs.empty()) mesh.uvs.push_back((mesh.uvs[a] + mesh.uvs[b]) * 0.5f);
        if (mesh.tangents.empty()) return;
        const glm::dvec3 sum = glm::dvec3(mesh.tangents[a]) + glm::dvec3(mesh.tangents[b]);
        mesh.tangents.emplace_back(glm::vec3(direction(sum)), mesh.tangents[a].w);
    }

    Surface& surface_;
    std::unordered_map<std::uint64_t, std::uint32_t> vertices_, points_;
};

void cut_in_four(Surface& surface) {
    EdgeCutter cutter(surface);
    std::vector<std::array<std::uint32_t, 3>> finer;
    finer.reserve(4 * surface.mesh.triangles.size());
    for (const auto& [a, b, c] : surface.mesh.triangles) {
        const std::uint32_t ab = cutter.middle(a, b), bc = cutter.middle(b, c),
                            ca = cutter.middle(c, a);
        finer.push_back({a, ab, ca});
        finer.push_back({ab, b, bc});
        finer.push_back({ca, bc, c});
        finer.push_back({ab, bc, ca});
    }
    surface.mesh.triangles = std::move(finer);
}

}  // namespace

Mesh refined_by_curvature(const Mesh& mesh, int levels) {
    if (levels <= 0) return mesh;
    Surface surface;
    surface.mesh = mesh;
    find_points(surface);
    find_normals(surface);
    for (int level = 0; level < levels; ++level) cut_in_four(surface);
    surface.mesh.normals.clear();
    for (const std::uint32_t point : surface.point_of)
        surface.mesh.normals.emplace_back(surface.points[point].normal);
    settle_normals(surface.mesh);  // opposite ones have no mean
    return std::move(surface.mesh);
}

}  // namespace quadrel
