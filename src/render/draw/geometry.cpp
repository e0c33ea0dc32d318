#include "render/draw/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "quadrel/error.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/raster/coverage.hpp"
#include "render/draw/primitive_frame.hpp"
#include "render/draw/primitive_vertices.hpp"
#include "render/draw/shell.hpp"
#include "render/draw/shell/near_plane.hpp"
#include "render/draw/shell/prism_faces.hpp"
#include "render/draw/shell/prism_strips.hpp"
#include "render/draw/shell/shell_cells.hpp"
#include "render/draw/vertex_stage.hpp"
#include "scene/billboard.hpp"
#include "scene/degrees.hpp"

namespace quadrel {
namespace {

/// Attributes of one piece of the triangle of vertices `index`.
PrimitiveData primitive_data(const AssembledTriangle& piece, const ShadedVertices& vertices,
                             const std::array<std::uint32_t, 3>& index, bool flat) {
    PrimitiveData data{};
    const auto [a, b, c] = index;
    const glm::vec3 face = face_normal(vertices.eye[a], vertices.eye[b], vertices.eye[c]);
    for (int v = 0; v < 3; ++v) {
        const auto& weights = piece.weights[v].perspective;
        const auto combined = [&](const auto& list, int component) {
            return weigh(weights, list[a][component], list[b][component], list[c][component]);
        };
        data.w[v] = piece.screen.vertex[v].w;
        for (int i = 0; i < 3; ++i) {
            data.position[v][i] = combined(vertices.eye, i);
            data.normal[v][i] = flat ? face[i] : combined(vertices.normal, i);
        }
        for (int i = 0; i < 2; ++i) data.uv[v][i] = combined(vertices.uv, i);
    }
    for (int i = 0; i < 3; ++i) data.face_normal[i] = face[i];
    return data;
}

/// Whether pieces of a clipped triangle are interpolated from its own vertices, which may lie
/// behind the eye, and not from theirs. SetupRoutine.cpp (generate) reprojects clipped polygons for
/// their edges alone; Mesa's clipper makes vertices, as any of ours. From a vertex at the near
/// plane, where 1/w is largest, planes would be off by many times as much.
constexpr bool has_planes_of_the_whole(Interpolation form) {
    return form == Interpolation::swiftshader;
}

/// The triangle as it was submitted, with nothing but what planes are made of.
ScreenTriangle submitted_triangle(const std::array<glm::vec4, 3>& clip, const RasterState& state) {
    ScreenTriangle triangle;
    for (std::size_t v = 0; v < 3; ++v)
        triangle.vertex[v] = screen_vertex(glm::dvec4(clip[v]), state);
    return triangle;
}

/// Whether the window has a place for each vertex.
bool has_places(const ScreenTriangle& triangle) {
    return std::ranges::all_of(triangle.vertex, [](const ScreenVertex& v) {
        return v.w != 0 && std::abs(v.x) < snapped_limit && std::abs(v.y) < snapped_limit;
    });
}

/// The triangle that a piece has been cut from, on the piece's edges.
AssembledTriangle whole_of(AssembledTriangle piece) {
    for (std::size_t v = 0; v < 3; ++v) {
        piece.weights[v] = {};
        piece.weights[v].perspective[v] = piece.weights[v].window[v] = 1;
    }
    return piece;
}

/// What an object's triangles are drawn with.
struct DrawnObject {
    const Scene& scene;
    std::uint32_t index;
    const Mesh& mesh;
    const ShadedVertices& vertices;
    RasterState state;
    Interpolation form;
    const GeometryParts& parts;
};

/// Draws triangle `primitive` of the mesh, or a part of the shell over it, of vertices `corners`.
/// `add_rows(rows, piece)` appends what stages read of a piece.
template <class AddRows>
void assemble_corners(const DrawnObject& object, std::uint32_t primitive,
                      const std::array<std::uint32_t, 3>& corners, const AddRows& add_rows,
                      std::vector<AssembledTriangle>& pieces, Geometry& geometry) {
    const bool keeps_pieces = has_planes_of_the_whole(object.form);
    const std::vector<glm::vec4>& all = object.vertices.clip;
    pieces.clear();
    const std::array<glm::vec4, 3> clip{all[corners[0]], all[corners[1]], all[corners[2]]};
    assemble_triangle(clip, object.state, pieces, geometry.counts);
    const ScreenTriangle submitted = submitted_triangle(clip, object.state);
    for (const AssembledTriangle& piece : pieces) {
        // Of a fine mesh these are most, and would take most of the memory.
        if (!object.parts.all_triangles && !may_cover(piece.screen, object.scene.samples)) continue;
        const std::size_t material = object.scene.objects[object.index].material;
        geometry.triangles.push_back(
            {piece.screen, object.index, primitive, static_cast<std::uint32_t>(material)});
        const bool whole = keeps_pieces && piece.clipped && has_places(submitted);
        add_rows(geometry, whole ? whole_of(piece) : piece);
        if (keeps_pieces) add_rows(geometry.pieces, piece);
        if (object.form != Interpolation::exact)
            geometry.planes.push_back(
                plane_setup(object.form, whole ? submitted : piece.screen, object.scene.samples));
    }
}

/// Triangles of the shell over one of the mesh's. `row_of(triangle, piece)`: what their frame and
/// search read.
template <class Triangle, class RowOf>
void assemble_shell_triangles(const DrawnObject& object,
                              const std::optional<PrimitiveFrames>& frames,
                              const DrawnCorners& drawn, const std::vector<Triangle>& triangles,
                              const RowOf& row_of, Geometry& geometry) {
    std::vector<AssembledTriangle> pieces;
    for (const Triangle& triangle : triangles) {
        const auto add_rows = [&](PrimitiveRows& to, const AssembledTriangle& piece) {
            to.data.push_back(primitive_data(piece, object.vertices, triangle.index, false));
            if (frames)
                to.frames.push_back(frames->of(over_mesh(piece, triangle.corner, drawn), drawn));
            if (object.parts.vertices) to.vertices.push_back(row_of(triangle, piece));
        };
        assemble_corners(object, static_cast<std::uint32_t>(drawn.triangle), triangle.index,
                         add_rows, pieces, geometry);
    }
}

/// `each(drawn)` for the triangles that have an area in eye space: what rounding makes of others is
/// not drawn, since they have no normal.
template <class Each>
void for_triangles(const Mesh& mesh, const ShadedVertices& vertices, bool mirrored,
                   Geometry& geometry, const Each& each) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const DrawnCorners drawn = drawn_corners(t, mirrored);
        const std::array<std::uint32_t, 3> index = indices_of(mesh, drawn);
        if (is_flat(vertices.eye[index[0]], vertices.eye[index[1]], vertices.eye[index[2]])) {
            ++geometry.counts.submitted;
            ++geometry.counts.zero_area;
            continue;
        }
        each(drawn);
    }
}

