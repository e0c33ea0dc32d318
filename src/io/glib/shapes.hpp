// The shapes of a glman scene file as objects of our own format.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/glib/arguments.hpp"
#include "io/glib/commands.hpp"

namespace quadrel {

/// An object without its material, and where its values stand in the .glib file, by their paths
/// below the object.
struct GlibShape {
    Json object;
    std::vector<std::pair<std::string, TextPosition>> positions;
};

/// Reads what follows QuadXY, Sphere, Torus or Teapot.
GlibShape read_glib_shape(GlibVerb verb, GlibArguments& arguments);

}  // namespace quadrel
