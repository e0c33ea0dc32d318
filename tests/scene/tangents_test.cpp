// Tangents against those of surfaces whose parametrisation is known, which a glTF file carries; and
// against themselves under renumbering.
#include "quadrel/scene/tangents.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "io/gltf/gltf_files.hpp"
#include "quadrel/num/math.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "quadrel/scene/shapes.hpp"
#include "scene/planted.hpp"
#include "scene/support.hpp"

namespace quadrel {
namespace {

using planted::Defect;
using CornerTangents = std::vector<std::array<glm::vec4, 3>>;
using MakeTangents = std::function<CornerTangents(const Mesh&)>;

// ---- Meshes of known tangents -------------------------------------------------------------------

/// A strip of a cylinder about z, its circle closed by a seam: u runs `turns` times round it, v
/// upwards; where `mirrored`, u runs back in the second half. mesh.tangents are the surface's own,
/// with w for a bitangent along v.
Mesh cylinder(int segments, bool mirrored = false, double turns = 1) {
    Mesh mesh;
    for (int i = 0; i <= segments; ++i) {
        const double turn = i == segments ? 0 : double(i) / segments * 2 * 3.14159265358979;
        const double c = cos(turn), s = sin(turn), half = double(i) / segments;
        const bool back = mirrored && 2 * i > segments;
        for (const double z : {0.0, 0.7}) {
            mesh.positions.emplace_back(glm::dvec3(c, s, z));
            mesh.normals.emplace_back(glm::dvec3(c, s, 0));
            mesh.uvs.emplace_back(turns * (back ? 1 - half : half), z);
            const double side = back ? -1 : 1;
            mesh.tangents.emplace_back(glm::dvec4(-s * side, c * side, 0, side));
        }
    }
    for (int i = 0; i < segments; ++i) {
        const auto a = static_cast<std::uint32_t>(2 * i);
        mesh.triangles.push_back({a, a + 2, a + 3});
        mesh.triangles.push_back({a, a + 3, a + 1});
    }
    return mesh;
}

/// The same mesh by way of a file. glTF's bitangents point up the picture, against v.
Mesh through_gltf(const Mesh& mesh) {
    std::vector<float> positions, normals, uvs, tangents;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            positions.push_back(mesh.positions[i][c]);
            normals.push_back(mesh.normals[i][c]);
        }
        for (int c = 0; c < 2; ++c) uvs.push_back(mesh.uvs[i][c]);
        for (int c = 0; c < 3; ++c) tangents.push_back(mesh.tangents[i][c]);
        tangents.push_back(-mesh.tangents[i].w);
    }
    std::vector<std::uint16_t> indices;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t index : triangle)
            indices.push_back(static_cast<std::uint16_t>(index));
    GltfBuilder gltf;
    const int p = gltf.floats(positions, "VEC3", 3), n = gltf.floats(normals, "VEC3", 3);
    const int t = gltf.floats(uvs, "VEC2", 2), g = gltf.floats(tangents, "VEC4", 4);
    const int i = gltf.shorts(indices);
    gltf.set_primitive(
        {{"attributes", {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", t}, {"TANGENT", g}}},
         {"indices", i}});
    const TemporaryFolder folder;
    return load_mesh(folder.write("mesh.glb", gltf.binary()));
}

// ---- Tangents with an error ---------------------------------------------------------------------

glm::dvec3 unit(const glm::dvec3& v) {
    const double squared = dot(v, v);
    return squared > 0 ? v / std::sqrt(squared) : glm::dvec3(0);
}

/// The right ones, or sums in float over the vertices' indices that leave something out.
CornerTangents tangents(const Mesh& mesh, Defect defect = Defect::none) {
    if (defect == Defect::none) return mikkt_tangents(mesh);
    std::vector<glm::vec3> sum(mesh.positions.size(), glm::vec3(0));
    CornerTangents out(mesh.triangles.size());
    for (std::size_t t = 0; t < out.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const glm::dvec3 e1(mesh.positions[b] - mesh.positions[a]);
        const glm::dvec3 e2(mesh.positions[c] - mesh.positions[a]);
        const glm::dvec2 d1(mesh.uvs[b] - mesh.uvs[a]), d2(mesh.uvs[c] - mesh.uvs[a]);
        const double det = d1.x * d2.y - d2.x * d1.y;
        const glm::dvec3 dPdu = unit((e1 * d2.y - e2 * d1.y) / det);
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 to_next(mesh.positions[mesh.triangles[t][(k + 1) % 3]] -
                                     mesh.positions[mesh.triangles[t][k]]);
            const glm::dvec3 to_last(mesh.positions[mesh.triangles[t][(k + 2) % 3]] -
                                     mesh.positions[mesh.triangles[t][k]]);
            const double angle = acos(dot(unit(to_next), unit(to_last)));
            const double weight = defect == Defect::unweighted_tangents ? 1 : angle;
            sum[mesh.triangles[t][k]] += glm::vec3(dPdu * weight);
            out[t][k].w = det < 0 ? -1.0f : 1.0f;
        }
    }
    for (std::size_t t = 0; t < out.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto index = mesh.triangles[t][k];
            const glm::dvec3 n(mesh.normals[index]), v(sum[index]);
            const bool keep = defect == Defect::tangents_off_the_plane;
            const glm::dvec3 T = unit(keep ? v : v - n * dot(n, v));
            out[t][k] = glm::vec4(glm::vec3(T), out[t][k].w);
        }
    }
    return out;
}

