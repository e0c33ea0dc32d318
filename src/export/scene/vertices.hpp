// A scene's meshes as buffers that a GPU draws.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// A vertex attribute: floats, one after the other.
struct VertexAttribute {
    const char* name;
    int location, components;
    int offset = 0;  ///< in the buffer that holds it, bytes
    const char* meaning = "";
};

/// All attributes that programs may read, at their locations.
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

/// Of the visible objects, with the attributes of these names. Positions, normals and texture
/// coordinates are the meshes' own; what is made of triangles (normals of faces, tangents,
/// gradients of u and v) is in eye space. Triangles without area there are left out.
VertexBuffers vertex_buffers(const Scene& scene, const std::vector<std::string>& attributes);

}  // namespace quadrel
