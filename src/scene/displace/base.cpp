#include "scene/displace/base.hpp"

#include <glm/vec4.hpp>

#include "quadrel/num/functions.hpp"
#include "quadrel/scene/shapes.hpp"

namespace quadrel::displacement {

Mesh with_unit_normals(const Mesh& mesh) {
    Mesh out = mesh.normals.empty() ? flat_shaded(mesh) : mesh;
    out.tangents.clear();
    return out;
}

glm::vec2 mapped_uv(const Displacement& displacement, const glm::vec2& uv) {
    return glm::vec2(displacement.texture_matrix * glm::vec4(uv, 0.0f, 1.0f));
}

Base::Base(const Mesh& given, const Displacement& displacement)
    : mesh(with_unit_normals(given)), depth(displacement.depth), seat(displacement.seat) {
    const Lattice lattice(displacement);
    places.reserve(mesh.uvs.size());
    for (const glm::vec2& uv : mesh.uvs)
        places.push_back(lattice.place(mapped_uv(displacement, uv)));
}

std::vector<Vertex> shared_vertices(const Base& base, const Edges& edges, const Lattice& lattice) {
    const Mesh& mesh = base.mesh;
    std::vector<Vertex> out;
    out.reserve(mesh.positions.size() + edges.cuts().size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec3 n(mesh.normals[v]);
        const double size = length(n);
        out.push_back({glm::dvec3(mesh.positions[v]), size > 0 ? n / size : n,
                       base.offset(lattice.height(base.places[v])), glm::dvec2(mesh.uvs[v])});
    }
    for (const Edge& edge : edges.all()) {
        for (std::uint32_t c = 0; c < edge.cuts; ++c) {
            const Cut& cut = edges.cuts()[edge.first_cut + c];
            const Vertex &a = out[edge.from], &b = out[edge.to];
            const double t = cut.at.value(), s = 1 - t;
            out.push_back({a.point * s + b.point * t, a.normal * s + b.normal * t,
                           base.offset(cut.height), a.uv * s + b.uv * t});
        }
    }
    return out;
}

}  // namespace quadrel::displacement
