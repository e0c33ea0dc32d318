// The tetrahedra of shells: neighbours agree on the faces between them, and rays go from one to the
// next without a gap or a place that two of them hold.
#include "render/draw/shell.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "quadrel/scene/shapes.hpp"
#include "random.hpp"

namespace quadrel::render_tests {
namespace {

using test::Random;

/// How the prisms are cut.
enum class Split {
    by_vertex,  ///< as they are
    by_corner,  ///< planted: in the order of the triangle's corners
    by_number,  ///< planted: by the vertices' numbers, two of which are one at seams
};

/// A mesh that turns all ways, its corners in an order of chance.
Mesh shuffled(Mesh mesh) {
    Random random(5);
    for (auto& triangle : mesh.triangles)
        for (int turn = random.below(3); turn > 0; --turn)
            std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
    return mesh;
}

/// A shell in eye space, 3 in front of the eye.
struct PlacedShell {
    Mesh mesh;
    ShadedVertices base;
    Material material;
    Shell shell;
    Split split;

    PlacedShell(Mesh of, double depth, double seat, Split cut = Split::by_vertex)
        : mesh(shuffled(std::move(of))),
          base(placed(mesh)),
          material(of_depth(depth, seat)),
          shell(mesh, base, material, glm::mat4(1.0f)),
          split(cut) {}
    PlacedShell(const PlacedShell&) = delete;

    std::array<ShellTetrahedron, 3> tetrahedra(std::uint32_t t) const {
        if (split == Split::by_vertex) return shell.tetrahedra(t);
        auto v = mesh.triangles[t];
        if (split == Split::by_number) std::sort(v.begin(), v.end());
        const auto n = static_cast<std::uint32_t>(mesh.positions.size());
        const auto [a, b, c] = v;
        return {{{a, b, c, n + c}, {a, b, n + b, n + c}, {a, n + a, n + b, n + c}}};
    }

  private:
    static ShadedVertices placed(const Mesh& mesh) {
        ShadedVertices out;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            out.eye.push_back(mesh.positions[i] + glm::vec3(0.1f, -0.2f, -3.0f));
            out.clip.emplace_back();
            out.normal.push_back(mesh.normals[i]);
            out.uv.push_back(mesh.uvs[i]);
        }
        return out;
    }
    static Material of_depth(double depth, double seat) {
        Material material;
        material.depth = static_cast<float>(depth);
        material.seat = static_cast<float>(seat);
        return material;
    }
};

// ---- Faces --------------------------------------------------------------------------------------

using Point = std::array<float, 3>;

/// Every wall of the shell of a closed mesh has two sides, corner by corner of the same bits; its
/// top and bottom have one.
testing::AssertionResult neighbours_agree(const PlacedShell& placed) {
    std::map<std::set<Point>, int> sides;
    const auto& eye = placed.shell.vertices().eye;
    for (std::uint32_t t = 0; t < placed.mesh.triangles.size(); ++t) {
        const auto& corners = placed.mesh.triangles[t];
        if (is_flat(placed.base.eye[corners[0]], placed.base.eye[corners[1]],
                    placed.base.eye[corners[2]]))
            continue;
        for (const ShellTetrahedron& tetrahedron : placed.tetrahedra(t))
            for (std::size_t opposite = 0; opposite < 4; ++opposite) {
                std::set<Point> face;
                for (std::size_t k = 0; k < 4; ++k) {
                    const glm::vec3 p = eye[tetrahedron[k]] + 0.0f;
                    if (k != opposite) face.insert({p.x, p.y, p.z});
                }
                ++sides[face];
            }
    }
    int once = 0, more = 0;
    for (const auto& [face, count] : sides) {
        once += count == 1;
        more += count > 2;
    }
    // Top and bottom of each triangle that is drawn.
    std::set<std::set<Point>> drawn;
    for (const auto& corners : placed.mesh.triangles) {
        std::set<Point> face;
        for (const std::uint32_t i : corners) face.insert({eye[i].x, eye[i].y, eye[i].z});
        if (face.size() == 3) drawn.insert(face);
    }
    if (more == 0 && once == 2 * static_cast<int>(drawn.size())) return testing::AssertionSuccess();
    return testing::AssertionFailure() << once << " faces of one side for " << drawn.size()
                                       << " triangles, " << more << " of more than two";
}

std::map<std::string, Mesh> closed_meshes() {
    return {{"sphere", make_sphere(1, 12, 8)}, {"torus", make_torus(0.3, 0.8, 7, 9)}};
}

TEST(Shell, NeighboursAgreeOnTheirFaces) {
    for (const auto& [name, mesh] : closed_meshes())
        for (const double seat : {0.0, 0.5, 1.0}) {
            EXPECT_TRUE(neighbours_agree({mesh, 0.1, seat})) << name;
            EXPECT_FALSE(neighbours_agree({mesh, 0.1, seat, Split::by_corner})) << name;
            EXPECT_FALSE(neighbours_agree({mesh, 0.1, seat, Split::by_number})) << name;
        }
}

// ---- Rays ---------------------------------------------------------------------------------------

/// A tetrahedron as four planes: inside where all are at least 0.
struct Solid {
    std::array<glm::dvec3, 4> gradient;
    std::array<double, 4> offset;

