#include "bake/job.hpp"

#include <fmt/format.h>

#include "quadrel/error.hpp"

namespace quadrel {

std::shared_ptr<Texture> BakeJob::make(int channels, int layers,
                                       const std::vector<LevelSize>& levels) const {
    const auto layout = make_layout(channels, layers, levels);
    if (!layout) {
        throw InputError("", "",
                         fmt::format("a height field of {} x {} texels", plane.width, plane.height),
                         "one whose baked map has at most 17 levels and 2^29 floats");
    }
    return std::make_shared<Texture>(*layout, TexelFormat::float32, id);
}

}  // namespace quadrel
