// The tetrahedra of shells: neighbours agree on the faces between them, and rays go from one to the
// next without a gap or a place that two of them hold.
#include "render/draw/shell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
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

/// A mesh with its vertices and the corners of its triangles in an order of chance.
Mesh shuffled(const Mesh& mesh) {
    Random random(5);
    const std::size_t n = mesh.positions.size();
    std::vector<std::uint32_t> place(n);  // of each vertex
    for (std::size_t i = 0; i < n; ++i) place[i] = static_cast<std::uint32_t>(i);
    for (std::size_t i = n; i > 1; --i)
        std::swap(place[i - 1], place[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
    Mesh out = mesh;
    for (std::size_t i = 0; i < n; ++i) {
        out.positions[place[i]] = mesh.positions[i];
        out.normals[place[i]] = mesh.normals[i];
        out.uvs[place[i]] = mesh.uvs[i];
    }
    for (auto& triangle : out.triangles) {
        for (std::uint32_t& corner : triangle) corner = place[corner];
        std::rotate(triangle.begin(), triangle.begin() + random.below(3), triangle.end());
    }
    return out;
}

/// A shell in eye space, 3 in front of the eye.
struct PlacedShell {
    Mesh mesh;
    ShadedVertices base;
    Material material;
    Shell shell;
    Split split;

    PlacedShell(const Mesh& of, double depth, double seat, Split cut = Split::by_vertex)
        : mesh(shuffled(of)),
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
    std::array<double, 4> s;  ///< depth below the shell's top at the corners

    Solid(const Shell& shell, const ShellTetrahedron& tetrahedron) {
        std::array<glm::dvec3, 4> p;
        const auto& eye = shell.vertices().eye;
        for (std::size_t k = 0; k < 4; ++k) {
            p[k] = eye[tetrahedron[k]];
            s[k] = tetrahedron[k] < eye.size() / 2 ? 1 : 0;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec3 a = p[(k + 1) % 4], b = p[(k + 2) % 4], c = p[(k + 3) % 4];
            const glm::dvec3 n = glm::cross(b - a, c - a);
            gradient[k] = n / glm::dot(n, p[k] - a);
            offset[k] = -glm::dot(gradient[k], a);
        }
    }

    double s_at(const glm::dvec3& p) const {
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k) sum += s[k] * (glm::dot(gradient[k], p) + offset[k]);
        return sum;
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

/// Rays through the shell of a closed mesh: pieces follow each other, but where a ray is above the
/// shell's top or below its bottom.
struct RayTally {
    int rays = 0, pieces = 0, gaps = 0, overlaps = 0;
};

/// A part of a ray in a tetrahedron, and whether it ends at the shell's top or bottom.
struct RayPart {
    double from, to;
    bool ends_outside;
};

std::vector<RayPart> parts_of(const std::vector<Solid>& solids, const glm::dvec3& d) {
    std::vector<RayPart> parts;
    for (const Solid& solid : solids) {
        const auto [from, to] = solid.part(d);
        if (!(to > from)) continue;
        const double s = solid.s_at(d * to);
        parts.push_back({from, to, s < 1e-9 || s > 1 - 1e-9});
    }
    std::ranges::sort(parts, {}, &RayPart::from);
    return parts;
}

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
        const std::vector<RayPart> parts = parts_of(
            solids,
            glm::normalize(glm::dvec3(random.uniform(-1.1, 1.3), random.uniform(-1.4, 1.0), -3)));
        if (parts.empty()) continue;
        ++tally.rays;
        tally.pieces += static_cast<int>(parts.size());
        constexpr double rounding = 1e-9;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const bool last = i + 1 == parts.size();
            const double apart = last ? 1.0 : parts[i + 1].from - parts[i].to;
            tally.overlaps += apart < -rounding;
            tally.gaps += apart > rounding && !parts[i].ends_outside;
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
        EXPECT_EQ(tally.gaps, 0);
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

// ---- Beside prisms with bilinear sides
// -----------------------------------------------------------

/// How far points of a height are from where the shell between interpolated positions and normals
/// has them, in parts of the depth, and the bound of shell_face.hpp.
struct ShellDeparture {
    double mean = 0, most = 0, bound = 0;
};

ShellDeparture departure_from_bilinear(const Mesh& mesh, int points) {
    const PlacedShell placed(mesh, 1.0 / 64, 1);
    const auto& eye = placed.shell.vertices().eye;
    const auto& normal = placed.shell.vertices().normal;
    const auto n = static_cast<std::uint32_t>(placed.mesh.positions.size());
    Random random(4);
    ShellDeparture departure;
    int seen = 0;
    for (std::uint32_t t = 0; t < placed.mesh.triangles.size(); ++t) {
        const auto tetrahedra = placed.shell.tetrahedra(t);
        const std::array<std::uint32_t, 3> v{tetrahedra[0][0], tetrahedra[0][1], tetrahedra[0][2]};
        if (is_flat(eye[v[0]], eye[v[1]], eye[v[2]])) continue;
        for (int k = 0; k < 3; ++k)
            departure.bound = std::max(
                departure.bound,
                0.25 * glm::distance(glm::dvec3(normal[v[k]]), glm::dvec3(normal[v[(k + 1) % 3]])));
        for (int point = 0; point < points; ++point, ++seen) {
            const double h = random.uniform(0, 1), a = random.uniform(0, 1);
            const double b = random.uniform(0, 1 - a), weight[3] = {a, b, 1 - a - b};
            glm::dvec3 bilinear(0), affine(0);
            double left = h;  // of the height, from the last vertex on
            for (int k = 2; k >= 0; --k) {
                const glm::dvec3 bottom = eye[v[k]], top = eye[n + v[k]];
                const double risen = std::clamp(left, 0.0, weight[k]);
                bilinear += (bottom * (1 - h) + top * h) * weight[k];
                affine += bottom * (weight[k] - risen) + top * risen;
                left -= weight[k];
            }
            const double off = 64 * glm::distance(bilinear, affine);
            departure.mean += off;
            departure.most = std::max(departure.most, off);
        }
    }
    departure.mean /= seen;
    return departure;
}

/// The table of bench/README.md.
TEST(Shell, DepartsFromBilinearSidesByAQuarterOfTheNormalsDifference) {
    const std::pair<const char*, Mesh> meshes[] = {
        {"sphere, 12 x 8", make_sphere(1, 12, 8)},
        {"sphere, 32 x 32", make_sphere(1, 32, 32)},
        {"sphere, 128 x 128", make_sphere(1, 128, 128)},
        {"torus, 32 x 32", make_torus(0.5, 1.15, 32, 32)},
        {"teapot, 16", make_teapot(16, 1.4)}};
    for (const auto& [name, mesh] : meshes) {
        const ShellDeparture off = departure_from_bilinear(mesh, 16);
        std::printf("| %s | %.4f | %.4f | %.4f |\n", name, off.mean, off.most, off.bound);
        EXPECT_LE(off.most, off.bound + 1e-4) << name;
        EXPECT_GT(off.most, 0.5 * off.bound) << name;
    }
    const double coarse = departure_from_bilinear(make_sphere(1, 32, 32), 16).most;
    EXPECT_NEAR(departure_from_bilinear(make_sphere(1, 64, 64), 16).most, coarse / 2, coarse / 8);
}

}  // namespace
}  // namespace quadrel::render_tests
