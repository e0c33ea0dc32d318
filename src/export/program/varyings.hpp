// What the rasterizer gives a program's fragments, and the vertex shader makes of attributes.
#pragma once

#include <string>
#include <vector>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// A value that is interpolated, or the same over a triangle.
struct Varying {
    std::string name;  ///< of the value, as shaders have it
    Type type;
    bool is_flat;           ///< the same over a triangle
    std::string attribute;  ///< of a vertex, that it is made of; empty: a function makes it
    std::string shaded;     ///< the attribute that already has its value
};

/// Null where the rasterizer gives no value of that name.
const Varying* find_varying(const std::string& name);

/// What a vertex program hands on under that name.
Varying varying_of_program(const Named& of);

/// An attribute of vertices, and its location in a program.
struct Attribute {
    std::string name;
    Type type;
    int location;
};

/// All attributes but those that hold what vertex programs give, each at its location.
const std::vector<Named>& vertex_attributes();

/// The attribute that a vertex program reads under that name, or whose value it is.
std::string attribute_of_program(const std::string& input);

}  // namespace quadrel::recorded
