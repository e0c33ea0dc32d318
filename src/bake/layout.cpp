#include "bake/layout.hpp"

namespace quadrel {

std::optional<TextureView> make_layout(int channels, int layers,
                                       const std::vector<LevelSize>& levels) {
    if (levels.size() > max_mip_levels) return std::nullopt;
    TextureView view{};
    view.channels = channels;
    view.faces = layers;
    std::int64_t offset = 0;
    for (const auto& [width, height] : levels) {
        view.width[view.levels] = width;
        view.height[view.levels] = height;
        view.offset[view.levels++] = static_cast<std::int32_t>(offset);
        offset += std::int64_t(width) * height * channels * layers;
        offset = (offset + 15) / 16 * 16;
        if (offset > max_texture_floats) return std::nullopt;
    }
    return view;
}

}  // namespace quadrel
