// Shader: a number type that does not compute but writes down what a text does, for src/export to
// print as a shader. All four lanes of a quad are one invocation of it.
#pragma once

#include <concepts>
#include <limits>

#include "quadrel/num/packet.hpp"
#include "quadrel/num/shader/recorder.hpp"

#ifndef GLM_FORCE_XYZW_ONLY
#error "Shader is no member of GLM's unions of components: define GLM_FORCE_XYZW_ONLY"
#endif

namespace quadrel {

namespace recorded {

inline Node* make(Node::Kind kind, Type type, const char* text, std::vector<Node*> arguments) {
    Node node;
    node.kind = kind;
    node.type = type;
    node.text = text;
    node.arguments = std::move(arguments);
    return Recorder::current().add(std::move(node));
}
inline Node* literal(Type type, double value) {
    Node node;
    node.type = type;
    node.value = value;
    return Recorder::current().add(std::move(node));
}
inline Node* unary(Type type, const char* text, Node* a) {
    return make(Node::Kind::unary, type, text, {a});
}
inline Node* binary(Type type, const char* text, Node* a, Node* b) {
    return make(Node::Kind::binary, type, text, {a, b});
}
inline Node* call(Type type, const char* function, std::vector<Node*> arguments) {
    return make(Node::Kind::call, type, function, std::move(arguments));
}
inline Node* choose(Node* condition, Node* a, Node* b) {
    if (a == nullptr) throw RecordingError("a value is used before it has one");
    return make(Node::Kind::select, a->type, "", {condition, a, b});
}
inline Node* component(Node* vector, int index) {
    Node* const node = make(Node::Kind::component, Type::real, "", {vector});
    node->index = index;
    return node;
}

}  // namespace recorded

// What stands for a node is made by a template, for which no literal 0 is a pointer.

class ShaderMask : public recorded::Handle {
  public:
    ShaderMask() : Handle(nullptr) {}
    explicit ShaderMask(bool all)
        : Handle(recorded::literal(recorded::Type::boolean, all ? 1 : 0)) {}
    template <std::same_as<recorded::Node> N>
    explicit ShaderMask(N* node) : Handle(node) {}

    friend ShaderMask operator&(const ShaderMask& a, const ShaderMask& b) {
        return ShaderMask(recorded::binary(recorded::Type::boolean, "&&", a.node(), b.node()));
    }
    friend ShaderMask operator|(const ShaderMask& a, const ShaderMask& b) {
        return ShaderMask(recorded::binary(recorded::Type::boolean, "||", a.node(), b.node()));
    }
    friend ShaderMask operator!(const ShaderMask& a) {
        return ShaderMask(recorded::unary(recorded::Type::boolean, "!", a.node()));
    }
};

/// What words behind texts ask. Unknown while a text is recorded: neither none of the lanes nor all
/// of them.
inline bool any(const ShaderMask&) { return true; }
inline bool all(const ShaderMask&) { return false; }

class ShaderInt : public recorded::Handle {
    using Type = recorded::Type;

  public:
    ShaderInt() : Handle(nullptr) {}
    explicit ShaderInt(std::int32_t all) : Handle(recorded::literal(Type::integer, all)) {}
    template <std::same_as<recorded::Node> N>
    explicit ShaderInt(N* node) : Handle(node) {}

    friend ShaderInt operator+(const ShaderInt& a, const ShaderInt& b) { return of("+", a, b); }
    friend ShaderInt operator-(const ShaderInt& a, const ShaderInt& b) { return of("-", a, b); }
    friend ShaderInt operator*(const ShaderInt& a, const ShaderInt& b) { return of("*", a, b); }
    friend ShaderInt operator&(const ShaderInt& a, const ShaderInt& b) { return of("&", a, b); }
    friend ShaderInt operator|(const ShaderInt& a, const ShaderInt& b) { return of("|", a, b); }
    friend ShaderInt operator^(const ShaderInt& a, const ShaderInt& b) { return of("^", a, b); }
    friend ShaderInt operator-(const ShaderInt& a) {
        return ShaderInt(recorded::unary(Type::integer, "-", a.node()));
    }
    ShaderInt& operator+=(const ShaderInt& b) { return *this = *this + b; }
    ShaderInt& operator-=(const ShaderInt& b) { return *this = *this - b; }

