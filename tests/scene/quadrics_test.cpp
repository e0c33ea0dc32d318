// Quadrics that are fitted to meshes: those of spheres and tori have the curvatures of these, faces
// of a cube none, whatever order triangles and vertices come in.
#include "quadrel/scene/quadrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "quadrel/num/functions.hpp"
#include "quadrel/scene/shapes.hpp"

namespace quadrel {
namespace {

using Quadrics = std::vector<std::array<glm::vec2, 3>>;
using Fit = std::function<Quadrics(const Mesh&)>;

/// Expected (a, b) at a corner, where the surface has them.
using Expected = std::function<glm::dvec2(const glm::dvec3& P, const glm::dvec3& N)>;

testing::AssertionResult has_curvatures(const Mesh& mesh, const Fit& fit, const Expected& expected,
                                        double tolerance) {
    const Quadrics all = fit(mesh);
    int seen = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const auto i = mesh.triangles[t][c];
            const glm::dvec2 found(all[t][c]);
            const glm::dvec2 off =
                found - expected(glm::dvec3(mesh.positions[i]), glm::dvec3(mesh.normals[i]));
            if (std::abs(off.x) + std::abs(off.y) > tolerance)
                return testing::AssertionFailure()
                       << "triangle " << t << ", corner " << c << ": " << found.x << " " << found.y;
            ++seen;
        }
    return seen > 0 ? testing::AssertionSuccess() : testing::AssertionFailure() << "no corners";
}

glm::dvec2 of_sphere(const glm::dvec3&, const glm::dvec3&) { return {0.25, 0.25}; }

/// u runs round the axis, v round the tube.
glm::dvec2 of_torus(const glm::dvec3& P, const glm::dvec3& N) {
    const double from_axis = std::sqrt(P.x * P.x + P.y * P.y);
    const double outwards = (N.x * P.x + N.y * P.y) / from_axis;
    return {0.5 * outwards / from_axis, 0.5 / 0.5};
}

Quadrics axes_swapped(const Mesh& mesh) {
    Quadrics all = fitted_quadrics(mesh);
    for (auto& corners : all)
        for (glm::vec2& q : corners) std::swap(q.x, q.y);
    return all;
}
Quadrics inside_out(const Mesh& mesh) {
    Quadrics all = fitted_quadrics(mesh);
    for (auto& corners : all)
        for (glm::vec2& q : corners) q = -q;
    return all;
}

TEST(Quadrics, HaveTheCurvaturesOfTheSurface) {
    const Mesh sphere = make_sphere(2, 48, 48), torus = make_torus(0.5, 2, 64, 128);
    EXPECT_TRUE(has_curvatures(sphere, fitted_quadrics, of_sphere, 0.01));
    EXPECT_TRUE(has_curvatures(torus, fitted_quadrics, of_torus, 0.05));
    EXPECT_FALSE(has_curvatures(sphere, inside_out, of_sphere, 0.01));
    EXPECT_FALSE(has_curvatures(torus, axes_swapped, of_torus, 0.05));
    EXPECT_FALSE(has_curvatures(make_sphere(1, 48, 48), fitted_quadrics, of_sphere, 0.01));
}

TEST(Quadrics, OfFlatFacesAreNone) {
    const auto none = [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec2(0); };
    EXPECT_TRUE(has_curvatures(make_cube(2), fitted_quadrics, none, 0));
    EXPECT_TRUE(has_curvatures(make_quad(2, 3, 4), fitted_quadrics, none, 0));
    EXPECT_FALSE(has_curvatures(make_sphere(2, 16, 16), fitted_quadrics, none, 0.01));
}

/// Triangles backwards, their corners turned, vertices in another order.
Mesh in_other_order(Mesh mesh) {
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    std::reverse(mesh.positions.begin(), mesh.positions.end());
    std::reverse(mesh.normals.begin(), mesh.normals.end());
    std::reverse(mesh.uvs.begin(), mesh.uvs.end());
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    for (auto& triangle : mesh.triangles) {
        for (std::uint32_t& index : triangle) index = last - index;
        std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
    }
    return mesh;
}

testing::AssertionResult ignores_the_order(const Fit& fit, const Mesh& mesh) {
    const Quadrics expected = fitted_quadrics(mesh);
    const Quadrics found = fit(in_other_order(mesh));
    for (std::size_t t = 0; t < expected.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c)
            if (found[expected.size() - 1 - t][(c + 2) % 3] != expected[t][c])
                return testing::AssertionFailure() << t << " " << c;
    return testing::AssertionSuccess();
}

TEST(Quadrics, DoNotDependOnTheOrderOfTriangles) {
    const Mesh mesh = make_torus(0.5, 1.2, 9, 14);
    EXPECT_TRUE(ignores_the_order(fitted_quadrics, mesh));
    EXPECT_FALSE(ignores_the_order(axes_swapped, mesh));
}

TEST(Quadrics, NeedNormalsAndCoordinates) {
    Mesh mesh = make_sphere(2, 12, 12);
    const auto all_null = [](const Mesh& of) {
        for (const auto& corners : fitted_quadrics(of))
            for (const glm::vec2& q : corners)
                if (q != glm::vec2(0)) return false;
        return true;
    };
    EXPECT_FALSE(all_null(mesh));
    Mesh flat = mesh, plain = mesh;
    flat.normals.clear();
    plain.uvs.clear();
    EXPECT_TRUE(all_null(flat));
    EXPECT_TRUE(all_null(plain));
}

}  // namespace
}  // namespace quadrel
