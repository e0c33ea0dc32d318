#include "render/draw/shell/shell_cells.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace quadrel {
namespace {

/// A face of a tetrahedron, by vertices of which those in one place are one.
struct CellFace {
    std::array<std::uint32_t, 3> corner;
    std::int32_t cell, opposite;

    bool operator<(const CellFace& other) const {
        return std::tie(corner, cell, opposite) <
               std::tie(other.corner, other.cell, other.opposite);
    }
};

ShellCell cell_of(const Shell& shell, const ShellTetrahedron& tetrahedron,
                  const std::array<glm::dvec3, 4>& gradient) {
    const ShadedVertices& vertices = shell.vertices();
    ShellCell cell{};
    for (int i = 0; i < 3; ++i) cell.origin[i] = vertices.eye[tetrahedron[0]][i];
    for (std::size_t k = 0; k < 4; ++k) {
        for (int i = 0; i < 3; ++i) cell.gradient[k][i] = static_cast<float>(gradient[k][i]);
        for (int i = 0; i < 2; ++i) cell.uv[k][i] = vertices.uv[tetrahedron[k]][i];
        cell.s[k] = shell.is_bottom(tetrahedron[k]) ? 1.0f : 0.0f;
    }
    return cell;
}

}  // namespace

std::vector<ShellCell> shell_cells(const Shell& shell, const Mesh& mesh, std::int32_t first) {
    std::vector<ShellCell> cells;
    std::vector<CellFace> faces;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (const ShellTetrahedron& tetrahedron : shell.tetrahedra(t)) {
            const auto index = static_cast<std::int32_t>(cells.size());
            std::array<glm::dvec3, 4> gradient{};
            const bool has_volume = shell.gradients(tetrahedron, gradient);
            cells.push_back(cell_of(shell, tetrahedron, gradient));
            for (std::size_t k = 0; k < 4; ++k) {
                CellFace face{{}, index, static_cast<std::int32_t>(k)};
                bool bottom = true;
                for (std::size_t i = 0, to = 0; i < 4; ++i) {
                    if (i == k) continue;
                    bottom &= shell.is_bottom(tetrahedron[i]);
                    face.corner[to++] = shell.place_of(tetrahedron[i]);
                }
                ShellCell& cell = cells.back();
                cell.link[k] = bottom ? ShellCell::below : ShellCell::outside;
                std::sort(face.corner.begin(), face.corner.end());
                if (has_volume && !bottom) faces.push_back(face);
            }
        }
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 1; i < faces.size(); ++i) {
        const CellFace &a = faces[i - 1], &b = faces[i];
        if (a.corner != b.corner) continue;
        const auto link = [&](const CellFace& from, const CellFace& to) {
            ShellCell& cell = cells[static_cast<std::size_t>(from.cell)];
            cell.link[from.opposite] = ShellCell::link_to(first + to.cell, to.opposite);
        };
        link(a, b);
        link(b, a);
        ++i;  // of three faces in one place two are neighbours
    }
    return cells;
}

}  // namespace quadrel
