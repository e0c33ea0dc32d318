#include "render/plan/texels_read.hpp"

#include <algorithm>
#include <span>
#include <string_view>

#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

/// These read the height map's own texels, or the patches between them, and nothing else of it.
constexpr std::string_view height_level_0[] = {
    "texel-exact",    "max-mip",         "cone-cell",     "rmq-leap",        "qdm",
    "oracle",         "oracle-bilinear", "oracle-block",  "oracle-tri-main", "oracle-tri-anti",
    "oracle-tri-min", "shadow-exact",    "shadow-oracle", "ao-oracle",       "h2n-patch"};

/// These take the exponent from the gloss map, and nothing else.
constexpr std::string_view gloss_exponent[] = {"shade-phong", "shade-blinn-phong",
                                               "shade-cook-torrance"};

bool has(std::span<const std::string_view> ids, const PlannedStage& stage) {
    return std::find(ids.begin(), ids.end(), stage.info->text.id) != ids.end();
}

bool reads(const PlannedStage& stage, TextureSlot slot) {
    const auto& slots = stage.info->textures;
    return std::find(slots.begin(), slots.end(), slot) != slots.end();
}

/// Whether f holds for all planned stages that read a slot.
class Readers {
  public:
    Readers(const MaterialPlan& drawn, const MaterialPlan& discard) : plans_{&drawn, &discard} {}

    template <class F>
    bool all(TextureSlot slot, const F& f) const {
        return std::all_of(std::begin(plans_), std::end(plans_), [&](const MaterialPlan* plan) {
            return std::all_of(plan->stages.begin(), plan->stages.end(),
                               [&](const auto& stage) { return !reads(stage, slot) || f(stage); });
        });
    }

  private:
    const MaterialPlan* plans_[2];
};

bool reads_finest_level(const TextureReference& texture, TextureSlot slot, const Readers& readers) {
    const bool no_mips = texture.sampler.mip == MipFilter::none;
    return readers.all(slot, [&](const PlannedStage& stage) {
        return (slot == TextureSlot::height && has(height_level_0, stage)) ||
               (no_mips && !is_added(stage.info->text.id));
    });
}

bool reads_first_channel(const TextureReference& texture, TextureSlot slot,
                         const Readers& readers) {
    return slot == TextureSlot::gloss && texture.swizzle.empty() &&
           readers.all(slot, [](const PlannedStage& stage) { return has(gloss_exponent, stage); });
}

}  // namespace

TexelsRead texels_read(const Material& material, const MaterialPlan& drawn,
                       const MaterialPlan& discard) {
    const Readers readers(drawn, discard);
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
