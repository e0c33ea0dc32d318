// The relief of shells as triangles for Embree, twice: in prisms with bilinear sides, as `displace`
// has it, and in their tetrahedra, as prism-exact does (relief/shell/shell_face.hpp). Made by
// itself, from the mesh and the texels alone; all in double, in eye space.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "quadrel/scene/mesh.hpp"

namespace quadrel::render_tests {

using Facet = std::array<glm::dvec3, 3>;

/// A point of a mesh's triangle: weights of its corners, and the height of the relief there.
struct ReliefPoint {
    glm::dvec3 weight;
    double height;
};

/// A map of heights that repeats, two triangles a cell along the main diagonal.
struct CellMap {
    int texels;
    std::vector<float> heights;

    double at(int i, int j) const {
        const auto wrapped = [&](int k) { return (k % texels + texels) % texels; };
        return heights[static_cast<std::size_t>(wrapped(j) * texels + wrapped(i))];
    }
    /// uv in cells.
    glm::dvec2 cells(const glm::dvec2& uv) const { return uv * double(texels) - 0.5; }
    double height(const glm::dvec2& cells, int i, int j, bool beyond) const {
        const double f = cells.x - i, g = cells.y - j, h00 = at(i, j), h11 = at(i + 1, j + 1);
        if (beyond) return h00 + f * (h11 - at(i, j + 1)) + g * (at(i, j + 1) - h00);
        return h00 + f * (at(i + 1, j) - h00) + g * (h11 - at(i + 1, j));
    }
};

using Polygon = std::vector<ReliefPoint>;

/// The part of a convex polygon where `side`, linear over it, is at least 0.
template <class Side>
Polygon cut(const Polygon& polygon, const Side& side) {
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const ReliefPoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double from = side(a), to = side(b);
        if (from >= 0) kept.push_back(a);
        if ((from > 0 && to < 0) || (from < 0 && to > 0)) {
            const double t = from / (from - to);
            kept.push_back(
                {a.weight + (b.weight - a.weight) * t, a.height + (b.height - a.height) * t});
        }
    }
    return kept;
}

/// Where the relief over a mesh is, in prisms and in tetrahedra.
class ReliefFacets {
  public:
    /// How the prisms are cut.
    enum class Split {
        none,       ///< not at all: bilinear sides
        by_vertex,  ///< as shells are
        by_corner,  ///< planted: in the order of the triangle's corners
    };

