// Random fragments of shells: faces by which rays enter tetrahedra, made as the renderer makes
// them, over triangles in front of an eye at the origin.
#pragma once

#include <glm/geometric.hpp>

#include "relief/exact/exact_search.hpp"
#include "render/draw/shell.hpp"

namespace quadrel::test {

/// What may be wrong with the rows of faces.
enum class PrismFlaw {
    none,
    wrong_split,             ///< the map of another tetrahedron of the prism
    swapped_entry_and_exit,  ///< rays end where the faces behind them lie
    other_surface,           ///< triangles for patches, and the other way round
    floor_forgotten,         ///< nothing says that a face is the shell's bottom
};

inline glm::vec3 glm_of(const dvec3& v) { return {float(v.x), float(v.y), float(v.z)}; }

/// One triangle 1 to 5 in front of the eye, its normals up to some 40 degrees off its own, under a
/// map of a few to a hundred texels.
inline Mesh random_prism_mesh(Random& random) {
    const double z = random.uniform(1, 5), size = random.uniform(0.1, 0.6) * z;
    const dvec3 centre(random.uniform(-0.5, 0.5) * z, random.uniform(-0.5, 0.5) * z, -z);
    const dvec3 normal = random_direction(random);
    const dvec3 along = normalize(cross(normal, random_direction(random)));
    Mesh mesh;
    for (int v = 0; v < 3; ++v) {
        const double angle = 2.0943951 * v + random.uniform(-0.4, 0.4);
        const dvec3 corner = in_plane(normal, along, size * cos(angle), size * sin(angle));
        mesh.positions.push_back(glm_of(centre + corner));
        mesh.normals.push_back(
            glm_of(normalize(normal + random_direction(random) * random.uniform(0, 0.7))));
        mesh.uvs.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1));
    }
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

inline ShadedVertices shaded(const Mesh& mesh) {
    return {mesh.positions, mesh.normals, std::vector<glm::vec4>(mesh.positions.size()), mesh.uvs};
}

inline bool is_entered(const Shell& shell, const ShellTriangle& face) {
    const auto& eye = shell.vertices().eye;
    const glm::dvec3 a = eye[face.index[0]], b = eye[face.index[1]], c = eye[face.index[2]];
    return glm::dot(glm::cross(b - a, c - a), a) < 0;
}

/// The faces of one random prism by which rays from the origin enter.
inline std::vector<ShellTriangle> entered_faces(const Shell& shell) {
    std::vector<ShellTriangle> faces;
    shell.append_faces({}, faces);
    std::erase_if(faces, [&](const ShellTriangle& face) { return !is_entered(shell, face); });
    return faces;
}

inline AssembledTriangle whole_piece() {
    AssembledTriangle piece;
    for (std::size_t v = 0; v < 3; ++v)
        piece.weights[v].perspective[v] = piece.weights[v].window[v] = 1;
    return piece;
}

/// Every quad another face; lanes all over it, some beside it as helper lanes are.
inline void fill_prism_rays(Batch<float>& batch, Random& random) {
    batch.material.depth = static_cast<float>(random.uniform(0.02, 0.6));
    batch.material.seat = static_cast<float>(random.below(3)) / 2;
    Material material;
    material.depth = batch.material.depth;
    material.seat = batch.material.seat;
    batch.primitives.resize(static_cast<std::size_t>(batch.lanes / 4));
    batch.vertices.resize(batch.primitives.size());
    for (int quad = 0; quad < batch.lanes / 4; ++quad) {
        const Mesh mesh = random_prism_mesh(random);
        const Shell shell(mesh, shaded(mesh), material, glm::mat4(1.0f));
        const std::vector<ShellTriangle> faces = entered_faces(shell);
        const ShellTriangle& face =
            faces[static_cast<std::size_t>(random.below(int(faces.size())))];
        const auto q = static_cast<std::size_t>(quad);
        batch.vertices[q] = shell_row(face, whole_piece(), 8);
        batch.primitives[q] = {};
        for (float& w : batch.primitives[q].w) w = 1;
        for (int lane = 4 * quad; lane < 4 * quad + 4; ++lane) {
            const double least = random.chance(0.1) ? -0.3 : 0;
            const double a = random.uniform(least, 1), b = random.uniform(least, 1 - a);
            const double weight[3] = {double(float(a)), double(float(b)),
                                      1 - double(float(a)) - double(float(b))};
            glm::dvec3 P(0);
            glm::dvec2 uv(0);
            for (std::size_t k = 0; k < 3; ++k) {
                batch.edges[k][static_cast<std::size_t>(lane)] = weight[k];
                P += glm::dvec3(shell.vertices().eye[face.index[k]]) * weight[k];
                uv += glm::dvec2(shell.vertices().uv[face.index[k]]) * weight[k];
            }
            batch.primitive[static_cast<std::size_t>(lane)] = quad;
            batch.set(Value::P, lane, dvec3(P.x, P.y, P.z));
            batch.set(Value::uv, lane, dvec2(uv.x, uv.y));
            batch.set(Value::vertex_normal, lane, dvec3(0, 0, 1));
            for (const Value v : {Value::dPdx, Value::dPdy}) batch.set(v, lane, dvec3(0, 0, 0));
        }
    }
}

inline ShellFace face_of(const PrimitiveVertices& row) { return std::bit_cast<ShellFace>(row); }

/// The rows with an error; `other_surface` is none of theirs.
inline void plant(PrismFlaw flaw, std::vector<PrimitiveVertices>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ShellFace face = face_of(rows[i]);
        if (flaw == PrismFlaw::wrong_split) {
            // As of a prism whose top is turned by a corner.
            std::swap(face.s_gradient[0], face.s_gradient[1]);
            std::swap(face.J[0], face.J[1]);
        }
        if (flaw == PrismFlaw::swapped_entry_and_exit)
            for (auto& gradient : face.gradient)
                for (float& x : gradient) x = -x;
        if (flaw == PrismFlaw::floor_forgotten) face.to_floor = -1;
        rows[i] = std::bit_cast<PrimitiveVertices>(face);
    }
}

}  // namespace quadrel::test
