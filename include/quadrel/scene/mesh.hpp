// A triangle mesh: plain arrays, object space.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

namespace quadrel {

/// A card that turns to the camera, in object space: around the origin, across the line to the eye,
/// its up that of the camera, and so large that it covers a sphere around the origin.
struct Billboard {
    double size = 2;    ///< side of the square that is the unit square of uv, with its middle there
    double radius = 1;  ///< of the sphere
};

/// An indexed triangle mesh. `normals`, `uvs` and `tangents` are empty or as long as `positions`.
/// Counter-clockwise triangles face the viewer (seen in a right-handed space).
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< empty: the mesh shades flat
    std::vector<glm::vec2> uvs;       ///< v grows with the stored texture row
    std::vector<glm::vec4> tangents;  ///< glTF's: xyz and handedness
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// The mesh is this card, and its arrays the card as seen from far away on the z axis.
    std::optional<Billboard> billboard;
};

}  // namespace quadrel
