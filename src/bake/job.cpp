#include "bake/job.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "quadrel/error.hpp"

namespace quadrel {

std::shared_ptr<Texture> BakeJob::make(int channels, int layers,
                                       const std::vector<LevelSize>& levels) const {
    const auto refuse = [&] {
        throw InputError("", "",
                         fmt::format("a height field of {} x {} texels", plane.width, plane.height),
                         "one whose baked map has at most 17 levels and 2^29 floats");
    };
    if (levels.size() > max_mip_levels) refuse();
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
        if (offset > max_texture_floats) refuse();
    }
    return std::make_shared<Texture>(view, TexelFormat::float32, id);
}

}  // namespace quadrel
