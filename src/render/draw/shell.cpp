#include "render/draw/shell.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "render/draw/primitive_frame.hpp"

namespace quadrel {
namespace {

/// -0 is 0, so that equal positions have equal bits.
std::array<std::uint32_t, 3> bits_of(const glm::vec3& v) {
    return {std::bit_cast<std::uint32_t>(v.x + 0.0f), std::bit_cast<std::uint32_t>(v.y + 0.0f),
            std::bit_cast<std::uint32_t>(v.z + 0.0f)};
}

glm::dvec3 cross_of(const glm::dvec3& a, const glm::dvec3& b) { return glm::cross(a, b); }

void copy3(float* to, const glm::dvec3& from) {
    for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

}  // namespace

ShellKind shell_kind(const Material& material) {
    if (material.frame.id == "frame-shell") return ShellKind::tetrahedra;
    if (material.frame.id == "frame-prism") return ShellKind::prisms;
    return material.frame.id == "frame-prism@published" ? ShellKind::strips : ShellKind::none;
}

bool draws_shell(const Material& material) { return shell_kind(material) != ShellKind::none; }

Cull shell_cull(const Material& material) {
    const bool is_closed = shell_kind(material) != ShellKind::strips && material.depth > 0;
    return is_closed ? Cull::back : material.cull;
}

bool walks_shell(const Material& material) {
    return shell_kind(material) == ShellKind::tetrahedra && material.depth > 0 &&
           (material.shadow.id == "shadow-shell" || material.shadow.id == "shadow-shell-march");
}

Shell::Shell(const Mesh& mesh, const ShadedVertices& base, const Material& material,
             const glm::mat4& projection)
    : mesh_(mesh), depth_(material.depth), seat_(material.seat), is_walked_(walks_shell(material)) {
    const std::size_t n = base.eye.size();
    for (const double offset : {-seat_ * depth_, (1 - seat_) * depth_})
        for (std::size_t i = 0; i < n; ++i) {
            const glm::dvec3 moved = glm::dvec3(unit_or_null(base.normal[i])) * offset;
            // A vertex that stays keeps its bits.
            const glm::vec3 eye =
                offset == 0 ? base.eye[i] : glm::vec3(glm::dvec3(base.eye[i]) + moved);
            vertices_.eye.push_back(eye);
            vertices_.clip.push_back(offset == 0 ? base.clip[i]
                                                 : projection * glm::vec4(eye, 1.0f));
            vertices_.normal.push_back(base.normal[i]);
            vertices_.uv.push_back(base.uv[i]);
        }
    std::map<std::pair<std::array<std::uint32_t, 3>, std::array<std::uint32_t, 3>>, std::uint32_t>
        known;
    for (std::uint32_t i = 0; i < n; ++i)
        first_equal_.push_back(
            known.try_emplace({bits_of(vertices_.eye[i]), bits_of(vertices_.eye[n + i])}, i)
                .first->second);
}

std::array<ShellTetrahedron, 3> Shell::tetrahedra(std::uint32_t triangle) const {
    std::array<std::uint32_t, 3> v = mesh_.triangles[triangle];
    std::sort(v.begin(), v.end(),
              [&](std::uint32_t a, std::uint32_t b) { return first_equal_[a] < first_equal_[b]; });
    const std::uint32_t n = count(), a = v[0], b = v[1], c = v[2];
    return {{{a, b, c, n + c}, {a, b, n + b, n + c}, {a, n + a, n + b, n + c}}};
}

bool Shell::gradients(const ShellTetrahedron& tetrahedron,
                      std::array<glm::dvec3, 4>& gradient) const {
    const auto corner = [&](std::size_t k) { return glm::dvec3(vertices_.eye[tetrahedron[k]]); };
    const glm::dvec3 a = corner(1) - corner(0), b = corner(2) - corner(0),
                     c = corner(3) - corner(0);
    const double volume = glm::dot(a, cross_of(b, c));
    if (volume == 0 || !std::isfinite(1 / volume)) return false;
    gradient[1] = cross_of(b, c) / volume;
    gradient[2] = cross_of(c, a) / volume;
    gradient[3] = cross_of(a, b) / volume;
    gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);
    return true;
}

void Shell::append_faces_of(std::uint32_t number, const ShellTetrahedron& tetrahedron,
                            const DrawnCorners& drawn, std::vector<ShellTriangle>& out) const {
    const std::uint32_t n = count();
    std::array<glm::dvec3, 4> place, gradient;
    std::array<std::uint32_t, 4> over{};
    std::array<double, 4> s{};
    int bottoms = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::uint32_t index = tetrahedron[k];
        place[k] = vertices_.eye[index];
        s[k] = index < n ? 1 : 0;
        bottoms += index < n;
        const auto& corners = mesh_.triangles[drawn.triangle];
        while (corners[over[k]] != index % n) ++over[k];
    }
    if (!gradients(tetrahedron, gradient)) return;
    glm::dvec3 J_u(0), J_v(0), s_gradient(0);
    for (std::size_t k = 1; k < 4; ++k) {
        const glm::dvec2 uv =
            glm::dvec2(vertices_.uv[tetrahedron[k]]) - glm::dvec2(vertices_.uv[tetrahedron[0]]);
        J_u += gradient[k] * uv.x;
        J_v += gradient[k] * uv.y;
        s_gradient += gradient[k] * (s[k] - s[0]);
    }
    // Outwards of a tetrahedron whose last corner lies on the counter-clockwise side of the others.
    static constexpr std::array<std::array<std::size_t, 3>, 4> outwards{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    const bool turned =
        glm::dot(place[1] - place[0], cross_of(place[2] - place[0], place[3] - place[0])) < 0;
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
        std::array<std::size_t, 3> corner = outwards[opposite];
        if (turned) std::swap(corner[1], corner[2]);
        ShellTriangle triangle;
        ShellFace& face = triangle.face;
        face.to_floor = -1;
        face.cell = is_walked_ ? static_cast<std::int32_t>(number) : -1;
        for (std::size_t k = 0; k < 3; ++k) {
            triangle.index[k] = tetrahedron[corner[k]];
            triangle.corner[k] = over[corner[k]];
            face.s[k] = static_cast<float>(s[corner[k]]);
            copy3(face.gradient[k], gradient[corner[k]]);
            // With three corners at the bottom, the one at the top is opposite of it.
            if (bottoms == 3 && s[corner[k]] == 0) face.to_floor = static_cast<float>(k);
        }
        copy3(face.J, J_u);
        copy3(face.J + 3, J_v);
        copy3(face.s_gradient, s_gradient);
        out.push_back(triangle);
    }
}

