#include <cmath>

#include "quadrel/num/functions.hpp"
#include "quadrel/scene/shapes.hpp"
#include "scene/grid.hpp"

namespace quadrel {

Mesh make_quad(double size, int columns, int rows) {
    Mesh mesh;
    mesh.name = "quad";
    append_grid(mesh, columns, rows, [&](int column, int row) {
        const glm::dvec2 uv(double(column) / columns, double(row) / rows);
        const glm::dvec2 xy = (uv - 0.5) * size;
        return GridVertex{{xy, 0}, {0, 0, 1}, uv};
    });
    return mesh;
}

Mesh make_cube(double size) {
    struct Face {
        glm::dvec3 normal, right;
    };
    static const Face faces[6] = {{{1, 0, 0}, {0, 0, -1}}, {{-1, 0, 0}, {0, 0, 1}},
                                  {{0, 1, 0}, {1, 0, 0}},  {{0, -1, 0}, {1, 0, 0}},
                                  {{0, 0, 1}, {1, 0, 0}},  {{0, 0, -1}, {-1, 0, 0}}};
    Mesh mesh;
    mesh.name = "cube";
    for (const Face& face : faces) {
        const glm::dvec3 up = cross(face.normal, face.right);
        append_grid(mesh, 1, 1, [&](int column, int row) {
            const glm::dvec3 corner =
                face.normal + face.right * (2.0 * column - 1) + up * (2.0 * row - 1);
            return GridVertex{corner * (size / 2), face.normal, {column, row}};
        });
    }
    return mesh;
}

namespace {

// Corners (0, +-1, +-golden ratio) and cyclic permutations; faces clockwise from outside.
constexpr int icosahedron_faces[20][3] = {
    {0, 4, 1}, {0, 9, 4},  {9, 5, 4},  {4, 5, 8},  {4, 8, 1},  {8, 10, 1}, {8, 3, 10},
    {5, 3, 8}, {5, 2, 3},  {2, 7, 3},  {7, 10, 3}, {7, 6, 10}, {7, 11, 6}, {11, 0, 6},
    {0, 1, 6}, {6, 1, 10}, {9, 0, 11}, {9, 11, 2}, {9, 2, 5},  {7, 2, 11}};

glm::dvec3 icosahedron_corner(int index) {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    const double x = 1 / std::sqrt(1 + golden * golden), z = golden * x;
    const glm::dvec3 corners[12] = {{-x, 0, z}, {x, 0, z},  {-x, 0, -z}, {x, 0, -z},
                                    {0, z, x},  {0, z, -x}, {0, -z, x},  {0, -z, -x},
                                    {z, x, 0},  {-z, x, 0}, {z, -x, 0},  {-z, -x, 0}};
    return corners[index];
}

}  // namespace

Mesh make_icosahedron(double radius, bool smooth) {
    static const glm::dvec2 uvs[3] = {{0, 0}, {1, 0}, {0.5, 1}};
    Mesh mesh;
    mesh.name = "icosahedron";
    for (const auto& face : icosahedron_faces) {
        // The table is clockwise from outside; its first two corners change places.
        const glm::dvec3 corners[3] = {icosahedron_corner(face[1]), icosahedron_corner(face[0]),
                                       icosahedron_corner(face[2])};
        const glm::dvec3 flat = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        for (int i = 0; i < 3; ++i)
            add_vertex(mesh, {corners[i] * radius, smooth ? corners[i] : flat, uvs[i]});
        mesh.triangles.push_back({base, base + 1, base + 2});
    }
    return mesh;
}

Mesh flat_shaded(const Mesh& mesh) {
    Mesh flat;
    flat.name = mesh.name;
    for (const auto& triangle : mesh.triangles) {
        glm::dvec3 corners[3];
        for (int i = 0; i < 3; ++i) corners[i] = glm::dvec3(mesh.positions[triangle[i]]);
        const glm::dvec3 area = cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double twice = length(area);
        const glm::dvec3 normal = twice > 0 ? area * (1 / twice) : glm::dvec3(0, 0, 1);
        const auto base = static_cast<std::uint32_t>(flat.positions.size());
        for (std::uint32_t index : triangle) {
            flat.positions.push_back(mesh.positions[index]);
            flat.normals.emplace_back(normal);
            if (!mesh.uvs.empty()) flat.uvs.push_back(mesh.uvs[index]);
            if (!mesh.tangents.empty()) flat.tangents.push_back(mesh.tangents[index]);
        }
        flat.triangles.push_back({base, base + 1, base + 2});
    }
    return flat;
}

}  // namespace quadrel
