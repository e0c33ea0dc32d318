// A question's textures as Quadrel samples them on a kind of hardware.
#pragma once

#include "rules/ask/question.hpp"

namespace quadrel::rules {

class SampledMaps {
  public:
    SampledMaps(const std::vector<ProbeTexture>& maps, const HardwareModel& hardware);
    const std::vector<SampledTexture>& all() const { return all_; }

  private:
    std::vector<std::vector<float>> texels_;
    std::vector<SampledTexture> all_;
};

}  // namespace quadrel::rules
