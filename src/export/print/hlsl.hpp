// HLSL of shader model 5. Each map is a texture and a sampler of its own, `height_map_sampler`.
#pragma once

#include "export/print/dialect.hpp"

namespace quadrel::recorded {

class HlslDialect : public Dialect {
  public:
    std::string type(Type type) const override;
    std::string call(const Node& node, const std::vector<std::string>& arguments) const override;
    std::string uniform(const Uniform& uniform) const override;
    std::string first_lines(const std::string& text) const override;
    std::string prelude(const std::string& text) const override;
};

}  // namespace quadrel::recorded
