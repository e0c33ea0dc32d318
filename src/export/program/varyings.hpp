// What the rasterizer gives a program's fragments, and the vertex shader makes of attributes.
#pragma once

#include <string>
#include <vector>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// A value that is interpolated, or the same over a triangle.
struct Varying {
    const char* name;  ///< of the value, as shaders have it
    Type type;
    bool is_flat;           ///< the same over a triangle
    const char* attribute;  ///< of a vertex, that it is made of
    const char* shaded;     ///< the attribute that already has its value
};

/// Null where the rasterizer gives no value of that name.
const Varying* find_varying(const std::string& name);

/// The attributes of vertices, each at its location.
const std::vector<Named>& vertex_attributes();

/// Location of an attribute.
int location_of(const std::string& attribute);

}  // namespace quadrel::recorded