    Solid(const Shell& shell, const ShellTetrahedron& tetrahedron) {
        std::array<glm::dvec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) p[k] = shell.vertices().eye[tetrahedron[k]];
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec3 a = p[(k + 1) % 4], b = p[(k + 2) % 4], c = p[(k + 3) % 4];
            const glm::dvec3 n = glm::cross(b - a, c - a);
            gradient[k] = n / glm::dot(n, p[k] - a);
            offset[k] = -glm::dot(gradient[k], a);
        }
    }

    /// Where a ray from the origin is inside; empty where first >= second.
    std::pair<double, double> part(const glm::dvec3& d) const {
        double from = 0, to = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 4; ++k) {
            const double rate = glm::dot(gradient[k], d), at = -offset[k] / rate;
            if (rate > 0) from = std::max(from, at);
            if (rate < 0) to = std::min(to, at);
        }
        return {from, to};
    }
};

/// Rays through the shell of a closed mesh: pieces follow each other, but where the ray is outside
/// of the mesh or inside of its hollow.
struct RayTally {
    int rays = 0, pieces = 0, gaps = 0, overlaps = 0;
};

RayTally follow_rays(const PlacedShell& placed, int count) {
    std::vector<Solid> solids;
    for (std::uint32_t t = 0; t < placed.mesh.triangles.size(); ++t) {
        const auto& corners = placed.mesh.triangles[t];
        if (is_flat(placed.base.eye[corners[0]], placed.base.eye[corners[1]],
                    placed.base.eye[corners[2]]))
            continue;
        for (const ShellTetrahedron& tetrahedron : placed.tetrahedra(t))
            solids.emplace_back(placed.shell, tetrahedron);
    }
    Random random(9);
    RayTally tally;
    while (tally.rays < count) {
        const glm::dvec3 d =
            glm::normalize(glm::dvec3(random.uniform(-1.1, 1.3), random.uniform(-1.4, 1.0), -3));
        std::vector<std::pair<double, double>> parts;
        for (const Solid& solid : solids) {
            const auto part = solid.part(d);
            if (part.second > part.first) parts.push_back(part);
        }
        if (parts.empty()) continue;
        ++tally.rays;
        std::sort(parts.begin(), parts.end());
        tally.pieces += static_cast<int>(parts.size());
        constexpr double rounding = 1e-9, least_room = 0.02;
        for (std::size_t i = 1; i < parts.size(); ++i) {
            const double apart = parts[i].first - parts[i - 1].second;
            tally.overlaps += apart < -rounding;
            // Out of the shell and in again is a way at least.
            tally.gaps += apart > rounding && apart < least_room;
        }
    }
    return tally;
}

int rays_to_follow() {
    const char* const rays = std::getenv("QUADREL_SHELL_RAYS");
    return rays ? std::atoi(rays) : 10000;
}

TEST(Shell, RaysMeetNeitherGapsNorPlacesThatTwoHold) {
    const int rays = rays_to_follow();
    for (const double seat : {0.0, 1.0}) {
        const RayTally tally = follow_rays({make_sphere(1, 12, 8), 0.15, seat}, rays);
        EXPECT_EQ(tally.overlaps, 0);
        // Beside an edge of the outline a ray may leave and come back at once.
        EXPECT_LE(tally.gaps, rays / 500);
        EXPECT_GT(tally.pieces, 5 * rays);
    }
    const RayTally wrong = follow_rays({make_sphere(1, 12, 8), 0.15, 1.0, Split::by_corner}, 2000);
    EXPECT_GT(wrong.overlaps, 100);
    EXPECT_GT(wrong.gaps, 100);
}

// ---- Rows ---------------------------------------------------------------------------------------

/// uv and s of the row at the face's corners and at the corner opposite, by its gradients.
testing::AssertionResult maps_are_affine(double planted = 0) {
    const PlacedShell placed(make_sphere(1, 12, 8), 0.1, 0.5);
    const auto& vertices = placed.shell.vertices();
    const auto n = static_cast<std::uint32_t>(placed.mesh.positions.size());
    int faces_seen = 0;
    for (std::uint32_t t = 0; t < placed.mesh.triangles.size(); ++t) {
        std::vector<ShellTriangle> faces;
        placed.shell.append_faces({t, {0, 1, 2}}, faces);
        for (const ShellTriangle& face : faces) {
            ++faces_seen;
            const glm::dvec3 origin = vertices.eye[face.index[0]];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t index = face.index[k];
                if (placed.mesh.triangles[t][face.corner[k]] != index % n)
                    return testing::AssertionFailure() << "another corner";
                const glm::dvec3 w = glm::dvec3(vertices.eye[index]) - origin;
                const auto along = [&](const float* g) {
                    return g[0] * w.x + g[1] * w.y + g[2] * w.z;
                };
                const double s = face.face.s[0] + along(face.face.s_gradient);
                const double u = vertices.uv[face.index[0]].x + along(face.face.J);
                const double off = std::max(std::abs(s - (index < n ? 1 : 0)),
                                            std::abs(u + planted - vertices.uv[index].x));
                // Barycentric coordinates are 1 at their own corner and 0 at the others.
                for (std::size_t of = 0; of < 3; ++of) {
                    const double weight = (of == 0) + along(face.face.gradient[of]);
                    if (std::abs(weight - (of == k)) > 1e-4)
                        return testing::AssertionFailure() << "weight " << weight;
                }
                if (off > 1e-4) return testing::AssertionFailure() << off << " off";
            }
        }
    }
    return faces_seen > 1000 ? testing::AssertionSuccess() : testing::AssertionFailure() << "few";
}

TEST(Shell, RowsAreAffineMaps) {
    EXPECT_TRUE(maps_are_affine());
    EXPECT_FALSE(maps_are_affine(0.01));
}

}  // namespace
}  // namespace quadrel::render_tests
