// A fragment among those of its quad. Quads begin at even window coordinates; of what its
// neighbours have a shader sees the differences, which whole numbers can be made of again.
#pragma once

#include <algorithm>
#include <cmath>

#include "quadrel/num/shader/named.hpp"

namespace quadrel {

namespace recorded {

/// Column (axis 0) or row of a fragment in its quad, 0 or 1; rows are counted as dFdy counts them.
inline ShaderInt place_in_quad(int axis) {
    Node* const window = Recorder::current().input(Type::vec2, "frag_coord");
    const ShaderInt pixel(call(Type::integer, "int", {component(window, axis)}));
    return named(axis == 0 ? "column" : "row", pixel & ShaderInt(1));
}

/// The difference over two fragments of the same row (axis 0) or column, and no others'.
inline Shader own_difference(const Shader& x, int axis) {
    return real(axis == 0 ? "dFdxFine" : "dFdyFine", {x.node()});
}

/// Whether it is a whole number for certain.
inline bool is_whole(const Node& node) {
    if (node.kind == Node::Kind::literal) return node.value == std::floor(node.value);
    if (node.kind != Node::Kind::binary && node.kind != Node::Kind::call) return false;
    if (node.text == "float" || node.text == "floor") return true;
    for (const char* of : {"+", "-", "*", "min", "max"})
        if (node.text == of)
            return std::all_of(node.arguments.begin(), node.arguments.end(),
                               [](const Node* argument) { return is_whole(*argument); });
    return false;
}

}  // namespace recorded

template <>
inline ShaderMask lane_is_right<Shader>() {
    return recorded::place_in_quad(0) == ShaderInt(1);
}
template <>
inline ShaderMask lane_is_below<Shader>() {
    return recorded::place_in_quad(1) == ShaderInt(1);
}

/// Of whole numbers below 2^23: differences of others are rounded.
template <int lane>
Shader broadcast_lane(const Shader& x) {
    using namespace recorded;
    if (!is_whole(*x.node())) throw RecordingError("reads another fragment's value");
    const auto in = [](int axis, int place, const Shader& value) {
        const Shader steps =
            Shader(static_cast<float>(place)) - PacketOps<Shader>::from_int(place_in_quad(axis));
        return value + steps * own_difference(value, axis);
    };
    const Shader in_column = named("in_column", in(0, lane % 2, x));
    return in(1, lane / 2, in_column);
}

}  // namespace quadrel
