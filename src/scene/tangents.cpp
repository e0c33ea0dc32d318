#include "quadrel/scene/tangents.hpp"

#include <cmath>

#include "quadrel/num/inverse_trig.hpp"
#include "scene/corner_groups.hpp"
#include "scene/direction.hpp"

namespace quadrel {
namespace {

glm::dvec3 uv_of(const Mesh& mesh, std::uint32_t index) {
    return mesh.uvs.empty() ? glm::dvec3(0) : glm::dvec3(mesh.uvs[index].x, mesh.uvs[index].y, 0);
}

/// Some unit vector perpendicular to n: the axis that n is farthest from, made so.
glm::dvec3 any_perpendicular(const glm::dvec3& n) {
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    const glm::dvec3 axis = x <= y && x <= z ? glm::dvec3(1, 0, 0)
                            : y <= z         ? glm::dvec3(0, 1, 0)
                                             : glm::dvec3(0, 0, 1);
    return direction(axis - n * dot(n, axis));
}

/// `make(view)` for every corner of the mesh.
template <std::size_t terms, class Make>
std::vector<CornerShare<terms>> corner_shares(const Mesh& mesh, const Make& make) {
    std::vector<CornerShare<terms>> shares;
    shares.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int c = 0; c < 3; ++c) {
            const CornerView view = view_corner(mesh, t, c);
            CornerShare<terms> share;
            share.key = corner_key(mesh, view);
            share.corner = static_cast<std::uint32_t>(3 * t) + static_cast<std::uint32_t>(c);
            const bool regular = view.uv_area != 0 && dot(view.normal, view.normal) > 0;
            share.orientation = regular ? view.orientation() : 0;
            if (regular) share.term = make(view);
            shares.push_back(share);
        }
    }
    return shares;
}

}  // namespace

CornerView view_corner(const Mesh& mesh, std::size_t triangle, int corner) {
    const auto& t = mesh.triangles[triangle];
    CornerView view;
    for (int i = 0; i < 3; ++i)
        view.index[static_cast<std::size_t>(i)] = t[static_cast<std::size_t>((corner + i) % 3)];
    for (std::size_t i = 0; i < 2; ++i) {
        view.edge[i] = glm::dvec3(mesh.positions[view.index[i + 1]]) -
                       glm::dvec3(mesh.positions[view.index[0]]);
        const glm::dvec3 d = uv_of(mesh, view.index[i + 1]) - uv_of(mesh, view.index[0]);
        view.u[i] = d.x;
        view.v[i] = d.y;
    }
    view.uv_area = view.u[0] * view.v[1] - view.u[1] * view.v[0];
    view.normal = cross(view.edge[0], view.edge[1]);
    return view;
}

glm::dvec3 corner_normal(const Mesh& mesh, const CornerView& view) {
    return direction(mesh.normals.empty() ? view.normal : glm::dvec3(mesh.normals[view.index[0]]));
}

CornerKey corner_key(const Mesh& mesh, const CornerView& view) {
    const glm::vec3& p = mesh.positions[view.index[0]];
    const glm::vec3 n(mesh.normals.empty() ? glm::vec3(corner_normal(mesh, view))
                                           : mesh.normals[view.index[0]]);
    const glm::dvec3 uv = uv_of(mesh, view.index[0]);
    // + 0: negative zeros are zeros.
    return {p.x + 0.0f,
            p.y + 0.0f,
            p.z + 0.0f,
            n.x + 0.0f,
            n.y + 0.0f,
            n.z + 0.0f,
            static_cast<float>(uv.x) + 0.0f,
            static_cast<float>(uv.y) + 0.0f};
}

std::vector<std::array<UvTangents, 3>> uv_tangents(const Mesh& mesh) {
    auto shares = corner_shares<9>(mesh, [](const CornerView& view) {
        const double area = length(view.normal);
        const glm::dvec3 u = view.scaled_dPdu() / view.uv_area;
        const glm::dvec3 v = view.scaled_dPdv() / view.uv_area;
        const glm::dvec3 along_u = direction(u) * area, along_v = direction(v) * area;
        return std::array<double, 9>{along_u.x,        along_u.y,        along_u.z,
                                     length(u) * area, along_v.x,        along_v.y,
                                     along_v.z,        length(v) * area, area};
    });
    std::vector<std::array<UvTangents, 3>> out(mesh.triangles.size());
    sum_corner_groups<9>(std::move(shares), [&](std::uint32_t corner, const auto& sum, int sign) {
        if (sign == 0) return;
        UvTangents& t = out[corner / 3][corner % 3];
        t.dPdu = direction(glm::dvec3(sum[0], sum[1], sum[2])) * (sum[3] / sum[8]);
        t.dPdv = direction(glm::dvec3(sum[4], sum[5], sum[6])) * (sum[7] / sum[8]);
    });
    return out;
}

std::vector<std::array<glm::vec4, 3>> mikkt_tangents(const Mesh& mesh) {
    auto shares = corner_shares<3>(mesh, [&](const CornerView& view) {
        const glm::dvec3 n = corner_normal(mesh, view);
        const glm::dvec3 dPdu = direction(view.scaled_dPdu() / view.uv_area);
        const glm::dvec3 projected = direction(dPdu - n * dot(n, dPdu));
        const double angle = atan2(length(view.normal), dot(view.edge[0], view.edge[1]));
        return std::array<double, 3>{projected.x * angle, projected.y * angle, projected.z * angle};
    });
    std::vector<std::array<glm::vec4, 3>> out(mesh.triangles.size());
    sum_corner_groups<3>(std::move(shares), [&](std::uint32_t corner, const auto& sum, int sign) {
        const glm::dvec3 n =
            corner_normal(mesh, view_corner(mesh, corner / 3, static_cast<int>(corner % 3)));
        glm::dvec3 t = direction(glm::dvec3(sum[0], sum[1], sum[2]));
        if (dot(t, t) == 0) t = any_perpendicular(n);
        out[corner / 3][corner % 3] = glm::vec4(glm::vec3(t), sign < 0 ? -1.0f : 1.0f);
    });
    return out;
}

}  // namespace quadrel
