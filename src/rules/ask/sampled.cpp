#include "rules/ask/sampled.hpp"

#include "quadrel/scene/hardware_sampler.hpp"

namespace quadrel::rules {
namespace {

/// Sizes and offsets of a texture whose levels lie one after the other.
TextureView view_of(const ProbeTexture& map, const std::vector<float>& texels) {
    TextureView view{};
    view.texels = texels.data();
    view.channels = map.channels;
    view.faces = map.cube ? 6 : 1;
    view.levels = static_cast<std::int32_t>(map.levels.size());
    std::int32_t offset = 0;
    for (int level = 0; level < view.levels; ++level) {
        view.width[level] = std::max(1, map.width >> level);
        view.height[level] = std::max(1, map.height >> level);
        view.offset[level] = offset;
        offset += view.width[level] * view.height[level] * view.channels * view.faces;
    }
    return view;
}

}  // namespace

SampledMaps::SampledMaps(const std::vector<ProbeTexture>& maps, const HardwareModel& hardware) {
    for (const ProbeTexture& map : maps) {
        std::vector<float> texels;
        for (const auto& level : map.levels)
            texels.insert(texels.end(), level.begin(), level.end());
        texels_.push_back(std::move(texels));
        all_.push_back({view_of(map, texels_.back()), on_hardware(map.sampler, hardware)});
    }
}

}  // namespace quadrel::rules
