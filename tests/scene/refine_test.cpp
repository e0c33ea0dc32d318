// Refinement by curvature: closed meshes stay closed, facets get flatter, flat things stay flat.
#include "quadrel/scene/refine.hpp"

#include <gtest/gtest.h>

#include <set>

#include "io/mesh/mesh_properties.hpp"
#include "quadrel/num/math.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/scene/shapes.hpp"
#include "scene/planted.hpp"
#include "scene/support.hpp"

namespace quadrel {
namespace {

using planted::Defect;
using Refine = std::function<Mesh(const Mesh&, int)>;

/// Refinement with an error: new vertices by each triangle for itself.
Refine refine(Defect defect) {
    if (defect == Defect::none) return refined_by_curvature;
    return [defect](const Mesh& mesh, int levels) {
        Mesh out = mesh;
        for (int level = 0; level < levels; ++level) {
            Mesh finer;
            for (const auto& t : out.triangles) {
                Mesh one;
                for (const std::uint32_t v : t) {
                    one.positions.push_back(out.positions[v]);
                    one.normals.push_back(out.normals[v]);
                    if (!out.uvs.empty()) one.uvs.push_back(out.uvs[v]);
                }
                one.triangles = {{0, 1, 2}};
                if (defect == Defect::flat_midpoints)
                    one.normals.assign(3, normalize(cross(one.positions[1] - one.positions[0],
                                                          one.positions[2] - one.positions[0])));
                const Mesh cut = refined_by_curvature(one, 1);
                const auto base = static_cast<std::uint32_t>(finer.positions.size());
                finer.positions.insert(finer.positions.end(), cut.positions.begin(),
                                       cut.positions.end());
                finer.normals.insert(finer.normals.end(), cut.normals.begin(), cut.normals.end());
                for (const auto& f : cut.triangles)
                    finer.triangles.push_back({f[0] + base, f[1] + base, f[2] + base});
            }
            out = finer;
        }
        return out;
    };
}

/// A torus with a seam of its own vertices whose normals differ a little from their twins'.
Mesh rough_torus() {
    Mesh mesh = flat_shaded(make_torus(0.4, 1, 7, 9));
    return mesh;
}

testing::AssertionResult stays_closed(const Refine& refine, const Mesh& mesh) {
    const Mesh finer = refine(mesh, 2);
    if (const auto result = is_closed(finer); !result) return result;
    if (finer.triangles.size() != 16 * mesh.triangles.size())
        return testing::AssertionFailure() << finer.triangles.size() << " triangles";
    return is_consistent(finer);
}

/// Welded corners, flat faces of their own vertices, seams in UV: no crack opens.
TEST(Refinement, KeepsClosedMeshesClosed) {
    for (const Mesh& mesh : {make_icosahedron(1, true), make_icosahedron(1, false), make_cube(2),
                             make_sphere(1, 12, 7), rough_torus()}) {
        EXPECT_TRUE(stays_closed(refine(Defect::none), mesh)) << mesh.name;
    }
    EXPECT_FALSE(stays_closed(refine(Defect::edges_of_each_side), rough_torus()));
}

/// Greatest distance of a vertex from the unit sphere.
double off_the_sphere(const Mesh& mesh) {
    double worst = 0;
    for (const auto& p : mesh.positions)
        worst = std::max(worst, std::abs(length(glm::dvec3(p)) - 1));
    return worst;
}

/// An icosahedron becomes a sphere, up to what the first level cannot know.
testing::AssertionResult gets_round(const Refine& refine) {
    const Mesh icosahedron = make_icosahedron(1, false);
    for (const int levels : {1, 2, 4}) {
        const double off = off_the_sphere(refine(icosahedron, levels));
        if (!(off < 0.04)) return testing::AssertionFailure() << levels << ": off by " << off;
    }
    const Mesh fine = refine(icosahedron, 3);
    return normals_agree(fine);
}

TEST(Refinement, MakesSpheresOfIcosahedra) {
    EXPECT_TRUE(gets_round(refine(Defect::none)));
    EXPECT_FALSE(gets_round(refine(Defect::flat_midpoints)));
}

/// The greatest angle between neighbouring facets, as its cosine, halves about with every level.
double sharpest_crease(const Mesh& mesh) {
    std::map<std::array<std::array<float, 3>, 2>, glm::dvec3> normals;
    double least = 1;
    for (const auto& t : mesh.triangles) {
        const auto corner = corners_of(mesh, t);
        const glm::dvec3 n = normalize(cross(corner[1] - corner[0], corner[2] - corner[0]));
        for (std::size_t i = 0; i < 3; ++i) {
            const auto key = [&](std::size_t k) {
                const glm::vec3 p = mesh.positions[t[k % 3]];
                return std::array<float, 3>{p.x, p.y, p.z};
            };
            normals[{key(i), key(i + 1)}] = n;
            const auto other = normals.find({key(i + 1), key(i)});
            if (other != normals.end()) least = std::min(least, dot(n, other->second));
        }
    }
    return acos(least) * 180 / 3.14159265358979;
}

TEST(Refinement, FlattensCreases) {
    const Mesh icosahedron = make_icosahedron(1, false);
    double last = sharpest_crease(icosahedron);
    EXPECT_NEAR(last, 41.81, 0.01);
    for (const int levels : {1, 2, 3}) {
        const double crease = sharpest_crease(refined_by_curvature(icosahedron, levels));
        EXPECT_LT(crease, 0.65 * last) << levels;
        last = crease;
    }
}

/// The plane stays a plane, its UV map affine.
TEST(Refinement, LeavesFlatThingsFlat) {
    const Mesh finer = refined_by_curvature(make_quad(2, 1, 1), 3);
    std::set<std::pair<float, float>> seen;
    for (std::size_t i = 0; i < finer.positions.size(); ++i) {
        const glm::vec3 p = finer.positions[i];
        EXPECT_EQ(p.z, 0);
        EXPECT_EQ(finer.uvs[i], glm::vec2(p.x + 1, p.y + 1) * 0.5f);
        EXPECT_TRUE(seen.emplace(p.x, p.y).second) << "a vertex twice";
    }
    EXPECT_EQ(seen.size(), 81u);
    EXPECT_EQ(finer.triangles.size(), 128u);
}

TEST(Refinement, KeepsTangents) {
    Mesh mesh = make_quad(2, 1, 1);
    mesh.tangents.assign(4, glm::vec4(1, 0, 0, -1));
    for (const glm::vec4& t : refined_by_curvature(mesh, 2).tangents)
        EXPECT_EQ(t, glm::vec4(1, 0, 0, -1));
    EXPECT_EQ(refined_by_curvature(mesh, 0).positions, mesh.positions);
}

// ---- In scene files -----------------------------------------------------------------------------

Scene scene_of(const TemporaryFolder& folder, const std::string& mesh) {
    return load_scene(
        folder.write("s.json", R"({"quadrel": 1, "objects": [{"mesh": )" + mesh + "}]}"));
}

TEST(Refinement, IsAKeyOfMeshes) {
    const TemporaryFolder folder;
    const auto triangles = [&](const std::string& refine) {
        return scene_of(folder, R"({"shape": "cube", "refine": )" + refine + "}")
            .meshes[0]
            .triangles.size();
    };
    EXPECT_EQ(triangles(R"("curvature")"), 48u);
    EXPECT_EQ(triangles(R"({"by": "curvature"})"), 48u);
    EXPECT_EQ(triangles(R"({"by": "curvature", "levels": 3})"), 12u * 64);
    for (const char* wrong :
         {R"("angle")", R"({"by": "angle"})", R"({"levels": 1})", "2",
          R"({"by": "curvature", "levels": 0})", R"({"by": "curvature", "levels": 7})",
          R"({"by": "curvature", "level": 1})"})
        EXPECT_THROW(triangles(wrong), InputError) << wrong;
}

/// Facets are made after refinement: flat normals of the finer mesh.
TEST(Refinement, ComesBeforeFlatNormals) {
    const TemporaryFolder folder;
    const auto normals = [&](const std::string& word) {
        const Mesh mesh =
            scene_of(folder, R"({"shape": "icosahedron", "refine": "curvature", "normals": ")" +
                                 word + "\"}")
                .meshes[0];
        std::set<std::array<float, 3>> different;
        for (const auto& n : mesh.normals) different.insert({n.x, n.y, n.z});
        return different.size();
    };
    EXPECT_EQ(normals("flat"), 80u);
    EXPECT_EQ(normals("smooth"), 42u);
}

}  // namespace
}  // namespace quadrel
