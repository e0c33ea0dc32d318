// Materials that mesh files bring with them.
#pragma once

#include <string>
#include <vector>

#include "io/document/json.hpp"

namespace quadrel {

/// Adds to the document's materials what the glTF files of their objects' meshes say and they do
/// not, unless the mesh forbids it; of several files of one material the first. Returns a line for
/// each file: what was taken, and what was left. What is wrong with the document is left for others
/// to say. Throws InputError for a glTF file that cannot be read.
std::vector<std::string> take_file_materials(SceneDocument& document);

}  // namespace quadrel
