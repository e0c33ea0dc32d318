// Defects that this room's tests must catch.
#pragma once

namespace quadrel::planted {

/// Each is made on purpose in a copy of a mesh or matrix, or in place of a function.
enum class Defect {
    none,
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
    // Tangents, made by sums in float over the vertices' indices.
    summed_as_numbered,      ///< nothing else
    unweighted_tangents,     ///< triangles count alike, whatever their angle
    tangents_off_the_plane,  ///< not projected into the plane of the normal
    orientations_mixed,      ///< mirrored triangles in the same sums
    // Refinement.
    edges_of_each_side,  ///< new vertices from the triangle's own normals: shared edges tear
    flat_midpoints,      ///< new vertices not displaced
};

/// Each displaces a mesh wrongly in one thing.
enum class DisplaceDefect {
    none,
    other_diagonal,       ///< cells cut along the other one
    seat_ignored,         ///< always inset
    mirrored_inside_out,  ///< facets the other way round
    half_a_texel_off,     ///< corners of texels taken for their centres
    seams_open,           ///< a wall is missing
    each_triangle_alone,  ///< edges cut by each of their triangles for itself
};

/// Each is a reader of OBJ files that is wrong in one thing.
enum class ObjDefect {
    comments_continue,  ///< a backslash continues a comment, too
    mark_is_a_word,     ///< a byte-order mark belongs to the first word
    cr_is_a_blank,      ///< only LF ends a line
};

/// Each is a reader of glTF files that is wrong in one thing.
enum class GltfDefect {
    weights_ignored,             ///< morph targets are never applied
    mesh_weights_win,            ///< over those of the node
    normals_not_morphed,         ///< positions alone
    skin_ignored,                ///< the node's transform instead
    node_of_skin_applied,        ///< it, too
    inverse_bind_ignored,        ///< joints' transforms alone
    first_joint_alone,           ///< of the four
    normals_of_first_primitive,  ///< for all
    normals_of_all_dropped,      ///< where one primitive lacks them
    tangents_without_normals,    ///< kept
    transform_ignored,           ///< of texture coordinates
    rotation_as_listed,          ///< their rotation the other way
    first_uv_set,                ///< always
    not_normalised,              ///< integers as they are
    hidden_nodes_drawn,
};

/// Each is a reader of .glib files that is wrong in one thing.
enum class GlibDefect {
    least_of_slider,         ///< the range's first number taken
    greatest_of_slider,      ///< the range's last number taken
    comments_drawn,          ///< commented commands obeyed
    z_and_size_swapped,      ///< QuadXY's arguments in the other order
    size_is_the_whole_side,  ///< QuadXY half as wide
    first_row_at_v_0,        ///< textures upside down
    gloss_as_stored,         ///< gloss in the order A R G that 32-bit bitmaps have
    last_texture_for_all,    ///< a unit's last file used for earlier shapes too
    open_end_accepted,       ///< the end of a cut file made up
};

}  // namespace quadrel::planted