/// The triangles of an object's shell in place of its mesh's: where they enclose what is searched,
/// those by which rays enter. Appends the tetrahedra that shadows go through.
void assemble_shell(const DrawnObject& object, const std::optional<PrimitiveFrames>& frames,
                    bool mirrored, Geometry& geometry, std::vector<ShellCell>& cells) {
    const Material& material = object.scene.materials[object.scene.objects[object.index].material];
    const glm::mat4& projection = object.scene.camera.projection;
    const auto draw = [&](const ShadedVertices& vertices, Cull cull, const auto& append,
                          const auto& row_of) {
        DrawnObject drawn_object{object.scene, object.index, object.mesh, vertices,
                                 object.state, object.form,  object.parts};
        drawn_object.state.cull = cull;
        for_triangles(object.mesh, object.vertices, mirrored, geometry,
                      [&](const DrawnCorners& drawn) {
                          assemble_shell_triangles(drawn_object, frames, drawn, append(drawn),
                                                   row_of, geometry);
                      });
    };
    if (shell_kind(material) == ShellKind::strips) {
        const PrismStrips strips(object.mesh, object.vertices, material, projection);
        const auto triangles = [&](const DrawnCorners& drawn) {
            std::vector<StripTriangle> all;
            strips.append(drawn, all);
            return all;
        };
        return draw(strips.vertices(), object.state.cull, triangles, strip_row);
    }
    const Shell shell(object.mesh, object.vertices, material, projection);
    const Cull cull = shell_cull(material);
    if (material.depth > 0) check_near_plane(object.scene, object.index, shell, object.mesh);
    const int bits = object.state.subpixel_bits;
    if (shell_kind(material) == ShellKind::prisms) {
        const auto triangles = [&](const DrawnCorners& drawn) {
            std::vector<PrismTriangle> all;
            append_prism_faces(shell, object.mesh, material, drawn, all);
            return all;
        };
        const auto row = [&](const PrismTriangle& triangle, const AssembledTriangle& piece) {
            return prism_row(triangle, piece, bits);
        };
        return draw(shell.vertices(), cull, triangles, row);
    }
    const auto first = static_cast<std::int32_t>(cells.size());
    const auto triangles = [&](const DrawnCorners& drawn) {
        std::vector<ShellTriangle> all;
        shell.append_faces(drawn, all);
        return all;
    };
    const auto row = [&](const ShellTriangle& triangle, const AssembledTriangle& piece) {
        return shell_row(triangle, piece, bits, first);
    };
    draw(shell.vertices(), cull, triangles, row);
    if (!walks_shell(material)) return;
    const std::vector<ShellCell> own = shell_cells(shell, object.mesh, first);
    cells.insert(cells.end(), own.begin(), own.end());
}

