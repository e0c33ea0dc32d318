// A stage's function in a shading language: recorded, folded, written, its parameters by name.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "export/print/dialect.hpp"
#include "export/stages/plain_scene.hpp"
#include "export/stages/recorded_stage.hpp"

namespace quadrel::recorded {

/// What a stage computes at the vertices, as a function of their attributes (vertex_attribute).
struct VertexFunction {
    std::string name;
    std::string text;
    std::vector<Named> inputs, outputs;
    std::vector<Uniform> uniforms;
    /// The outputs as programs call them: inputs of the stage's function.
    std::vector<Named> varyings;
};

struct FunctionText {
    std::string name;
    std::string text;  ///< comments and the function
    std::vector<Named> inputs, outputs;
    std::optional<VertexFunction> vertex;
    std::vector<Uniform> uniforms;
    std::vector<Parameter> parameters;  ///< the constants at its top
};

/// What parameters become that are used in sums, products and as ends of loops alone. The others
/// are part of the text, which names them in a comment.
enum class ParametersAs { constants, uniforms };

/// `params`: the stage's, or null for the defaults. `outputs`: those that are needed; all if empty.
/// `suffix`: of the function's name. `apart`: parameters whose uniforms have the function's name in
/// front of theirs, since another function has others of that name. Throws RecordingError.
FunctionText write_stage(const RecordedStage& stage, const ShaderScene& scene, const void* params,
                         const std::set<std::string>& outputs, const Dialect& dialect,
                         const std::string& suffix = "",
                         ParametersAs parameters = ParametersAs::constants,
                         const std::set<std::string>& apart = {});

/// Names of uniforms that some of the functions declare differently from others: of another type,
/// meaning or value.
std::set<std::string> differing_uniforms(const std::vector<FunctionText>& functions);

/// What the function takes for granted of its scene, of which a shader cannot tell: comments.
std::vector<std::string> assumptions(const RecordedStage& stage, const FunctionText& function,
                                     const PlainScene& plain, int light);

/// Adds those of `more` that `all` has not.
void add_uniforms(std::vector<Uniform>& all, const std::vector<Uniform>& more);

/// Texts of functions with all that they need, which is there once: version, constants, uniforms.
/// `comments`, each once, come before all but the version.
std::string whole_file(const std::string& functions, const std::vector<Uniform>& uniforms,
                       const Dialect& dialect, const std::vector<std::string>& comments = {});

/// A word of letters, digits and underscores.
std::string as_word(const std::string& text);

}  // namespace quadrel::recorded
