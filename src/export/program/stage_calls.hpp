// The functions of a program's stages: which are needed, and what they hand to one another.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "export/stages/stage_text.hpp"
#include "export/table.hpp"

namespace quadrel::recorded {

/// Types of values by their names.
using ValueTypes = std::map<std::string, Type>;

/// What the request's stages are recorded with.
ShaderScene scene_of(const ProgramRequest& request);

/// What stands behind the names of a stage's functions, and a stage's varyings in front: those of a
/// light have its number.
std::string suffix_of(const StageUse& use);
/// The light that the stage serves, else 0.
int light_of(const StageUse& use);

class StageCalls {
  public:
    /// Of `stages`, in the order of the data flow, those that `wanted` needs: values by the
    /// names that shaders have. What only the rasterizer and samplers give is left open. `scene`
    /// serves one light after another. Throws RecordingError that begins with the stage.
    StageCalls(const StageUse* stages, int count, ShaderScene& scene, const ValueTypes& wanted,
               const Dialect& dialect);

    /// In their order.
    const std::vector<FunctionText>& functions() const { return functions_; }
    const std::vector<Uniform>& uniforms() const { return uniforms_; }
    /// Values that are needed and that no stage gives.
    const ValueTypes& open() const { return open_; }

  private:
    std::vector<FunctionText> functions_;
    std::vector<Uniform> uniforms_;
    ValueTypes open_;
};

}  // namespace quadrel::recorded
