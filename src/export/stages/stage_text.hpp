// A stage's function in a shading language: recorded, folded, written, its parameters by name.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "export/print/dialect.hpp"
#include "export/stages/plain_scene.hpp"
#include "export/stages/recorded_stage.hpp"

namespace quadrel::recorded {

struct FunctionText {
    std::string name;
    std::string text;  ///< comments and the function
    std::vector<Named> inputs, outputs;
    std::vector<Uniform> uniforms;
};

/// `params`: the stage's, or null for the defaults. `outputs`: those that are needed; all if empty.
/// `suffix`: of the function's name. Throws RecordingError.
FunctionText write_stage(const RecordedStage& stage, const ShaderScene& scene, const void* params,
                         const std::set<std::string>& outputs, const Dialect& dialect,
                         const std::string& suffix = "");

/// What the function takes for granted of its scene, of which a shader cannot tell: comment lines.
std::string assumptions(const RecordedStage& stage, const FunctionText& function,
                        const PlainScene& plain, int light);

/// Adds those of `more` that `all` has not.
void add_uniforms(std::vector<Uniform>& all, const std::vector<Uniform>& more);

/// Texts of functions with all that they need, which is there once: version, constants, uniforms.
std::string whole_file(const std::string& functions, const std::vector<Uniform>& uniforms,
                       const Dialect& dialect);

/// A word of letters, digits and underscores.
std::string as_word(const std::string& text);

}  // namespace quadrel::recorded
