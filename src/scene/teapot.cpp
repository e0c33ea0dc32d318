// The Utah teapot (Martin Newell, 1975): 32 bicubic Bezier patches on 306 control points, the
// bottom included.
#include <array>
#include <sstream>

#include "file/data_path.hpp"
#include "file/read_file.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/scene/shapes.hpp"
#include "scene/grid.hpp"

namespace quadrel {
namespace {

/// Control points row by row; u runs along a row, v from row to row.
using Patch = std::array<std::array<glm::dvec3, 4>, 4>;

// The numbers of a text whose lines may be comments (#).
std::istringstream without_comments(const std::string& text) {
    std::istringstream lines(text);
    std::string numbers;
    for (std::string line; std::getline(lines, line);)
        if (line.empty() || line[0] != '#') numbers += line + "\n";
    return std::istringstream(numbers);
}

std::vector<Patch> read_patches() {
    const auto file = find_data_file("meshes/teapot.txt");
    std::istringstream in = without_comments(read_whole_file(file));
    const auto require = [&](bool condition) {
        if (!condition)
            throw InputError(file.string(), "", "something else",
                             "a count and as many points, a count and as many patches of 16 "
                             "indices from 1");
    };
    std::size_t count = 0;
    require(bool(in >> count) && count <= 100000);
    std::vector<glm::dvec3> points(count);
    for (glm::dvec3& p : points) require(bool(in >> p.x >> p.y >> p.z));
    require(bool(in >> count) && count <= 100000);
    std::vector<Patch> patches(count);
    for (Patch& patch : patches) {
        for (int i = 0; i < 16; ++i) {
            std::size_t index = 0;
            require(bool(in >> index) && index >= 1 && index <= points.size());
            patch[i / 4][i % 4] = points[index - 1];
        }
    }
    return patches;
}

struct Cubic {
    std::array<double, 4> value, derivative;
};

Cubic bernstein(double t) {
    const double s = 1 - t;
    return {{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
            {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t}};
}

glm::dvec3 blend(const Patch& patch, const std::array<double, 4>& u,
                 const std::array<double, 4>& v) {
    glm::dvec3 sum(0);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) sum += patch[row][column] * (v[row] * u[column]);
    return sum;
}

// Where a row of control points coincides, the derivative along it vanishes; the normal there is
// the limit, in which the mixed derivative takes its place.
glm::dvec3 patch_normal(const Patch& patch, const Cubic& u, const Cubic& v) {
    glm::dvec3 along_u = blend(patch, u.derivative, v.value);
    const glm::dvec3 along_v = blend(patch, u.value, v.derivative);
    if (dot(along_u, along_u) < 1e-20) along_u = blend(patch, u.derivative, v.derivative);
    return normalize(cross(along_u, along_v));
}

// glutSolidTeapot: moved down by 1.5, halved, turned so that y is up.
glm::dvec3 y_up(const glm::dvec3& p) { return {p.x, p.z, -p.y}; }

}  // namespace

Mesh make_teapot(int tessellation, double size) {
    Mesh mesh;
    mesh.name = "teapot";
    for (const Patch& patch : read_patches()) {
        append_grid(mesh, tessellation, tessellation, [&](int column, int row) {
            const glm::dvec2 uv(double(column) / tessellation, double(row) / tessellation);
            const Cubic u = bernstein(uv.x), v = bernstein(uv.y);
            const glm::dvec3 point = blend(patch, u.value, v.value) - glm::dvec3(0, 0, 1.5);
            return GridVertex{y_up(point) * (size / 2), y_up(patch_normal(patch, u, v)), uv};
        });
    }
    return mesh;
}

}  // namespace quadrel
