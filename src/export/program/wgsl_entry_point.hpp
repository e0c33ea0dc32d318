// Where shaders in WGSL begin. There is no preprocessor: each pass has an entry point of its own,
// `pass0`, and whether vertices come as Quadrel has transformed them is a constant of the pipeline.
#pragma once

#include "export/program/entry_point.hpp"

namespace quadrel::recorded {

class WgslEntryPoint : public EntryPoint {
  public:
    using EntryPoint::EntryPoint;

    std::string fragment(const FragmentText& text) const override;
    std::string vertex(const VertexText& text) const override;
    std::string frag_coord() const override { return "varyings.window.xy"; }
    std::string front_facing() const override { return "is_front_facing"; }
    bool has_lod() const override { return false; }
    bool has_one_struct() const override { return true; }

  private:
    std::string begin_module(const std::string& comment, const std::string& all,
                             const std::vector<Uniform>& uniforms) const;
    std::string varyings_struct(const std::vector<Varying>& varyings, bool centroid) const;
    std::string values(const FragmentText& text) const;
    std::string pass(const FragmentText& text, std::size_t number) const;
    std::string vertex_branch(const VertexText& text, bool shaded,
                              const std::string& indent = "    ") const;
};

}  // namespace quadrel::recorded
