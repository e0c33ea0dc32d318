// WGSL. A function gives a struct of its outputs. Uniforms are one struct, each map is a texture
// and a sampler of its own, `height_map_sampler`; all of them are bound in their order, in group 0.
#pragma once

#include "export/print/dialect.hpp"

namespace quadrel::recorded {

class WgslDialect : public Dialect {
  public:
    std::string type(Type type) const override;
    std::string real(float value) const override;
    std::string call(const Node& node, const std::vector<std::string>& arguments) const override;
    std::string choice(const std::string& condition, const std::string& a,
                       const std::string& b) const override;
    bool chooses_by_function() const override { return true; }
    int operand_level(const Node& in, const Node& of, int otherwise) const override;
    std::string shift_count(const Node& count, const std::string& text) const override;
    std::string constant(Type type, const std::string& name,
                         const std::string& value) const override;
    std::string variable(Type type, const std::string& name,
                         const std::string& value) const override;
    std::string parameter(Type type, const std::string& name,
                          const std::string& value) const override;
    std::string counted_loop(const std::string& index, const std::string& first,
                             const std::string& condition) const override;
    std::string endless_loop() const override;
    std::string guarded(const std::string& head, const std::string& statement) const override;
    bool has_outputs() const override { return false; }
    std::string declarations(const std::string& name,
                             const std::vector<Named>& outputs) const override;
    std::string head(const std::string& name, const std::vector<Named>& inputs,
                     const std::vector<Named>& outputs) const override;
    std::string helper_head(Type result, const std::string& name,
                            const std::vector<Named>& inputs) const override;
    std::string first_line(const std::string& name) const override;
    std::string store(const std::string& output, const std::string& value) const override;
    std::string last_line() const override;
    std::string uniform(const Uniform& uniform) const override;
    std::string uniforms(const std::vector<Uniform>& all, const std::string& text) const override;
    std::string use_of(const Uniform& uniform, const std::string& text) const override;
    std::string first_lines(const std::string& text) const override;
    std::string prelude(const std::string& text) const override;

  private:
    std::string parameters_of(const std::vector<Named>& inputs) const;
};

}  // namespace quadrel::recorded
