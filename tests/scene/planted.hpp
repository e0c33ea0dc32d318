// Defects that this room's tests must catch.
#pragma once

namespace quadrel::planted {

/// Each is made on purpose in a copy of a mesh or matrix, or in place of a function.
enum class Defect {
    reversed_triangle,   ///< one triangle's corners in the other order
    missing_triangle,    ///< a hole
    inward_normals,      ///< normals negated
    long_normal,         ///< a normal that is not of unit length
    moved_vertex,        ///< a position off the analytic surface
    mirrored_uvs,        ///< u negated: uv triangles with negative area
    libm_rotation,       ///< sin(90 degrees in radians): not exactly 1, cosine not exactly 0
    swapped_depth_ends,  ///< near and far at each other's end of the depth range
    wrong_depth_range,   ///< GL's depth range where [0, 1] is asked for
    clip_y_up,           ///< Vulkan's clip y not pointing down
    transposed_matrix,   ///< rows read as columns
    clockwise_rotation,  ///< the other sense of rotation
    steps_in_reverse,    ///< a transform's steps applied last first
    fan_of_concave,      ///< a concave polygon cut as if it were convex
};

}  // namespace quadrel::planted
