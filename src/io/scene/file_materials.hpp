// Materials that mesh files bring with them.
#pragma once

#include <string>
#include <vector>

#include "io/document/json.hpp"

namespace quadrel {

/// Adds to the document's materials what the glTF files of their objects' meshes say and they do
/// not, unless the mesh forbids it. An object of several of the file's materials becomes several,
/// one per material: the first in its place, the others behind all objects. Where a material of the
/// scene meets more than one of files, each meeting is a material of its own, named "its name: the
/// file's". Returns a line for each file: what was taken, and what was left. What is wrong with the
/// document is left for others to say. Throws InputError for a glTF file that cannot be read.
std::vector<std::string> take_file_materials(SceneDocument& document);

}  // namespace quadrel
