// Where a shader begins, in each language: what it is handed, and what it hands on.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "export/print/dialect.hpp"
#include "export/program/varyings.hpp"

namespace quadrel::recorded {

/// Of each pass the targets, of each target what its four components are made of, in order.
using PassTargets = std::vector<std::vector<std::vector<std::string>>>;

struct FragmentText {
    std::string comment;
    std::vector<Varying> varyings;
    bool centroid = false;  ///< they are taken at the centroid
    std::vector<Uniform> uniforms;
    std::string functions;
    std::vector<std::string> statements;  ///< of the entry point, before it hands values on
    std::vector<Named> values;            ///< that these give names to
    PassTargets passes;
    std::string depth, discard;  ///< depth to write, and when not to; empty: none
    std::string lod_map;         ///< map whose level of detail is asked for; empty: none
    bool asks_front_facing = false;
};

/// A call of a vertex program's function.
struct VertexCall {
    std::string function;
    std::vector<std::string> arguments;  ///< expressions
    std::vector<Named> results;          ///< as the function calls them
    std::vector<std::string> varyings;   ///< that they are, in their order
    bool is_needed = false;              ///< whether no attribute has one of them
};

struct VertexText {
    std::string comment;
    std::vector<Attribute> attributes;
    std::vector<Varying> varyings;
    bool centroid = false;
    std::vector<Uniform> uniforms;
    std::string functions;
    std::string fragment_functions;  ///< of the shader that it is linked with: of one version
    /// An expression for each varying out of the mesh's own vertices, and the attribute that holds
    /// what Quadrel makes of them; the same where nothing is to be made, empty where a call does.
    struct Value {
        std::string transformed, shaded;
    };
    std::vector<Value> values;
    std::vector<VertexCall> calls;
    Value position;  ///< in clip space
};

/// The base is GLSL 330.
class EntryPoint {
  public:
    explicit EntryPoint(const Dialect& dialect) : dialect_(dialect) {}
    EntryPoint(const EntryPoint&) = delete;
    EntryPoint& operator=(const EntryPoint&) = delete;
    virtual ~EntryPoint() = default;

    virtual std::string fragment(const FragmentText& text) const;
    virtual std::string vertex(const VertexText& text) const;
    /// Where a fragment is in the window, as a vector of two.
    virtual std::string frag_coord() const { return "gl_FragCoord.xy"; }
    /// Whether the fragment's triangle faces the front, where the text asks for that.
    virtual std::string front_facing() const { return "gl_FrontFacing"; }
    /// Whether a shader can ask for levels of detail.
    virtual bool has_lod() const { return true; }
    /// Whether both shaders declare all numbers of both, since they read one buffer.
    virtual bool has_one_struct() const { return false; }

  protected:
    /// First lines, comment, a macro of that name and value unless there is one, constants,
    /// uniforms.
    std::string begin(const std::string& comment, const std::string& all,
                      const std::vector<Uniform>& uniforms, const std::string& first,
                      const std::string& macro) const;
    /// `level_of_detail`, a vector of two: the level that is read, and before clamps.
    virtual std::string lod_statements(const std::string& map, const std::string& version) const;
    /// What `assign(target, components)` says of each target, by pass.
    template <class Assign>
    std::string assignments(const FragmentText& text, const Assign& assign) const;
    /// What `assign(varying, value)` says of each varying, `call(call)` of what calls make, and
    /// `place(position)` of the position, both ways.
    template <class Assign, class Call, class Place>
    std::string vertex_values(const VertexText& text, const Assign& assign, const Call& call,
                              const Place& place) const;

    const Dialect& dialect_;
};

/// Null where no programs are written in the language.
std::unique_ptr<EntryPoint> find_entry_point(std::string_view language, const Dialect& dialect);

/// A statement of a body, in lines to read.
std::string statement(const std::string& text);

/// `float4(x, 0.0, ...)`: what a target's four components are made of.
std::string target_value(const std::string& type, const std::vector<std::string>& parts);

}  // namespace quadrel::recorded
