#include "bake/height_plane.hpp"

namespace quadrel {

HeightPlane::HeightPlane(const Texture& texture, const SamplerState& sampler, int channel)
    : width(texture.view().width[0]),
      height(texture.view().height[0]),
      grid(texel_grid(width, height, sampler)) {
    const TextureView& view = texture.view();
    const float* const texels = texture.level_texels(0, 0);
    const std::size_t count = static_cast<std::size_t>(grid.u.count) * grid.v.count;
    const auto is_stored = [](const GridAxis& axis, int size) {
        return axis.first == 0 && axis.count == size;
    };
    if (view.channels == 1 && is_stored(grid.u, width) && is_stored(grid.v, height)) {
        heights = {texels, count};
        return;
    }
    wrapped_.reserve(count);
    for (int j = grid.v.first; j < grid.v.first + grid.v.count; ++j) {
        const int row = wrap_index<float>(j, height, sampler.wrap_v);
        for (int i = grid.u.first; i < grid.u.first + grid.u.count; ++i) {
            const int column = wrap_index<float>(i, width, sampler.wrap_u);
            const bool inside = inside_level<float>(i, width, sampler.wrap_u) &&
                                inside_level<float>(j, height, sampler.wrap_v);
            const std::size_t texel = static_cast<std::size_t>(row) * width + column;
            wrapped_.push_back(inside ? texels[texel * view.channels + channel]
                                      : sampler.border[channel]);
        }
    }
    heights = wrapped_;
}

}  // namespace quadrel