ShellTriangle Shell::flat_triangle(const DrawnCorners& drawn) const {
    ShellTriangle triangle;
    triangle.index = indices_of(mesh_, drawn);
    triangle.corner = drawn.corner;
    triangle.face.to_floor = -1;
    triangle.face.cell = -1;
    std::array<glm::vec3, 3> position;
    std::array<glm::vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
        position[k] = vertices_.eye[triangle.index[k]];
        uv[k] = vertices_.uv[triangle.index[k]];
        triangle.face.s[k] = static_cast<float>(1 - seat_);
    }
    const std::array<float, 6> J = triangle_jacobian(position, uv);
    std::copy(J.begin(), J.end(), triangle.face.J);
    return triangle;
}

void Shell::append_faces(const DrawnCorners& drawn, std::vector<ShellTriangle>& out) const {
    if (depth_ == 0) return out.push_back(flat_triangle(drawn));
    const auto t = static_cast<std::uint32_t>(drawn.triangle);
    std::uint32_t number = 3 * t;
    for (const ShellTetrahedron& tetrahedron : tetrahedra(t))
        append_faces_of(number++, tetrahedron, drawn, out);
}

PrimitiveVertices shell_row(const ShellTriangle& triangle, const AssembledTriangle& piece,
                            int subpixel_bits, std::int32_t first) {
    ShellFace row = triangle.face;
    if (row.cell >= 0) row.cell += first;
    row.snap = static_cast<float>(std::ldexp(1.0, -subpixel_bits));
    for (std::size_t v = 0; v < 3; ++v) {
        const auto& weights = piece.weights[v].perspective;
        row.s[v] = weigh(weights, triangle.face.s[0], triangle.face.s[1], triangle.face.s[2]);
        for (std::size_t k = 0; k < 3; ++k) row.weights[v][k] = static_cast<float>(weights[k]);
    }
    return std::bit_cast<PrimitiveVertices>(row);
}

AssembledTriangle over_mesh(const AssembledTriangle& piece,
                            const std::array<std::uint32_t, 3>& corner, const DrawnCorners& drawn) {
    AssembledTriangle mapped = piece;
    for (std::size_t v = 0; v < 3; ++v) {
        mapped.weights[v] = {};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = std::find(drawn.corner.begin(), drawn.corner.end(), corner[k]);
            const auto place = static_cast<std::size_t>(at - drawn.corner.begin());
            mapped.weights[v].perspective[place] += piece.weights[v].perspective[k];
            mapped.weights[v].window[place] += piece.weights[v].window[k];
        }
    }
    return mapped;
}

}  // namespace quadrel
