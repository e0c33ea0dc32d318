// An exported scene, drawn by the current context.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gl/context/program.hpp"
#include "gl/scene/manifest.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::gl {

/// Programs by their texts, for scenes that share them: drivers take longer to make one than to
/// draw with it. To be gone before its context is.
class Programs {
  public:
    /// Of that pass. Throws InputError with the compiler's message.
    GLuint of(const ExportedMaterial& material, int pass);

  private:
    std::map<std::string, Program> known_;
};

/// Draws the passes of these numbers, all where there are none, and reads their channels back into
/// a film of the frame: floats, and integers where the manifest says so. Samples of a pixel are
/// resolved as Quadrel does it: means of colour and coverage, the nearest Z, of all else the value
/// at the lowest sample that something covers; where samples lie is the implementation's. Pixels
/// that nothing covers hold what Quadrel's do, where a pass with channel A is drawn. Throws
/// InputError for a shader that does not compile, with the compiler's message, and
/// std::runtime_error for what the context lacks (TooLarge for textures that it does not take).
Film draw_scene(const ExportedScene& scene, const std::vector<int>& passes = {});
Film draw_scene(const ExportedScene& scene, const std::vector<int>& passes, Programs& programs);

/// What the header of its EXR says: the scene, and which implementation has drawn it.
Attributes drawing_attributes(const ExportedScene& scene);

}  // namespace quadrel::gl
