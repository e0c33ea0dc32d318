// Built-in meshes. All are right-handed, seen from outside counter-clockwise, with unit normals
// that point outwards. Positions come from double arithmetic, rounded once.
#pragma once

#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// A square of side `size` in the plane z = 0 around the origin, normal +z, divided into
/// columns x rows cells of two triangles; uv (0, 0) at (-x, -y), (1, 1) at (+x, +y).
Mesh make_quad(double size = 2, int columns = 1, int rows = 1);

/// An axis-aligned cube of side `size` around the origin. Each face has its own vertices and the
/// whole unit square of uv, u to the right and v upwards as seen from outside with y up (z up on
/// the two y faces: -z on +y, +z on -y).
Mesh make_cube(double size = 2);

/// A regular icosahedron; 20 faces. `smooth`: radial normals at its 12 corners; otherwise one
/// normal a face and 60 vertices. Every face has the same uv triangle (0,0) (1,0) (1/2,1).
Mesh make_icosahedron(double radius = 1, bool smooth = false);

/// A sphere around the z axis, as gluSphere parametrises it: `slices` >= 3 around, `stacks` >= 2
/// from -z to +z; u = 0..1 around from the +y axis, v = 0 at -z, 1 at +z. The seam and the poles
/// have vertices of their own for uv.
Mesh make_sphere(double radius = 1, int slices = 32, int stacks = 32);

/// A torus around the z axis, as glutSolidTorus: tube radius `inner_radius`, distance of the
/// tube's centre `outer_radius`; `sides` around the tube, `rings` around the axis, both >= 3.
/// u = 0..1 around the axis, v = 0..1 around the tube.
Mesh make_torus(double inner_radius = 0.5, double outer_radius = 1, int sides = 24, int rings = 48);

/// The Utah teapot, y up, as glutSolidTeapot places it: 32 bicubic patches, each a grid of
/// tessellation x tessellation cells with uv (0, 0)..(1, 1) of its own. Normals are the patches'
/// exact ones. `size` 1 gives a height of about 1.6. Throws InputError if the control points
/// (data/meshes/teapot.txt) are not found.
Mesh make_teapot(int tessellation = 10, double size = 1);

/// A card that turns to the camera of each render: the square of uv, of side `size`, that covers a
/// sphere of `radius` whatever the view.
Mesh make_billboard(double size, double radius);

/// `mesh` with three vertices of its own for every triangle and the triangles' normals. Triangles
/// without area get the normal (0, 0, 1).
Mesh flat_shaded(const Mesh& mesh);

}  // namespace quadrel