void assemble_object(const Scene& scene, std::uint32_t object_index, const RasterState& state,
                     Interpolation form, const GeometryParts& parts, Geometry& geometry,
                     std::vector<ShellCell>& cells) {
    const Object& object = scene.objects[object_index];
    Mesh card;
    const Mesh& mesh = drawn_mesh(scene, object, card);
    const Material& material = scene.materials[object.material];
    const glm::mat4 model_view = scene.camera.view * object.transform;
    const ShadedVertices vertices =
        shade_vertices(mesh, scene.camera, model_view, material.texture_matrix);
    std::optional<PrimitiveFrames> frames;
    if (parts.frames)
        frames.emplace(mesh, model_view, vertices.eye, vertices.uv, material.frame.id,
                       parts.quadrics);
    const bool mirrored = is_mirrored(model_view);
    const DrawnObject drawn_object{scene, object_index, mesh, vertices, state, form, parts};
    if (draws_shell(material))
        return assemble_shell(drawn_object, frames, mirrored, geometry, cells);
    std::optional<VertexRows> rows;
    if (parts.vertices) rows.emplace(mesh, model_view, vertices.uv);
    std::vector<AssembledTriangle> pieces;
    for_triangles(mesh, vertices, mirrored, geometry, [&](const DrawnCorners& drawn) {
        const std::array<std::uint32_t, 3> index = indices_of(mesh, drawn);
        const auto add_rows = [&](PrimitiveRows& to, const AssembledTriangle& piece) {
            to.data.push_back(primitive_data(piece, vertices, index, mesh.normals.empty()));
            if (frames) to.frames.push_back(frames->of(piece, drawn));
            if (rows) to.vertices.push_back(rows->of(piece, drawn));
        };
        assemble_corners(drawn_object, static_cast<std::uint32_t>(drawn.triangle), index, add_rows,
                         pieces, geometry);
    });
}

/// Appends tetrahedra to the rows of triangles, which until then know them by their places in
/// `cells`.
void append_cells(const Scene& scene, const std::vector<DrawnTriangle>& triangles,
                  const std::vector<ShellCell>& cells, PrimitiveRows& rows) {
    constexpr std::size_t most =
        std::numeric_limits<std::int32_t>::max() / (sizeof(PrimitiveVertices) / sizeof(float));
    const std::size_t first = rows.vertices.size();
    if (first + cells.size() > most)
        throw InputError(scene.file.string(), "objects",
                         fmt::format("shells of {} tetrahedra", cells.size()),
                         fmt::format("at most {} with all faces that are drawn", most));
    const auto moved = static_cast<std::int32_t>(first);
    for (std::size_t i = 0; i < first; ++i) {
        if (!walks_shell(scene.materials[triangles[i].material])) continue;
        auto face = std::bit_cast<ShellFace>(rows.vertices[i]);
        if (face.cell >= 0) face.cell += moved;
        rows.vertices[i] = std::bit_cast<PrimitiveVertices>(face);
    }
    for (ShellCell cell : cells) {
        for (std::int32_t& link : cell.link)
            if (link >= ShellCell::first_link) link += 4 * moved;
        rows.vertices.push_back(std::bit_cast<PrimitiveVertices>(cell));
    }
}

