// What a scene's shells are drawn as (render/draw/shell), and the texture of what their fragments
// read (quadrel/relief/shell/shell_table.hpp).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "quadrel/quad/uniforms.hpp"
#include "quadrel/relief/shell/shell_table.hpp"
#include "quadrel/scene/scene.hpp"
#include "quadrel/texture/texture.hpp"

namespace quadrel {

/// A corner of a triangle, as the vertex stage leaves it, with the attributes of shells. Of a face
/// of tetrahedra and prisms those are the weights of corners, the depth below the top and the row
/// in the table; of a strip those that its geometry shader emits.
struct ShellCorner {
    glm::vec3 eye, normal;
    glm::vec4 clip;
    glm::vec2 uv;
    float corner_weights[3]{}, shell_depth = 0, shell_row = 0;
    float strip_nv[3]{}, strip_tv[3]{}, strip_bv[3]{}, strip_height = 0, strip_side = 0;
};

struct ShellDrawTriangle {
    glm::vec3 face_normal;
    std::array<ShellCorner, 3> corner;
    PrimitiveFrame frame;  ///< of the mesh's triangle that it lies over
};

class SceneShells {
  public:
    /// Of all visible objects. Throws InputError for a view out of a shell and for shells whose
    /// rows have no numbers.
    explicit SceneShells(const Scene& scene);

    /// In the order of drawing; empty where the object is none.
    const std::vector<ShellDrawTriangle>& of(std::size_t object) const { return objects_[object]; }
    /// Null where nothing has a row.
    std::shared_ptr<const Texture> table() const;

  private:
    void add(const Scene& scene, std::uint32_t object);
    float add_row(const ShellTexels& row);

    std::vector<std::vector<ShellDrawTriangle>> objects_;
    std::vector<ShellTexels> rows_;
};

}  // namespace quadrel
