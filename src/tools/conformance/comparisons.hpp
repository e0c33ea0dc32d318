// min and max as GLSL defines them for ordered numbers, written out.
#pragma once

#include "gl/scene/manifest.hpp"

namespace quadrel::conformance {

/// The scene with fragment shaders whose min, max and clamp are comparisons: "min returns y if
/// y < x, otherwise x" (GLSL 4.60, 8.3). What the functions themselves make of NaN, and of zeros of
/// two signs, is left open (4.7.1); comparisons of these are not.
gl::ExportedScene with_comparisons(gl::ExportedScene scene);

}  // namespace quadrel::conformance
