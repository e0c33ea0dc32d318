#include "render/draw/primitive_vertices.hpp"

#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "quadrel/num/functions.hpp"
#include "quadrel/scene/tangents.hpp"

namespace quadrel {
namespace {

void copy3(float (&to)[3], const glm::vec3& from) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

/// The first three rows.
void copy_rows(float (&to)[12], const glm::mat4& from) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) to[4 * row + column] = from[column][row];
}

}  // namespace

VertexRows::VertexRows(const Mesh& mesh, const glm::mat4& model_view,
                       const std::vector<glm::vec2>& uv)
    : mesh_(mesh), uv_(uv), to_eye_(model_view), to_object_(glm::inverse(glm::dmat4(model_view))) {
    const bool remapped = !mesh.uvs.empty() && uv != mesh.uvs;
    if (!mesh.tangents.empty() && !remapped) {
        take_own_axes();
    } else {
        make_axes();
    }
}

// glTF's bitangents point up the picture, against v; here they point along it.
void VertexRows::take_own_axes() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        std::array<Axes, 3>& corners = axes_.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::vec4 own = mesh_.tangents[mesh_.triangles[t][c]];
            const glm::dvec3 tangent(unit_or_null(glm::vec3(own)));
            const glm::dvec3 normal(unit_or_null(normal_of_corner(mesh_, t, c)));
            corners[c] = {glm::vec3(tangent),
                          unit_or_null(glm::vec3(cross(normal, tangent) * double(-own.w)))};
        }
    }
}

void VertexRows::make_axes() {
    Mesh mapped = mesh_;
    mapped.uvs = uv_;
    for (const auto& tangents : uv_tangents(mapped)) {
        std::array<Axes, 3>& corners = axes_.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            corners[c] = {unit_or_null(tangents[c].dPdu), unit_or_null(tangents[c].dPdv)};
    }
}

PrimitiveVertices VertexRows::of(const AssembledTriangle& piece, const DrawnCorners& drawn) const {
    PrimitiveVertices row{};
    for (std::size_t v = 0; v < 3; ++v) {
        const std::size_t corner = drawn.corner[v];
        const std::uint32_t index = mesh_.triangles[drawn.triangle][corner];
        copy3(row.position[v], mesh_.positions[index]);
        copy3(row.normal[v], normal_of_corner(mesh_, drawn.triangle, corner));
        copy3(row.tangent[v], axes_[drawn.triangle][corner].tangent);
        copy3(row.binormal[v], axes_[drawn.triangle][corner].binormal);
        for (int i = 0; i < 2; ++i) row.uv[v][i] = uv_[index][i];
        for (std::size_t i = 0; i < 3; ++i)
            row.weights[v][i] = static_cast<float>(piece.weights[v].perspective[i]);
    }
    copy_rows(row.to_eye, to_eye_);
    copy_rows(row.to_object, to_object_);
    return row;
}

}  // namespace quadrel
