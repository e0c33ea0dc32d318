#include "quadrel/scene/displace.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "quadrel/check.hpp"
#include "scene/displace/chart.hpp"
#include "scene/displace/interior.hpp"
#include "scene/displace/seams.hpp"
#include "scene/displace/triangle_cutter.hpp"

namespace quadrel {
namespace displacement {
namespace {

std::uint64_t cuts_of(const Edges& edges, std::size_t t) {
    std::uint64_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) count += edges.all()[edges.side(t, k).edge].cuts;
    return count;
}

/// Roughly, so that what is hopeless is not counted.
double estimated_triangles(const Mesh& mesh, const std::vector<glm::dvec2>& in_cells) {
    double sum = 0;
    for (const auto& index : mesh.triangles) {
        const glm::dvec2 a = in_cells[index[0]], b = in_cells[index[1]], c = in_cells[index[2]];
        const auto around = [](const glm::dvec2& p, const glm::dvec2& q) {
            return std::fabs(q.x - p.x) + std::fabs(q.y - p.y);
        };
        const glm::dvec2 u = b - a, v = c - a;
        sum += 1 + std::fabs(u.x * v.y - u.y * v.x) + around(a, b) + around(b, c) + around(c, a);
    }
    return sum;
}

std::uint64_t facets_of(const Chart& chart, std::uint64_t cuts) {
    const std::uint64_t inside = chart.degenerate ? 0 : count_interior(chart.place);
    return 2 * inside + 3 + cuts - 2;
}

}  // namespace
}  // namespace displacement

std::uint64_t DisplacedSize::bytes() const {
    // Position, normal and uv; in eye and in clip space as well, when it is drawn.
    constexpr std::uint64_t vertex = 32, shaded = 48, triangle = 12;
    return vertices * (vertex + shaded) + triangles * triangle;
}

DisplacedSize displaced_size(const Mesh& mesh, const Displacement& displacement) {
    using namespace displacement;
    DisplacedSize size;
    const Lattice lattice(displacement);
    std::vector<glm::dvec2> in_cells;
    in_cells.reserve(mesh.uvs.size());
    for (const glm::vec2& uv : mesh.uvs) {
        in_cells.push_back(lattice.in_cells(mapped_uv(displacement, uv)));
        const double reach = std::max(std::fabs(in_cells.back().x), std::fabs(in_cells.back().y));
        // A NaN stays.
        if (!(reach <= size.reach) && !std::isnan(size.reach)) size.reach = reach;
    }
    if (!(size.reach <= max_displacement_reach)) return size;
    const double estimate = estimated_triangles(mesh, in_cells);
    if (estimate > 2 * double(max_displaced_triangles)) {
        size.triangles = static_cast<std::uint64_t>(estimate);
        size.vertices = size.triangles / 2;
        return size;
    }
    const Base base(mesh, displacement);
    const Edges edges(base.mesh, base.places, lattice);
    size.vertices = base.mesh.positions.size() + edges.cuts().size();
    for (std::size_t t = 0; t < base.mesh.triangles.size(); ++t) {
        const Chart chart(base, t);
        const std::uint64_t cuts = cuts_of(edges, t), facets = facets_of(chart, cuts);
        size.triangles += facets;
        size.vertices += (facets + 2 - 3 - cuts) / 2;
    }
    for (const Seam& seam : find_seams(base.mesh, edges)) {
        size.triangles += most_wall_triangles(seam, edges);
        size.vertices += 3 * most_wall_triangles(seam, edges);
    }
    return size;
}

Mesh displaced(const Mesh& mesh, const Displacement& displacement) {
    using namespace displacement;
    if (mesh.uvs.empty())
        throw std::invalid_argument("displaced: a mesh without texture coordinates");
    const DisplacedSize size = displaced_size(mesh, displacement);
    if (!(size.reach <= max_displacement_reach) || size.triangles > max_displaced_triangles)
        throw std::length_error("displaced: beyond what displaced_size may be");
    const Lattice lattice(displacement);
    const Base base(mesh, displacement);
    const Edges edges(base.mesh, base.places, lattice);
    Facets facets(shared_vertices(base, edges, lattice), size.vertices, size.triangles);
    for (std::size_t t = 0; t < base.mesh.triangles.size(); ++t)
        cut_triangle(base, edges, lattice, t, facets);
    for (const auto& wall :
         wall_triangles(find_seams(base.mesh, edges), edges, base.mesh.positions.size()))
        facets.add_wall(wall);
    Mesh out = facets.take();
    out.name = mesh.name;
    QUADREL_CHECK_OP(<=, out.triangles.size(), size.triangles);
    return out;
}

}  // namespace quadrel
