// An exported scene, drawn by the current context.
#pragma once

#include <string>
#include <vector>

#include "gl/scene/manifest.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::gl {

/// Draws the passes of these numbers, all where there are none, and reads their channels back into
/// a film of the frame: floats, and integers where the manifest says so. Pixels that nothing covers
/// hold what Quadrel's do, where a pass with channel A is drawn. Throws InputError for a shader
/// that does not compile, with the compiler's message, and std::runtime_error for what the context
/// lacks.
Film draw_scene(const ExportedScene& scene, const std::vector<int>& passes = {});

/// What the header of its EXR says: the scene, and which implementation has drawn it.
Attributes drawing_attributes(const ExportedScene& scene);

}  // namespace quadrel::gl