    template <int bits>
    friend ShaderInt shift_left(const ShaderInt& a) {
        return of("<<", a, ShaderInt(bits));
    }
    template <int bits>
    friend ShaderInt shift_right(const ShaderInt& a) {
        return of(">>", a, ShaderInt(bits));
    }
    friend ShaderInt shift_left(const ShaderInt& a, const ShaderInt& bits) {
        return of("<<", a, bits);
    }
    friend ShaderInt shift_right(const ShaderInt& a, const ShaderInt& bits) {
        return of(">>", a, bits);
    }

    friend ShaderMask operator==(const ShaderInt& a, const ShaderInt& b) { return is("==", a, b); }
    friend ShaderMask operator!=(const ShaderInt& a, const ShaderInt& b) { return is("!=", a, b); }
    friend ShaderMask operator<(const ShaderInt& a, const ShaderInt& b) { return is("<", a, b); }
    friend ShaderMask operator>(const ShaderInt& a, const ShaderInt& b) { return is(">", a, b); }
    friend ShaderMask operator<=(const ShaderInt& a, const ShaderInt& b) { return is("<=", a, b); }
    friend ShaderMask operator>=(const ShaderInt& a, const ShaderInt& b) { return is(">=", a, b); }

  private:
    static ShaderInt of(const char* text, const ShaderInt& a, const ShaderInt& b) {
        return ShaderInt(recorded::binary(Type::integer, text, a.node(), b.node()));
    }
    static ShaderMask is(const char* text, const ShaderInt& a, const ShaderInt& b) {
        return ShaderMask(recorded::binary(Type::boolean, text, a.node(), b.node()));
    }
};

class Shader : public recorded::Handle {
    using Type = recorded::Type;

  public:
    Shader() : Handle(nullptr) {}
    Shader(float all) : Handle(recorded::literal(Type::real, all)) {}
    template <std::same_as<recorded::Node> N>
    explicit Shader(N* node) : Handle(node) {}

    friend Shader operator+(const Shader& a, const Shader& b) { return of("+", a, b); }
    friend Shader operator-(const Shader& a, const Shader& b) { return of("-", a, b); }
    friend Shader operator*(const Shader& a, const Shader& b) { return of("*", a, b); }
    friend Shader operator/(const Shader& a, const Shader& b) { return of("/", a, b); }
    friend Shader operator-(const Shader& a) {
        return Shader(recorded::unary(Type::real, "-", a.node()));
    }
    friend Shader operator+(const Shader& a) { return a; }
    Shader& operator+=(const Shader& b) { return *this = *this + b; }
    Shader& operator-=(const Shader& b) { return *this = *this - b; }
    Shader& operator*=(const Shader& b) { return *this = *this * b; }
    Shader& operator/=(const Shader& b) { return *this = *this / b; }

    friend ShaderMask operator==(const Shader& a, const Shader& b) { return is("==", a, b); }
    friend ShaderMask operator!=(const Shader& a, const Shader& b) { return is("!=", a, b); }
    friend ShaderMask operator<(const Shader& a, const Shader& b) { return is("<", a, b); }
    friend ShaderMask operator>(const Shader& a, const Shader& b) { return is(">", a, b); }
    friend ShaderMask operator<=(const Shader& a, const Shader& b) { return is("<=", a, b); }
    friend ShaderMask operator>=(const Shader& a, const Shader& b) { return is(">=", a, b); }

  private:
    static Shader of(const char* text, const Shader& a, const Shader& b) {
        return Shader(recorded::binary(Type::real, text, a.node(), b.node()));
    }
    static ShaderMask is(const char* text, const Shader& a, const Shader& b) {
        return ShaderMask(recorded::binary(Type::boolean, text, a.node(), b.node()));
    }
};

/// Scalar is float: texts compute their constants with it.
template <>
struct NumberTraits<Shader> {
    using Scalar = float;
    using Int = ShaderInt;
    using Mask = ShaderMask;
    static constexpr int lanes = 4;
};

template <>
struct PacketOps<Shader> {
    static Shader from_int(const ShaderInt& a) {
        return Shader(recorded::call(recorded::Type::real, "float", {a.node()}));
    }
    /// A shader sees of its neighbours the differences alone.
    template <int, int, int, int>
    static Shader swizzle(const Shader&) {
        throw recorded::RecordingError("reads another fragment's value");
    }
};

/// No lane has a place in memory.
template <class Element, class Packet>
requires std::derived_from<Packet, recorded::Handle>
void store(Element*, const Packet&) { throw recorded::RecordingError("writes lanes to memory"); }

}  // namespace quadrel

/// GLM refuses types that are not floating-point by this trait.
template <>
struct std::numeric_limits<quadrel::Shader> : std::numeric_limits<float> {};
