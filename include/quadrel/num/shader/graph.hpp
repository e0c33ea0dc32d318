// What a text on the number type Shader (shader.hpp) leaves behind: expressions in
// single-assignment form, and around them the loops and blocks that they stand in.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace quadrel::recorded {

enum class Type : std::int32_t { real, integer, boolean, vec2, vec3, vec4 };

constexpr int components_of(Type type) {
    return type < Type::vec2 ? 1 : static_cast<int>(type) - static_cast<int>(Type::vec2) + 2;
}
constexpr Type vector_of(int components) {
    return components == 1 ? Type::real
                           : static_cast<Type>(static_cast<int>(Type::vec2) + components - 2);
}

struct Variable;
struct Region;
struct Loop;

/// An expression. `text` is its operator, function or symbol, as GLSL has it; `textureLayer` is
/// textureLod of an array, by coordinates, layer and level, `texelLayer` texelFetch of one, by
/// column, row, layer and level.
struct Node {
    enum class Kind : std::int32_t {
        literal,
        symbol,
        unary,
        binary,
        call,
        select,     ///< arguments: condition, then, else
        component,  ///< component `index` of a vector; the first -index where that is negative
        construct,  ///< a vector of its components, or of one for all
        read        ///< version `index` of a variable
    };

    Kind kind = Kind::literal;
    Type type = Type::real;
    std::string text;
    double value = 0;  ///< of a literal
    int index = 0;
    std::vector<Node*> arguments;
    Variable* variable = nullptr;  ///< of a read
    const Loop* loop = nullptr;    ///< whose counter a symbol is

    Region* region = nullptr;  ///< where it was made, and when
    int order = 0;
    bool is_true = false;  ///< read: of a mask that the loop has just asked for

    /// What the text calls it: `name` where it says so itself, `weak_name` where the function that
    /// made it does. And the comments in front of it.
    std::string name, weak_name;
    std::vector<std::string> comments;
};

/// What a loop or a block changes: one object of the text. Version 0 is what it holds at entry.
struct Variable {
    Type type = Type::real;
    Node* initial = nullptr;
    std::vector<int> version_order{0};  ///< when each version begins
    std::vector<std::string> names;     ///< that versions have
    /// A mask that holds in every round: `initial` guards the loop, and in it nothing need ask.
    bool guards = false;
    Node* now = nullptr;  ///< while recording: the newest read
};

struct Assignment {
    Variable* variable;
    Node* value;
    int version;  ///< that begins here
    int order;
};

/// Something that happens in a region, in order.
struct Event {
    enum class Kind : std::int32_t { loop, leave, assign, store };

    Event(Kind of, int when) : kind(of), order(when) {}

    Kind kind;
    int order;
    Loop* loop = nullptr;
    Node* value = nullptr;  ///< stored; or the condition to stay in the loop
    std::string text;       ///< name of the output
    std::vector<Assignment> assignments;
};

struct Region {
    Region* parent = nullptr;
    std::vector<Event> events;
};

/// A loop over steps, or without end, or a block that a condition guards.
struct Loop {
    enum class Kind : std::int32_t { steps, rounds, block };
    Kind kind = Kind::rounds;
    Node* condition = nullptr;  ///< of a block
    std::string index;          ///< of steps: name of the counter
    Node *first = nullptr, *last = nullptr;
    Region body;
    Region* outer = nullptr;
    int order = 0;
    std::vector<std::unique_ptr<Variable>> variables;
};

struct Named {
    std::string name;
    Type type;
};

/// A uniform as it is declared: `type` is a GLSL type, or a sampler.
struct Uniform {
    std::string name, type;
    int count = 0;             ///< of an array; else 0
    std::string comment = {};  ///< what it means
};

/// A parameter of the text that has kept its name.
struct Parameter {
    std::string name;
    Type type;
    double value;
    std::string comment;
};

/// What a text computes at the vertices and reads interpolated: `name` is the input that stands for
/// it in fragments.
struct AtVertices {
    Node* value;
    std::string name;
};

/// A recorded text. Its nodes point into it.
struct Graph {
    Graph() = default;
    Graph(const Graph&) = delete;
    Graph& operator=(const Graph&) = delete;

    std::vector<std::unique_ptr<Node>> nodes;
    std::vector<std::unique_ptr<Loop>> loops;
    Region top;
    std::vector<Named> inputs, outputs;
    std::vector<Uniform> uniforms;
    std::vector<Parameter> parameters;
    std::vector<AtVertices> at_vertices;
};

}  // namespace quadrel::recorded
