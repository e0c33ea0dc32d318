// A scene's meshes as buffers that a GPU draws.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "export/export.hpp"
#include "export/scene/shells.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// A vertex attribute: floats, one after the other.
struct VertexAttribute {
    std::string name;
    int location, components;
    int offset = 0;  ///< in the buffer that holds it, bytes
    const char* meaning = "";
};

/// As many as any GPU has.
inline constexpr std::size_t most_vertex_attributes = 16;

/// All attributes that programs may read but for what vertex programs make, at their locations.
const std::vector<VertexAttribute>& all_vertex_attributes();

/// One object of the scene.
struct Draw {
    std::size_t object;
    std::uint32_t first_index = 0, index_count = 0;
};

struct VertexBuffers {
    std::vector<VertexAttribute> attributes;  ///< that the vertices have
    std::vector<float> vertices;              ///< interleaved; equal ones of an object are one
    std::vector<std::uint32_t> indices;       ///< three per triangle, in the order of drawing
    std::vector<Draw> draws;

    int floats_a_vertex() const;
};

/// What the vertex programs of an object's material make of its vertices, by attribute without
/// "shaded_".
using VertexProgramRun = std::function<NamedFloats(std::size_t object, const VertexList& vertices)>;

/// Of the visible objects, with these attributes; `shells` are the scene's. Positions, normals and
/// texture coordinates are the meshes' own; what is made of triangles (normals of faces, tangents,
/// gradients of u and v) is in eye space but for unit_tangent and unit_binormal. Triangles without
/// area there are left out. `run` is asked where an attribute is none of all_vertex_attributes;
/// objects whose material does not make it have 0.
VertexBuffers vertex_buffers(const Scene& scene, const SceneShells& shells,
                             const std::vector<VertexAttribute>& attributes,
                             const VertexProgramRun& run);

}  // namespace quadrel
