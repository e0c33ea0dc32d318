// The shell over an object's mesh (quadrel/relief/shell/shell_face.hpp): its tetrahedra, and the
// faces by which rays enter them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "quadrel/raster/assemble.hpp"
#include "quadrel/relief/shell/shell_face.hpp"
#include "quadrel/scene/scene.hpp"
#include "render/draw/vertex_stage.hpp"

namespace quadrel {

/// What objects of a material are drawn as, by its frame.
enum class ShellKind {
    none,        ///< their triangles
    tetrahedra,  ///< frame-shell
    prisms,      ///< frame-prism
    strips,      ///< frame-prism@published
};
ShellKind shell_kind(const Material& material);

/// Whether objects of the material are drawn as shells, of any kind.
bool draws_shell(const Material& material);

/// Which of its faces are not drawn: where they enclose what is searched, those by which rays
/// leave.
Cull shell_cull(const Material& material);

/// Whether shadows of the material go through the tetrahedra of its shell.
bool walks_shell(const Material& material);

/// The corners of a tetrahedron, as indices into a shell's vertices.
using ShellTetrahedron = std::array<std::uint32_t, 4>;

/// A face of a tetrahedron, counter-clockwise as seen from outside of it.
struct ShellTriangle {
    std::array<std::uint32_t, 3> index{};   ///< of the shell's vertices
    std::array<std::uint32_t, 3> corner{};  ///< of the mesh's triangle that each lies over
    ShellFace face{};                       ///< all but what clipping changes
};

class Shell {
  public:
    /// `base`: the mesh's own vertices. Depth and seat are the material's, in world units.
    Shell(const Mesh& mesh, const ShadedVertices& base, const Material& material,
          const glm::mat4& projection);

    /// First the bottoms of the mesh's vertices, then their tops, with the normals of the mesh.
    const ShadedVertices& vertices() const { return vertices_; }

    /// The three tetrahedra of a triangle. Vertices of the same bits are one, so that triangles
    /// agree on their order across seams of a texture.
    std::array<ShellTetrahedron, 3> tetrahedra(std::uint32_t triangle) const;

    /// Gradients of the barycentric coordinates of a tetrahedron's corners. False where it has no
    /// volume.
    bool gradients(const ShellTetrahedron& tetrahedron, std::array<glm::dvec3, 4>& gradient) const;

    bool is_bottom(std::uint32_t vertex) const { return vertex < count(); }
    /// The first vertex of the shell that is the same as this one.
    std::uint32_t place_of(std::uint32_t vertex) const {
        return is_bottom(vertex) ? first_equal_[vertex] : count() + first_equal_[vertex - count()];
    }

    /// Appends the faces of a triangle's tetrahedra. Without depth: the triangle itself, with its
    /// corners as they are drawn.
    void append_faces(const DrawnCorners& drawn, std::vector<ShellTriangle>& out) const;

  private:
    void append_faces_of(std::uint32_t number, const ShellTetrahedron& tetrahedron,
                         const DrawnCorners& drawn, std::vector<ShellTriangle>& out) const;
    ShellTriangle flat_triangle(const DrawnCorners& drawn) const;
    std::uint32_t count() const { return static_cast<std::uint32_t>(first_equal_.size()); }

    const Mesh& mesh_;
    double depth_, seat_;
    bool is_walked_;
    ShadedVertices vertices_;
    std::vector<std::uint32_t> first_equal_;  ///< of each vertex of the mesh, the first like it
};

/// The row of one piece of a face, in a window with as many bits behind the point. `first`: row of
/// the shell's first tetrahedron, where shadows walk through them.
PrimitiveVertices shell_row(const ShellTriangle& triangle, const AssembledTriangle& piece,
                            int subpixel_bits, std::int32_t first = 0);

/// The piece as one of the mesh's triangle that it lies over: with the weights of that triangle's
/// drawn corners, for what is interpolated over the mesh. `corner`: of the mesh's triangle that
/// each vertex of the whole lies over.
AssembledTriangle over_mesh(const AssembledTriangle& piece,
                            const std::array<std::uint32_t, 3>& corner, const DrawnCorners& drawn);

}  // namespace quadrel
