#include "export/scene/shells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "export/scene/whole_triangle.hpp"
#include "quadrel/error.hpp"
#include "render/draw/geometry.hpp"
#include "render/draw/shell.hpp"
#include "render/draw/shell/near_plane.hpp"
#include "render/draw/shell/prism_faces.hpp"
#include "render/draw/shell/prism_strips.hpp"
#include "render/draw/shell/shell_cells.hpp"
#include "render/draw/vertex_stage.hpp"

namespace quadrel {
namespace {

/// A triangle with all but what its kind of shell has.
template <class Triangle>
ShellDrawTriangle drawn_triangle(const Triangle& triangle, const ShadedVertices& vertices,
                                 const PrimitiveFrames& frames, const DrawnCorners& drawn) {
    const auto [a, b, c] = triangle.index;
    ShellDrawTriangle out{};
    out.face_normal = face_normal(vertices.eye[a], vertices.eye[b], vertices.eye[c]);
    out.frame = frames.of(over_mesh(whole_triangle(), triangle.corner, drawn), drawn);
    for (std::size_t v = 0; v < 3; ++v) {
        const std::uint32_t i = triangle.index[v];
        out.corner[v].eye = vertices.eye[i];
        out.corner[v].normal = vertices.normal[i];
        out.corner[v].clip = vertices.clip[i];
        out.corner[v].uv = vertices.uv[i];
    }
    return out;
}

/// Of PrismFace and ShellFace, which interpolate the same.
template <class Face>
void set_face(const Face& face, float row, ShellDrawTriangle& triangle) {
    for (std::size_t v = 0; v < 3; ++v) {
        ShellCorner& corner = triangle.corner[v];
        std::copy_n(face.weights[v], 3, corner.corner_weights);
        corner.shell_depth = face.s[v];
        corner.shell_row = row;
    }
}

void set_strip(const PrismStrip& strip, ShellDrawTriangle& triangle) {
    for (std::size_t v = 0; v < 3; ++v) {
        ShellCorner& corner = triangle.corner[v];
        std::copy_n(strip.nv[v], 3, corner.strip_nv);
        std::copy_n(strip.tv[v], 3, corner.strip_tv);
        std::copy_n(strip.bv[v], 3, corner.strip_bv);
        corner.strip_height = strip.height[v];
        corner.strip_side = strip.side[v];
    }
}

}  // namespace

SceneShells::SceneShells(const Scene& scene) : objects_(scene.objects.size()) {
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
        if (scene.objects[i].visible && draws_shell(scene.materials[scene.objects[i].material]))
            add(scene, i);
    if (rows_.size() > static_cast<std::size_t>(most_shell_rows))
        throw InputError(scene.file.string(), "objects",
                         fmt::format("shells of {} faces and tetrahedra", rows_.size()),
                         fmt::format("at most {}, which floats can number", most_shell_rows));
}

float SceneShells::add_row(const ShellTexels& row) {
    // All faces of a prism have one.
    if (rows_.empty() || std::memcmp(&rows_.back(), &row, sizeof row) != 0) rows_.push_back(row);
    return static_cast<float>(rows_.size() - 1);
}

void SceneShells::add(const Scene& scene, std::uint32_t object) {
    const Object& of = scene.objects[object];
    const Mesh& mesh = scene.meshes[of.mesh];
    const Material& material = scene.materials[of.material];
    const glm::mat4& projection = scene.camera.projection;
    const glm::mat4 model_view = scene.camera.view * of.transform;
    const ShadedVertices base =
        shade_vertices(mesh, scene.camera, model_view, material.texture_matrix);
    const PrimitiveFrames frames(mesh, model_view, base.eye, base.uv, material.frame.id);
    const bool mirrored = is_mirrored(model_view);
    const AssembledTriangle whole = whole_triangle();
    const int bits = scene_hardware(scene).subpixel_bits;
    // `append(drawn, list)` appends what is drawn over a triangle of the mesh; `finish(triangle,
    // out)` sets what its kind has.
    const auto draw = [&]<class Triangle>(const ShadedVertices& vertices, std::vector<Triangle>,
                                          const auto& append, const auto& finish) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const DrawnCorners drawn = drawn_corners(t, mirrored);
            const auto [a, b, c] = indices_of(mesh, drawn);
            if (is_flat(base.eye[a], base.eye[b], base.eye[c])) continue;
            std::vector<Triangle> all;
            append(drawn, all);
            for (const Triangle& triangle : all) {
                ShellDrawTriangle out = drawn_triangle(triangle, vertices, frames, drawn);
                finish(triangle, out);
                objects_[object].push_back(out);
            }
        }
    };
    if (shell_kind(material) == ShellKind::strips) {
        const PrismStrips strips(mesh, base, material, projection);
        return draw(
            strips.vertices(), std::vector<StripTriangle>(),
            [&](const DrawnCorners& drawn, auto& all) { strips.append(drawn, all); },
            [&](const StripTriangle& triangle, ShellDrawTriangle& out) {
                set_strip(std::bit_cast<PrismStrip>(strip_row(triangle, whole)), out);
            });
    }
    const Shell shell(mesh, base, material, projection);
    if (material.depth > 0) check_near_plane(scene, object, shell, mesh);
    if (shell_kind(material) == ShellKind::prisms)
        return draw(
            shell.vertices(), std::vector<PrismTriangle>(),
            [&](const DrawnCorners& drawn, auto& all) {
                append_prism_faces(shell, mesh, material, drawn, all);
            },
            [&](const PrismTriangle& triangle, ShellDrawTriangle& out) {
                const auto face = std::bit_cast<PrismFace>(prism_row(triangle, whole, bits));
                set_face(face, add_row(texels_of(face)), out);
            });
    const auto first = static_cast<std::int32_t>(rows_.size());
    if (walks_shell(material))
        for (const ShellCell& cell : shell_cells(shell, mesh, first))
            rows_.push_back(texels_of(cell));  // each at the place that links say
    draw(
        shell.vertices(), std::vector<ShellTriangle>(),
        [&](const DrawnCorners& drawn, auto& all) { shell.append_faces(drawn, all); },
        [&](const ShellTriangle& triangle, ShellDrawTriangle& out) {
            const auto face = std::bit_cast<ShellFace>(shell_row(triangle, whole, bits, first));
            set_face(face, add_row(texels_of(face)), out);
        });
}

std::shared_ptr<const Texture> SceneShells::table() const {
    if (rows_.empty()) return nullptr;
    const std::size_t lines =
        (rows_.size() + shell_rows_a_line - 1) / static_cast<std::size_t>(shell_rows_a_line);
    TextureView layout{};
    layout.channels = 4;
    layout.faces = layout.levels = 1;
    layout.width[0] = shell_table_width;
    layout.height[0] = static_cast<std::int32_t>(lines);
    auto table = std::make_shared<Texture>(layout, TexelFormat::float32, "shells");
    std::memcpy(table->level_texels(0, 0), rows_.data(), rows_.size() * sizeof(ShellTexels));
    return table;
}

}  // namespace quadrel