    /// The mesh's top is the shell's (seat 1).
    ReliefFacets(const Mesh& mesh, const CellMap& map, double depth, const glm::dmat4& to_eye,
                 Split split)
        : mesh_(mesh), map_(map), depth_(depth), split_(split) {
        const glm::dmat3 turn(to_eye);
        std::map<std::tuple<float, float, float, float, float, float>, std::uint32_t> known;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3 p = mesh.positions[i] + 0.0f, n = mesh.normals[i] + 0.0f;
            position_.emplace_back(to_eye * glm::dvec4(p, 1));
            normal_.push_back(glm::normalize(turn * glm::dvec3(n)));
            first_equal_.push_back(
                known.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z}, static_cast<std::uint32_t>(i))
                    .first->second);
        }
        for (const auto& triangle : mesh.triangles) add(triangle);
    }

    const std::vector<Facet>& facets() const { return facets_; }

    /// At most as far are prisms and tetrahedra apart: D / 4 times the greatest difference of two
    /// normals of a triangle.
    double bound() const { return 0.25 * depth_ * most_turn_; }

  private:
    void add(std::array<std::uint32_t, 3> corner) {
        if (split_ != Split::by_corner)
            std::sort(corner.begin(), corner.end(), [&](std::uint32_t a, std::uint32_t b) {
                return first_equal_[a] < first_equal_[b];
            });
        std::array<glm::dvec2, 3> at;
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = map_.cells(glm::dvec2(mesh_.uvs[corner[k]]));
            most_turn_ = std::max(most_turn_,
                                  glm::distance(normal_[corner[k]], normal_[corner[(k + 1) % 3]]));
            if (position_[corner[k]] == position_[corner[(k + 1) % 3]]) return;
        }
        const auto least = [&](auto axis) {
            return static_cast<int>(std::floor(std::min({axis(at[0]), axis(at[1]), axis(at[2])})));
        };
        const auto most = [&](auto axis) {
            return static_cast<int>(std::floor(std::max({axis(at[0]), axis(at[1]), axis(at[2])})));
        };
        const auto x = [](const glm::dvec2& v) { return v.x; };
        const auto y = [](const glm::dvec2& v) { return v.y; };
        for (int j = least(y); j <= most(y); ++j)
            for (int i = least(x); i <= most(x); ++i)
                for (const bool beyond : {false, true}) add_half_cell(corner, at, i, j, beyond);
    }

    void add_half_cell(const std::array<std::uint32_t, 3>& corner,
                       const std::array<glm::dvec2, 3>& at, int i, int j, bool beyond) {
        const auto cells = [&](const ReliefPoint& p) {
            return at[0] * p.weight.x + at[1] * p.weight.y + at[2] * p.weight.z;
        };
        Polygon polygon{{{1, 0, 0}, 0}, {{0, 1, 0}, 0}, {{0, 0, 1}, 0}};
        polygon = cut(polygon, [&](const ReliefPoint& p) { return cells(p).x - i; });
        polygon = cut(polygon, [&](const ReliefPoint& p) { return i + 1 - cells(p).x; });
        polygon = cut(polygon, [&](const ReliefPoint& p) { return cells(p).y - j; });
        polygon = cut(polygon, [&](const ReliefPoint& p) { return j + 1 - cells(p).y; });
        polygon = cut(polygon, [&](const ReliefPoint& p) {
            const double over = (cells(p).y - j) - (cells(p).x - i);
            return beyond ? over : -over;
        });
        for (ReliefPoint& p : polygon) p.height = map_.height(cells(p), i, j, beyond);
        add_part(corner, polygon);
        for (std::size_t k = 0; k < polygon.size(); ++k)
            add_wall(corner, polygon[k], polygon[(k + 1) % polygon.size()]);
    }

    /// Where an edge of the relief lies over one of the triangle, the solid's side down from it: it
    /// is seen where texture coordinates jump to the next triangle, and hidden elsewhere.
    void add_wall(const std::array<std::uint32_t, 3>& corner, const ReliefPoint& a,
                  const ReliefPoint& b) {
        for (int k = 0; k < 3; ++k)
            if (a.weight[k] == 0 && b.weight[k] == 0)
                add_part(corner, {a, b, {b.weight, 0}, {a.weight, 0}});
    }

    /// In the tetrahedra that it lies in.
    void add_part(const std::array<std::uint32_t, 3>& corner, const Polygon& polygon) {
        if (split_ == Split::none) return add_polygon(corner, polygon);
        // The height up to which the last vertex rises, and the one up to which the two last do.
        const auto last = [](const ReliefPoint& p) { return p.weight.z - p.height; };
        const auto two = [](const ReliefPoint& p) { return p.weight.z + p.weight.y - p.height; };
        const auto less = [](const auto& side) {
            return [side](const ReliefPoint& p) { return -side(p); };
        };
        add_polygon(corner, cut(polygon, last));
        add_polygon(corner, cut(cut(polygon, less(last)), two));
        add_polygon(corner, cut(polygon, less(two)));
    }

    void add_polygon(const std::array<std::uint32_t, 3>& corner, const Polygon& polygon) {
        for (std::size_t k = 2; k < polygon.size(); ++k)
            facets_.push_back({place(corner, polygon[0]), place(corner, polygon[k - 1]),
                               place(corner, polygon[k])});
    }

    /// Rises of the corners' normals from the shell's bottom: all of the height in prisms.
    glm::dvec3 place(const std::array<std::uint32_t, 3>& corner, const ReliefPoint& p) const {
        glm::dvec3 rise = p.weight * p.height;
        if (split_ != Split::none) {
            rise.z = std::min(p.height, p.weight.z);
            rise.y = std::clamp(p.height - p.weight.z, 0.0, p.weight.y);
            rise.x = std::max(p.height - p.weight.z - p.weight.y, 0.0);
        }
        glm::dvec3 point(0);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t of = corner[static_cast<std::size_t>(k)];
            point += position_[of] * p.weight[k] + normal_[of] * ((rise[k] - p.weight[k]) * depth_);
        }
        return point;
    }

    const Mesh& mesh_;
    const CellMap& map_;
    double depth_;
    Split split_;
    std::vector<glm::dvec3> position_, normal_;
    std::vector<std::uint32_t> first_equal_;
    std::vector<Facet> facets_;
    double most_turn_ = 0;
};

