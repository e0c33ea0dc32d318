// Errors planted into the renderer to show that the checks can fail.
#pragma once

#include "render/films.hpp"

namespace quadrel::render_tests {

enum class Planted {
    none,
    // same bits
    one_bit,           ///< the last bit of one pixel differs
    isa_rounds,        ///< instruction sets differ from plain lanes in the last bit
    tile_seam,         ///< the first column of a tile differs
    window_corner,     ///< a window's first pixel differs
    thread_dependent,  ///< the result depends on the number of threads
    // numbers
    float_as_double,  ///< double is float
    nan_payload,      ///< NaNs keep the payload of an operation
    // multisampling
    one_sample,           ///< a pixel is covered wholly or not at all
    background_left_out,  ///< colour is the mean of the covered samples
    farthest_z,           ///< Z of the farthest sample
    fragment_of_centre,   ///< other channels from the fragment at the pixel's centre
    centre_for_centroid,  ///< always shaded at the centre
    // conventions and background
    picture_upside_down,    ///< window rows written as image rows
    derivatives_of_image,   ///< dFdy along the image's y, whatever the conventions
    uncovered_is_black,     ///< the background's colour is lost
    uncovered_z_zero,       ///< Z of nothing is 0
    uncovered_object_zero,  ///< id.object of nothing is 0
    // discard
    nothing_discarded,       ///< discard_below ignored
    discarded_writes_depth,  ///< a discarded fragment hides what is behind
    discarded_helpers,       ///< quads with a discarded lane have no derivatives
    later_wins_ties,         ///< at equal depth the later object is seen
    // geometry
    nothing_culled,           ///< cull ignored
    mirror_turns_inside_out,  ///< winding not turned round by a mirroring transform
    flat_as_smooth,           ///< meshes without normals get smooth ones
    viewer_at_origin,         ///< parallel view rays start at the origin
    reversed_z_less,          ///< the depth test is not reversed
    far_plane_ignored,        ///< nothing is clipped at the far plane
    neighbour_bleeds,         ///< an object's values depend on others in the frame
    // relief
    depth_zero_moves,  ///< relief of depth 0 moves a little
    // plan
    needs_forgotten,  ///< a channel alone lacks an input
    anything_goes,    ///< bad input is rendered as far as it goes
};

/// render() with the error.
Film render_with(Planted error, Scene scene, RenderOptions options);

/// The same as a Renderer; `none` is render() itself.
inline Renderer with(Planted error) {
    return [error](const Scene& scene, const RenderOptions& options) {
        return render_with(error, scene, options);
    };
}

}  // namespace quadrel::render_tests
