#include "quadrel/scene/shapes.hpp"

#include <set>

#include "io/mesh/mesh_properties.hpp"
#include "quadrel/scene/transform.hpp"
#include "scene/planted.hpp"

namespace quadrel {
namespace {

using planted::Defect;

struct Shape {
    const char* name;
    Mesh mesh;
};

std::vector<Shape> closed_shapes() {
    return {{"cube", make_cube(3)},
            {"flat icosahedron", make_icosahedron(1.5, false)},
            {"smooth icosahedron", make_icosahedron(0.1, true)},
            {"sphere", make_sphere(1, 32, 16)},
            {"odd sphere", make_sphere(1.25, 7, 5)},
            {"least sphere", make_sphere(2, 3, 2)},
            {"torus", make_torus(0.25, 1, 12, 24)},
            {"odd torus", make_torus(0.3, 0.7, 7, 5)}};
}

Mesh with(Defect defect, Mesh mesh) {
    switch (defect) {
        case Defect::reversed_triangle:
            std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
            break;
        case Defect::missing_triangle:
            mesh.triangles.pop_back();
            break;
        case Defect::inward_normals:
            for (auto& n : mesh.normals) n = -n;
            break;
        case Defect::long_normal:
            mesh.normals[5] *= 1.001f;
            break;
        case Defect::moved_vertex:
            mesh.positions[14].x += 0.001f;
            break;
        case Defect::mirrored_uvs:
            for (auto& uv : mesh.uvs) uv.x = -uv.x;
            break;
        default:
            ADD_FAILURE() << "not a defect of meshes";
    }
    return mesh;
}

double off_unit_sphere(const glm::dvec3& p) { return length(p) - 1; }

double off_torus(const glm::dvec3& p) {
    const double across = std::sqrt(p.x * p.x + p.y * p.y) - 1;
    return std::sqrt(across * across + p.z * p.z) - 0.25;
}

TEST(Shapes, ClosedShapesAreClosedConsistentAndFaceOutwards) {
    for (const Shape& shape : closed_shapes()) {
        SCOPED_TRACE(shape.name);
        EXPECT_TRUE(is_consistent(shape.mesh));
        EXPECT_TRUE(is_closed(shape.mesh));
        EXPECT_TRUE(normals_agree(shape.mesh));
        EXPECT_TRUE(uvs_not_mirrored(shape.mesh));
        EXPECT_GT(signed_volume(shape.mesh), 0);
    }
}

TEST(Shapes, PlantedDefectsAreCaught) {
    const Mesh sphere = make_sphere(1, 8, 6);
    EXPECT_FALSE(is_closed(with(Defect::reversed_triangle, sphere)));
    EXPECT_FALSE(is_closed(with(Defect::missing_triangle, sphere)));
    EXPECT_FALSE(is_closed(with(Defect::moved_vertex, make_cube(1))));
    EXPECT_FALSE(normals_agree(with(Defect::inward_normals, sphere)));
    EXPECT_FALSE(normals_agree(with(Defect::long_normal, sphere)));
    EXPECT_FALSE(normals_agree(with(Defect::reversed_triangle, sphere)));
    EXPECT_FALSE(uvs_not_mirrored(with(Defect::mirrored_uvs, sphere)));
    EXPECT_FALSE(lies_on(with(Defect::moved_vertex, sphere), off_unit_sphere, 1e-6));
}

TEST(Shapes, SphereAndTorusLieOnTheirSurfaces) {
    EXPECT_TRUE(lies_on(make_sphere(1, 37, 23), off_unit_sphere, 1e-7));
    EXPECT_TRUE(lies_on(make_torus(0.25, 1, 17, 29), off_torus, 1.5e-7));
    const Mesh sphere = make_sphere(2, 11, 7);
    for (std::size_t i = 0; i < sphere.positions.size(); ++i)
        EXPECT_EQ(sphere.positions[i], sphere.normals[i] * 2.0f);
}

TEST(Shapes, VolumesApproachTheAnalyticOnes) {
    const double pi = 3.14159265358979;
    EXPECT_NEAR(signed_volume(make_cube(2)) / 6, 8, 1e-6);
    EXPECT_NEAR(signed_volume(make_sphere(1, 256, 128)) / 6, 4 * pi / 3, 2e-3);
    EXPECT_NEAR(signed_volume(make_torus(0.25, 1, 128, 256)) / 6, 2 * pi * pi / 16, 2e-3);
}

TEST(Shapes, QuadSpansItsSquareAndUvUnitSquare) {
    const Mesh quad = make_quad(4, 3, 5);
    EXPECT_EQ(quad.triangles.size(), 30u);
    EXPECT_TRUE(normals_agree(quad));
    EXPECT_TRUE(uvs_not_mirrored(quad));
    double area = 0;
    for (const auto& triangle : quad.triangles) {
        const auto [a, b, c] = corners_of(quad, triangle);
        area += cross(b - a, c - a).z / 2;
    }
    EXPECT_NEAR(area, 16, 1e-5);
    for (std::size_t i = 0; i < quad.positions.size(); ++i) {
        EXPECT_EQ(quad.positions[i].z, 0);
        EXPECT_NEAR(quad.positions[i].x, (quad.uvs[i].x - 0.5) * 4, 1e-6);
        EXPECT_NEAR(quad.positions[i].y, (quad.uvs[i].y - 0.5) * 4, 1e-6);
    }
}

TEST(Shapes, SphereSeamAndUvRange) {
    const Mesh sphere = make_sphere(1, 8, 4);
    for (int stack = 0; stack <= 4; ++stack) {
        const std::size_t first = static_cast<std::size_t>(stack) * 9;
        EXPECT_EQ(sphere.positions[first], sphere.positions[first + 8]);
        EXPECT_EQ(sphere.uvs[first].x, 0);
        EXPECT_EQ(sphere.uvs[first + 8].x, 1);
        EXPECT_EQ(sphere.uvs[first].y, float(stack) / 4);
    }
    EXPECT_EQ(sphere.positions.front(), glm::vec3(0, 0, -1));
    EXPECT_EQ(sphere.positions.back(), glm::vec3(0, 0, 1));
}

TEST(Shapes, FlatShadingKeepsTrianglesAndGivesTheirNormals) {
    const Mesh smooth = make_sphere(1, 9, 6), flat = flat_shaded(smooth);
    ASSERT_EQ(flat.triangles.size(), smooth.triangles.size());
    EXPECT_EQ(flat.positions.size(), 3 * flat.triangles.size());
    EXPECT_TRUE(is_closed(flat));
    EXPECT_TRUE(normals_agree(flat));
    for (const auto& [a, b, c] : flat.triangles) {
        EXPECT_EQ(flat.normals[a], flat.normals[b]);
        EXPECT_EQ(flat.normals[b], flat.normals[c]);
    }
}

// ---- The teapot

TEST(Teapot, IsConsistentWithUnitNormals) {
    const Mesh teapot = make_teapot(8, 1);
    EXPECT_TRUE(is_consistent(teapot));
    EXPECT_EQ(teapot.positions.size(), 32u * 9 * 9);
    for (const auto& n : teapot.normals) EXPECT_NEAR(length(glm::dvec3(n)), 1, 1e-6);
    EXPECT_TRUE(uvs_not_mirrored(teapot));
    EXPECT_GT(signed_volume(teapot), 0);
}

// The handle and spout end inside the body: only there may the triangles' orientation be doubtful,
// and nowhere is it. A cell's own triangles bend away from the exact normal at the lid's rim.
TEST(Teapot, NormalsAgreeWithTheTriangles) {
    EXPECT_TRUE(normals_agree(make_teapot(24, 1)));
    EXPECT_FALSE(normals_agree(with(Defect::inward_normals, make_teapot(6, 1))));
}

TEST(Teapot, IsMirrorSymmetricInDepth) {
    const Mesh teapot = make_teapot(4, 2);
    std::set<std::tuple<float, float, float>> points;
    const auto key = [](const glm::vec3& p) {
        const auto grid = [](float x) { return std::round(x * 4096) + 0.0f; };
        return std::tuple(grid(p.x), grid(p.y), grid(p.z));
    };
    for (const auto& p : teapot.positions) points.insert(key(p));
    for (const auto& p : teapot.positions)
        EXPECT_TRUE(points.count(key({p.x, p.y, -p.z}))) << p.x << " " << p.y << " " << p.z;
}

// Each patch's border, in exact bits, is another patch's or one of the 20 free ones: the rim's
// inside, the lid's edge, the ends of handle and spout.
TEST(Teapot, NeighbouringPatchesShareTheirEdges) {
    const Mesh teapot = make_teapot(3, 1);
    using Point = std::tuple<float, float, float>;
    std::map<std::pair<Point, Point>, int> edges;
    const auto point = [&](std::uint32_t i) {
        const glm::vec3 p = teapot.positions[i];
        return Point(p.x, p.y, p.z);
    };
    for (const auto& triangle : teapot.triangles)
        for (int i = 0; i < 3; ++i) ++edges[{point(triangle[i]), point(triangle[(i + 1) % 3])}];
    int open = 0;
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        open += !edges.count({edge.second, edge.first});
    }
    // Inner rim 4, lid's edge 4, handle 2 at each end, spout 2 at each end; the bottom starts where
    // the body ends, shared; three segments a border.
    EXPECT_EQ(open, 16 * 3);
}

TEST(Teapot, StandsAsGlutPlacesIt) {
    const Mesh teapot = make_teapot(10, 1);
    glm::vec3 low(1e9f), high(-1e9f);
    for (const auto& p : teapot.positions) {
        for (int i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], p[i]);
            high[i] = std::max(high[i], p[i]);
        }
    }
    EXPECT_FLOAT_EQ(low.y, -0.75f);   // the bottom, z = 0 in the data
    EXPECT_FLOAT_EQ(high.y, 0.825f);  // the knob, z = 3.15
    EXPECT_LT(low.x, -1.4f);          // the handle
    EXPECT_GT(high.x, 1.7f);          // the spout's tip
    EXPECT_FLOAT_EQ(low.z, -1.0f);
    EXPECT_FLOAT_EQ(high.z, 1.0f);
}

}  // namespace
}  // namespace quadrel
