// Which texels of a render's textures its look-ups touch.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "quadrel/stats.hpp"
#include "quadrel/texture/marks.hpp"
#include "render/plan/render_plan.hpp"

namespace quadrel {

/// Marks of all textures of a plan; a texture that several materials share is marked once. Texels
/// are float32, as kernels hold them.
class TouchedTexels {
  public:
    /// The plan must outlive it.
    explicit TouchedTexels(const RenderPlan& plan);

    /// Where look-ups in that texture are marked; null where none is bound. Threads may share it.
    const TexelMarks* marks(std::uint32_t material, int slot) const;

    /// Of one mip level of the texture bound there, all faces.
    TouchedStats count(std::uint32_t material, int slot, int level) const;

    /// Of all textures together.
    TouchedStats total() const;

  private:
    struct Marked {
        std::vector<std::uint64_t> words;
        TexelMarks marks;
    };

    const Texture* texture(std::uint32_t material, int slot) const;
    TouchedStats count(const Texture& texture, int level) const;

    const RenderPlan& plan_;
    std::map<const Texture*, std::unique_ptr<Marked>> marked_;
};

}  // namespace quadrel