/// Where the point of a triangle that is nearest to p lies.
inline glm::dvec3 nearest_of(const Facet& facet, const glm::dvec3& p) {
    const glm::dvec3 n = glm::cross(facet[1] - facet[0], facet[2] - facet[0]);
    const double area = glm::dot(n, n);
    bool inside = area > 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 edge = facet[(k + 1) % 3] - facet[k];
        inside = inside && glm::dot(glm::cross(edge, p - facet[k]), n) >= 0;
    }
    if (inside) return p - n * (glm::dot(p - facet[0], n) / area);
    glm::dvec3 nearest = facet[0];
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 edge = facet[(k + 1) % 3] - facet[k];
        const double square = glm::dot(edge, edge);
        const double t =
            square > 0 ? std::clamp(glm::dot(p - facet[k], edge) / square, 0.0, 1.0) : 0;
        const glm::dvec3 at = facet[k] + edge * t;
        if (glm::distance(at, p) < glm::distance(nearest, p)) nearest = at;
    }
    return nearest;
}

/// Facets that Embree traces, in float.
class EmbreeFacets {
  public:
    explicit EmbreeFacets(std::vector<Facet> facets)
        : facets_(std::move(facets)),
          device_(rtcNewDevice("threads=1")),
          scene_(rtcNewScene(device_)) {
        geometry_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        const std::size_t n = facets_.size();
        auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * n));
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), n));
        unsigned count = 0;
        for (const Facet& facet : facets_)
            for (const glm::dvec3& p : facet) {
                for (int c = 0; c < 3; ++c) *vertex++ = static_cast<float>(p[c]);
                *index++ = count++;
            }
        rtcCommitGeometry(geometry_);
        rtcAttachGeometry(scene_, geometry_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene_);
    }
    ~EmbreeFacets() {
        rtcReleaseGeometry(geometry_);
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeFacets(const EmbreeFacets&) = delete;

    struct Met {
        double t;       ///< along the unit direction
        double cosine;  ///< between the ray and the facet's normal, not negative
    };
    /// From the eye along a unit vector.
    std::optional<Met> trace(const glm::dvec3& d) const {
        RTCRayHit ray{};
        ray.ray.dir_x = static_cast<float>(d.x);
        ray.ray.dir_y = static_cast<float>(d.y);
        ray.ray.dir_z = static_cast<float>(d.z);
        ray.ray.tfar = 1e9f;
        ray.ray.mask = ~0u;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_, &context, &ray);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        const glm::dvec3 n(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
        return Met{ray.ray.tfar, std::abs(glm::dot(n, d)) / glm::length(n)};
    }

    /// From a point to the nearest facet, if that is within `most`; else infinite.
    double distance(const glm::dvec3& p, double most) const {
        Query query{&facets_, p, std::numeric_limits<double>::infinity()};
        RTCPointQuery around{static_cast<float>(p.x), static_cast<float>(p.y),
                             static_cast<float>(p.z), 0, static_cast<float>(most)};
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        rtcPointQuery(scene_, &around, &context, &EmbreeFacets::look_at, &query);
        return query.nearest <= most ? query.nearest : std::numeric_limits<double>::infinity();
    }

  private:
    struct Query {
        const std::vector<Facet>* facets;
        glm::dvec3 p;
        double nearest;
    };
    static bool look_at(RTCPointQueryFunctionArguments* arguments) {
        Query& query = *static_cast<Query*>(arguments->userPtr);
        const Facet& facet = (*query.facets)[arguments->primID];
        query.nearest = std::min(query.nearest, glm::distance(query.p, nearest_of(facet, query.p)));
        return false;
    }

    std::vector<Facet> facets_;
    RTCDevice device_;
    RTCScene scene_;
    RTCGeometry geometry_;
};

}  // namespace quadrel::render_tests