void set_eye(const Scene& scene, FrameUniforms& frame) {
    const glm::dvec4 eye = centre_of_projection(scene.camera.projection);
    frame.orthographic = eye.w == 0;
    glm::dvec3 v(eye);
    if (!frame.orthographic) v = v / eye.w;
    if (frame.orthographic) {
        // Towards the viewer: eye space looks down -z. Of ordinary size, however large the picture:
        // a power of two, which leaves the direction's bits.
        const double size = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
        v *= std::ldexp(v.z < 0 ? -1.0 : 1.0, size > 0 ? -std::ilogb(size) : 0);
    }
    for (int i = 0; i < 3; ++i) frame.eye[i] = static_cast<float>(v[i]) + 0.0f;
}

void copy3(float (&to)[3], const glm::vec4& from) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

LightUniforms light_uniforms(const Light& light, const glm::mat4& view) {
    LightUniforms out{};
    out.directional = light.kind == Light::Kind::directional;
    glm::vec4 position(light.position, out.directional ? 0.0f : 1.0f);
    if (light.space == Light::Space::world) position = view * position;
    copy3(out.position, position);
    copy3(out.ambient, light.ambient);
    copy3(out.diffuse, light.diffuse);
    copy3(out.specular, light.specular);
    out.intensity = light.intensity;
    out.attenuation[0] = light.constant_attenuation;
    out.attenuation[1] = light.linear_attenuation;
    out.attenuation[2] = light.quadratic_attenuation;
    return out;
}

}  // namespace

HardwareModel scene_hardware(const Scene& scene) {
    HardwareModel hardware = hardware_model(scene.hardware);
    if (scene.derivatives) hardware.derivatives = *scene.derivatives;
    return hardware;
}

FrameUniforms frame_uniforms(const Scene& scene, const HardwareModel& hardware) {
    FrameUniforms frame{};
    set_eye(scene, frame);
    // A view matrix is a rotation and a translation, so the transpose turns back.
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            frame.eye_to_world[3 * row + column] = scene.camera.view[row][column];
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            frame.projection[4 * row + column] = scene.camera.projection[column][row];
    const bool symmetric = scene.conventions == Conventions::gl;  // clip z in [-w, w]
    frame.depth_scale = symmetric ? 0.5f : 1.0f;
    frame.depth_offset = symmetric ? 0.5f : 0.0f;
    frame.derivatives = hardware.derivatives;
    frame.interpolation = hardware.interpolation;
    frame.light_count = static_cast<std::int32_t>(scene.lights.size());
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        frame.lights[i] = light_uniforms(scene.lights[i], scene.camera.view);
    return frame;
}

MaterialUniforms material_uniforms(const Material& material) {
    MaterialUniforms out{};
    out.depth = material.depth;
    out.depth_in_tiles = material.depth_in_tiles;
    out.fade_from = static_cast<float>(sin_cos_degrees(material.fade_from).cosine);
    out.fade_to = static_cast<float>(sin_cos_degrees(material.fade_to).cosine);
    if (material.noise) {
        out.noise_octaves = material.noise->octaves;
        out.noise_frequency = material.noise->frequency;
    }
    out.seat = material.seat;
    copy3(out.ambient, material.ambient);
    copy3(out.diffuse, material.diffuse);
    copy3(out.specular, material.specular);
    copy3(out.emission, material.emission);
    out.shininess = material.shininess;
    return out;
}

Geometry assemble_geometry(const Scene& scene, const HardwareModel& hardware,
                           const GeometryParts& parts) {
    Geometry geometry;
    std::vector<ShellCell> cells;
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (!object.visible) continue;
        const Cull cull = scene.materials[object.material].cull;
        assemble_object(scene, i, raster_state(viewport, hardware, cull), hardware.interpolation,
                        parts, geometry, cells);
    }
    if (parts.vertices && !cells.empty()) {
        append_cells(scene, geometry.triangles, cells, geometry);
        if (!geometry.pieces.vertices.empty())
            append_cells(scene, geometry.triangles, cells, geometry.pieces);
    }
    return geometry;
}

}  // namespace quadrel
