// Objects, and the meshes and materials that they bind.
#pragma once

#include "io/scene/read.hpp"

namespace quadrel {

/// Reads "objects" into `scene`, whose materials are read already; loads each mesh that an object
/// uses once. Throws InputError for a material with textures on a mesh without uvs.
void read_objects(Fields& fields, const TextureTable& textures, Scene& scene);

}  // namespace quadrel
