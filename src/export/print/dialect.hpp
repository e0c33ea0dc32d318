// What shading languages write differently. The base is GLSL 330.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

class Dialect {
  public:
    Dialect() = default;
    Dialect(const Dialect&) = delete;
    Dialect& operator=(const Dialect&) = delete;
    virtual ~Dialect() = default;

    virtual std::string type(Type type) const;
    virtual std::string real(float value) const;
    /// A call of `node`'s function, whose arguments are written.
    virtual std::string call(const Node& node, const std::vector<std::string>& arguments) const;
    virtual std::string choice(const std::string& condition, const std::string& a,
                               const std::string& b) const;
    /// Whether `choice` is a call, not an operator.
    virtual bool chooses_by_function() const { return false; }
    /// The weakest operator that needs no parentheses in the place of `of` in `in`: `otherwise`,
    /// but where operators may not stand beside each other.
    virtual int operand_level(const Node& in, const Node& of, int otherwise) const;
    /// How many bits are shifted by, the right side of a shift.
    virtual std::string shift_count(const Node& count, const std::string& text) const;
    /// The first components of a vector.
    virtual std::string prefix(const std::string& vector, int components) const;

    /// A local that keeps its value, and one that does not.
    virtual std::string constant(Type type, const std::string& name,
                                 const std::string& value) const;
    virtual std::string variable(Type type, const std::string& name,
                                 const std::string& value) const;
    /// A constant that is known as the shader is compiled.
    virtual std::string parameter(Type type, const std::string& name,
                                  const std::string& value) const;
    virtual std::string counted_loop(const std::string& index, const std::string& first,
                                     const std::string& condition) const;
    virtual std::string endless_loop() const;
    /// One statement behind `if (...)` or `else`.
    virtual std::string guarded(const std::string& head, const std::string& statement) const;

    /// Whether a function has its outputs among its parameters; else it returns a struct of them.
    virtual bool has_outputs() const { return true; }
    /// `void name(...)`: what stands in front of it, and at the beginning and the end of its body;
    /// empty for nothing.
    virtual std::string declarations(const std::string& name,
                                     const std::vector<Named>& outputs) const;
    virtual std::string head(const std::string& name, const std::vector<Named>& inputs,
                             const std::vector<Named>& outputs) const;
    /// `type name(...)`, of what returns a value.
    virtual std::string helper_head(Type result, const std::string& name,
                                    const std::vector<Named>& inputs) const;
    virtual std::string first_line(const std::string& name) const;
    virtual std::string store(const std::string& output, const std::string& value) const;
    virtual std::string last_line() const;
    virtual std::string uniform(const Uniform& uniform) const;
    /// All that `text` reads.
    virtual std::string uniforms(const std::vector<Uniform>& all, const std::string& text) const;
    /// `text`, a uniform or an element of it, as an expression.
    virtual std::string use_of(const Uniform& uniform, const std::string& text) const;
    /// What `text` needs in front of it: the version, then constants and functions.
    virtual std::string first_lines(const std::string& text) const;
    virtual std::string prelude(const std::string& text) const;

  protected:
    /// Whether `word` begins somewhere in the text.
    static bool has_word(const std::string& text, const std::string& word);
    static std::string join(const std::vector<std::string>& parts);
    /// The fewest digits that read back as `value`, as GLSL wants them: with a point.
    static std::string shortest(float value);
};

/// By its name on the command line: glsl, glsl-es, hlsl, wgsl, c++; null where there is none of
/// that name.
std::unique_ptr<Dialect> find_dialect(std::string_view name);

/// Words that no shading language leaves to names.
bool is_reserved(const std::string& word);

}  // namespace quadrel::recorded