MakeTangents with(Defect defect) {
    return [defect](const Mesh& mesh) { return tangents(mesh, defect); };
}
const MakeTangents right = with(Defect::none);

// ---- Known geometry -----------------------------------------------------------------------------

/// Every corner has its vertex's own tangent, and the handedness times `side`, up to `tolerance`.
testing::AssertionResult are_the_own(const MakeTangents& make, const Mesh& mesh, double tolerance,
                                     float side = 1) {
    const CornerTangents made = make(mesh);
    for (std::size_t t = 0; t < made.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec4 own = mesh.tangents[mesh.triangles[t][k]];
            const double off = length(glm::dvec3(made[t][k]) - glm::dvec3(own));
            if (off <= tolerance && made[t][k].w == side * own.w) continue;
            return testing::AssertionFailure() << "triangle " << t << ", corner " << k
                                               << ": off by " << off << ", w " << made[t][k].w;
        }
    }
    return testing::AssertionSuccess();
}

/// By symmetry the averages on a cylinder are exact, at the seam too, where only one side counts:
/// the tangent of a facet lies in the plane of the vertex's normal once it is projected. With
/// angles as weights it does not matter that a vertex has one triangle on one side and two on the
/// other.
TEST(MikktTangents, AreExactOnACylinder) {
    for (const int segments : {5, 8, 31})
        EXPECT_TRUE(are_the_own(right, cylinder(segments), 3e-7)) << segments;
    EXPECT_FALSE(are_the_own(with(Defect::tangents_off_the_plane), cylinder(8), 3e-7));
}

TEST(MikktTangents, AgreeWithThoseOfAGltfFile) {
    const Mesh mesh = through_gltf(cylinder(12));
    ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
    EXPECT_TRUE(are_the_own(right, mesh, 3e-7, -1));
    EXPECT_FALSE(are_the_own(right, mesh, 3e-7, 1));
}

/// A corner where the slopes of u around differ: angles decide, not the number of triangles.
testing::AssertionResult diagonals_do_not_matter(const MakeTangents& make) {
    // A roof with its ridge along y, normals of the ridge upwards; each side is one quad, cut along
    // either diagonal. u runs across the ridge on the left and askew on the right.
    Mesh mesh;
    const double height[] = {0, 1, 0.2};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 2; ++j) {
            mesh.positions.emplace_back(glm::dvec3(i - 1, j, height[i]));
            mesh.normals.emplace_back(0, 0, 1);
            mesh.uvs.emplace_back(i, j + (i == 2 ? 0.6 : 0.0));
        }
    }
    glm::vec3 first(0);
    for (int cut = 0; cut < 4; ++cut) {
        mesh.triangles.clear();
        for (std::uint32_t side = 0; side < 2; ++side) {
            const std::uint32_t a = 2 * side, b = a + 2, c = a + 3, d = a + 1;
            if (cut >> side & 1) {
                mesh.triangles.push_back({a, b, c});
                mesh.triangles.push_back({a, c, d});
            } else {
                mesh.triangles.push_back({a, b, d});
                mesh.triangles.push_back({b, c, d});
            }
        }
        // Vertex 2 lies on the ridge; the left side is planar in UV, so its cut must not matter.
        const CornerTangents made = make(mesh);
        for (std::size_t t = 0; t < made.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                if (mesh.triangles[t][k] == 2) {
                    const glm::vec3 T(made[t][k]);
                    if (cut == 0) first = T;
                    if (cut == 1 && length(glm::dvec3(T - first)) > 1e-6)
                        return testing::AssertionFailure() << "turned by the cut";
                }
    }
    return testing::AssertionSuccess();
}

