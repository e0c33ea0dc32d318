// What an implementation's values are due to: shaders that say the same in other words, and what a
// shader has that is undefined.
#pragma once

#include "gl/scene/manifest.hpp"

namespace quadrel::conformance {

/// The scene with fragment shaders whose min, max and clamp are comparisons: "min returns y if
/// y < x, otherwise x" (GLSL 4.60, 8.3). What the functions themselves make of NaN, and of zeros of
/// two signs, is left open (4.7.1); comparisons of these are not.
gl::ExportedScene with_comparisons(gl::ExportedScene scene);

/// The scene with fragment shaders whose mix is x (1 - a) + y a (GLSL 4.60, 8.3), which is y where
/// a is 1. x + a (y - x) may be off that by a rounding, and so may what a search discards by it.
gl::ExportedScene with_blends(gl::ExportedScene scene);
/// Whether a fragment shader has any.
bool has_mixes(const gl::ExportedScene& scene);

/// The scene with fragment shaders that make the sizes of levels of level 0's: "textureSize returns
/// the dimensions of level lod" (GLSL 4.60, 8.9.1), also where fragments of a quad ask for
/// different ones.
gl::ExportedScene with_sizes_of_level_0(gl::ExportedScene scene);

/// The scene with samplers that choose the nearest level where they choose the nearest texel: what
/// textureLod with a whole level gives, since of two levels the other one has weight 0 (OpenGL 4.6,
/// 8.14.3, and 2.3.4.1 about the error of that: 1 part in 10^5).
gl::ExportedScene with_whole_levels(gl::ExportedScene scene);

/// Whether a fragment shader looks textures up in a loop by implicit derivatives, which are
/// undefined once fragments of a quad leave it at different steps (GLSL 4.60, 8.9).
bool has_implicit_look_ups_in_loops(const gl::ExportedScene& scene);

}  // namespace quadrel::conformance
