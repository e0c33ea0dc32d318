// What is asked of the module that writes a material's program.
#pragma once

#include <string>
#include <vector>

#include "export/export.hpp"
#include "export/scene/content.hpp"
#include "render/plan/render_plan.hpp"

namespace quadrel {

class MaterialProgram {
  public:
    /// Of the content's scene, whose channels and frame it has; the plan and it must outlive this.
    MaterialProgram(const ExportContent& content, const RenderPlan& plan, std::size_t material);
    MaterialProgram(const MaterialProgram&) = delete;
    MaterialProgram& operator=(const MaterialProgram&) = delete;

    /// Points into this.
    const ProgramRequest& request() const { return request_; }
    std::size_t material() const { return material_; }
    /// room/id, in their order.
    std::vector<std::string> stage_names() const;

  private:
    std::size_t material_;
    std::vector<PlannedStage> all_;
    std::vector<const PlannedStage*> needed_;
    std::vector<StageUse> uses_;
    MaterialUniforms uniforms_;
    ProgramRequest request_{};
};

}  // namespace quadrel