TEST(MikktTangents, AreWeightedByAngles) {
    EXPECT_TRUE(diagonals_do_not_matter(right));
    EXPECT_FALSE(diagonals_do_not_matter(with(Defect::unweighted_tangents)));
}

/// Where u turns back, vertices are shared by triangles of both orientations: each keeps its own.
testing::AssertionResult mirrored_halves_stay_apart(const MakeTangents& make) {
    const Mesh plain = cylinder(8), mesh = cylinder(8, true);
    const CornerTangents forth = make(plain), both = make(mesh);
    for (std::size_t t = 0; t < both.size(); ++t) {
        const float side = t < both.size() / 2 ? 1.0f : -1.0f;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 expected(glm::vec3(forth[t][k]) * side);
            const double off = length(glm::dvec3(both[t][k]) - expected);
            if (!(off < 1e-6) || both[t][k].w != side)
                return testing::AssertionFailure() << "triangle " << t << ": off by " << off;
        }
    }
    return testing::AssertionSuccess();
}

TEST(MikktTangents, MirroredHalvesStayApart) {
    EXPECT_TRUE(mirrored_halves_stay_apart(right));
    EXPECT_FALSE(mirrored_halves_stay_apart(with(Defect::orientations_mixed)));
}

/// On the sphere the tangents run along the circles of latitude, up to the size of a facet; but
/// for the caps, where u has no direction.
TEST(MikktTangents, FollowTheCirclesOfASphere) {
    const Mesh sphere = make_sphere(1, 48, 32);
    const CornerTangents made = mikkt_tangents(sphere);
    int compared = 0;
    for (std::size_t t = 0; t < made.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 n(sphere.normals[sphere.triangles[t][k]]);
            if (std::abs(n.z) > 0.9) continue;
            const glm::dvec3 T(made[t][k]), circle = unit(glm::dvec3(-n.y, n.x, 0));
            EXPECT_GT(std::abs(dot(T, circle)), 0.997);
            EXPECT_NEAR(dot(T, n), 0, 1e-6);
            EXPECT_NEAR(length(T), 1, 1e-6);
            ++compared;
        }
    }
    EXPECT_GT(compared, 4000);
}

TEST(MikktTangents, DegenerateTrianglesBorrowTheirNeighbours) {
    Mesh mesh = make_quad(2, 1, 1);
    // A triangle without UV area on two of the corners, one without any on new ones.
    mesh.triangles.push_back({0, 1, 0});
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 3; ++i) {
        mesh.positions.emplace_back(i, 5, i * i);
        mesh.normals.emplace_back(0, 0, 1);
        mesh.uvs.emplace_back(0.5, 0.5);
    }
    mesh.triangles.push_back({base, base + 1, base + 2});
    const CornerTangents made = mikkt_tangents(mesh);
    EXPECT_EQ(made[2][0], glm::vec4(1, 0, 0, 1));
    const glm::dvec3 T(made[3][0]);
    EXPECT_NEAR(length(T), 1, 1e-6);
    EXPECT_NEAR(T.z, 0, 1e-6);
    EXPECT_EQ(made[3][0].w, 1);
    EXPECT_EQ(uv_tangents(mesh)[3][0].dPdu, glm::vec3(0));
}

// ---- Order --------------------------------------------------------------------------------------

/// The mesh with its vertices, triangles, and corners within them in another order; `origin` tells
/// for each triangle and corner where it was.
struct Renumbered {
    Mesh mesh;
    std::vector<std::array<std::size_t, 3>> origin;  ///< 3 * triangle + corner
};

