#include "bake/height_plane.hpp"

namespace quadrel {

HeightPlane::HeightPlane(const Texture& texture, const SamplerState& sampler)
    : width(texture.view().width[0]),
      height(texture.view().height[0]),
      grid(texel_grid(width, height, sampler)) {
    const TextureView& view = texture.view();
    const float* const texels = texture.level_texels(0, 0);
    heights.reserve(static_cast<std::size_t>(grid.u.count) * grid.v.count);
    for (int j = grid.v.first; j < grid.v.first + grid.v.count; ++j) {
        const int row = wrap_index<float>(j, height, sampler.wrap_v);
        for (int i = grid.u.first; i < grid.u.first + grid.u.count; ++i) {
            const int column = wrap_index<float>(i, width, sampler.wrap_u);
            const bool inside = inside_level<float>(i, width, sampler.wrap_u) &&
                                inside_level<float>(j, height, sampler.wrap_v);
            const std::size_t texel = static_cast<std::size_t>(row) * width + column;
            heights.push_back(inside ? texels[texel * view.channels] : sampler.border[0]);
        }
    }
}

}  // namespace quadrel
