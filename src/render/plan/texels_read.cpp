#include "render/plan/texels_read.hpp"

#include <algorithm>
#include <string>

#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

bool reads(const PlannedStage& stage, TextureSlot slot) {
    const auto& slots = stage.info->textures;
    return std::find(slots.begin(), slots.end(), slot) != slots.end();
}

/// Whether f holds for all planned stages that read a slot.
class Readers {
  public:
    explicit Readers(const std::vector<const MaterialPlan*>& plans) : plans_(plans) {}

    template <class F>
    bool all(TextureSlot slot, const F& f) const {
        return std::all_of(plans_.begin(), plans_.end(), [&](const MaterialPlan* plan) {
            return std::all_of(plan->stages.begin(), plan->stages.end(),
                               [&](const auto& stage) { return !reads(stage, slot) || f(stage); });
        });
    }

  private:
    const std::vector<const MaterialPlan*>& plans_;
};

bool reads_finest_level(const TextureReference& texture, TextureSlot slot, const Readers& readers) {
    const bool no_mips = texture.sampler.mip == MipFilter::none;
    return readers.all(slot, [&](const PlannedStage& stage) {
        return (slot == TextureSlot::height && stage.info->reads_finest_heights_only) ||
               (no_mips && !is_added(stage.info->text.id));
    });
}

bool reads_first_channel(const TextureReference& texture, TextureSlot slot,
                         const Readers& readers) {
    return slot == TextureSlot::gloss && texture.swizzle.empty() &&
           readers.all(
               slot, [](const PlannedStage& stage) { return stage.info->reads_first_gloss_only; });
}

}  // namespace

TexelsRead texels_read(const Material& material, const std::vector<const MaterialPlan*>& plans) {
    const Readers readers(plans);
    TexelsRead read;
    for (std::size_t i = 0; i < static_cast<std::size_t>(first_baked_slot); ++i) {
        const auto slot = static_cast<TextureSlot>(i);
        const auto texture = material.textures.find(std::string(slot_name(slot)));
        if (texture == material.textures.end()) continue;
        read.finest_level.set(i, reads_finest_level(texture->second, slot, readers));
        read.first_channel.set(i, reads_first_channel(texture->second, slot, readers));
    }
    return read;
}

}  // namespace quadrel