Renumbered renumbered(const Mesh& mesh, std::uint32_t seed) {
    const auto shuffled = [&](std::size_t count) {
        std::vector<std::size_t> order(count);
        std::iota(order.begin(), order.end(), std::size_t(0));
        for (std::size_t i = count; i > 1; --i) {
            seed = seed * 1664525u + 1013904223u;
            std::swap(order[i - 1], order[(seed >> 8) % i]);
        }
        return order;
    };
    Renumbered out;
    const auto vertices = shuffled(mesh.positions.size());
    std::vector<std::uint32_t> place(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        place[vertices[i]] = static_cast<std::uint32_t>(i);
        out.mesh.positions.push_back(mesh.positions[vertices[i]]);
        out.mesh.normals.push_back(mesh.normals[vertices[i]]);
        out.mesh.uvs.push_back(mesh.uvs[vertices[i]]);
    }
    for (const std::size_t t : shuffled(mesh.triangles.size())) {
        std::array<std::uint32_t, 3> triangle;
        std::array<std::size_t, 3> origin;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t from = (k + t) % 3;
            triangle[k] = place[mesh.triangles[t][from]];
            origin[k] = 3 * t + from;
        }
        out.mesh.triangles.push_back(triangle);
        out.origin.push_back(origin);
    }
    return out;
}

testing::AssertionResult order_does_not_matter(const MakeTangents& make, const Mesh& mesh) {
    const CornerTangents plain = make(mesh);
    for (std::uint32_t seed = 1; seed < 5; ++seed) {
        const Renumbered other = renumbered(mesh, seed);
        const CornerTangents made = make(other.mesh);
        for (std::size_t t = 0; t < made.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k)
                if (made[t][k] != plain[other.origin[t][k] / 3][other.origin[t][k] % 3])
                    return testing::AssertionFailure() << "triangle " << t;
    }
    return testing::AssertionSuccess();
}

CornerTangents dPdu_alone(const Mesh& mesh) {
    CornerTangents out;
    for (const auto& corners : uv_tangents(mesh)) {
        out.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            out.back()[k] = glm::vec4(corners[k].dPdu, corners[k].dPdv.x);
    }
    return out;
}

TEST(Tangents, OrderDoesNotMatter) {
    const Mesh torus = make_torus(0.4, 1.1, 9, 14), mirrored = cylinder(9, true, 3);
    for (const Mesh* mesh : {&torus, &mirrored}) {
        EXPECT_TRUE(order_does_not_matter(right, *mesh));
        EXPECT_TRUE(order_does_not_matter(dPdu_alone, *mesh));
    }
    EXPECT_FALSE(order_does_not_matter(with(Defect::summed_as_numbered), torus));
}

// ---- dP/du and dP/dv ----------------------------------------------------------------------------

/// On a plane they are the map's own, whatever its scale, shear and mirroring.
TEST(UvTangents, AreExactOnAPlane) {
    for (const glm::dvec4 map : {glm::dvec4(1, 0, 0, 1), glm::dvec4(0.1, 0, 0, 4),
                                 glm::dvec4(-2, 0.5, 1, 3), glm::dvec4(0, 1, 1, 0)}) {
        Mesh mesh = make_quad(2, 3, 2);
        for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
            const glm::dvec2 p(mesh.positions[i]);
            mesh.uvs[i] = {map.x * p.x + map.y * p.y, map.z * p.x + map.w * p.y};
        }
        const double det = map.x * map.w - map.y * map.z;
        const glm::dvec3 dPdu(map.w / det, -map.z / det, 0), dPdv(-map.y / det, map.x / det, 0);
        for (const auto& corners : uv_tangents(mesh)) {
            for (const UvTangents& t : corners) {
                EXPECT_LT(length(glm::dvec3(t.dPdu) - dPdu), 1e-5 * length(dPdu));
                EXPECT_LT(length(glm::dvec3(t.dPdv) - dPdv), 1e-5 * length(dPdv));
            }
        }
    }
}

/// Facets that lean from one another shorten no tangent: the density is that of the facets.
testing::AssertionResult density_survives(
    const std::function<std::vector<std::array<UvTangents, 3>>(const Mesh&)>& make) {
    const int segments = 5;
    const double side = 2 * sin(3.14159265358979 / segments), expected = side * segments;
    for (const auto& corners : make(cylinder(segments)))
        for (const UvTangents& t : corners)
            if (std::abs(length(glm::dvec3(t.dPdu)) - expected) > 1e-5)
                return testing::AssertionFailure() << length(glm::dvec3(t.dPdu));
    return testing::AssertionSuccess();
}

TEST(UvTangents, DensitySurvivesTheAverage) {
    EXPECT_TRUE(density_survives(uv_tangents));
    EXPECT_FALSE(density_survives([](const Mesh& mesh) {
        // The mean of the vectors, as if lengths did not matter.
        auto made = uv_tangents(mesh);
        for (auto& corners : made)
            for (UvTangents& t : corners) t.dPdu *= 0.9510565f;
        return made;
    }));
}

}  // namespace
}  // namespace quadrel
