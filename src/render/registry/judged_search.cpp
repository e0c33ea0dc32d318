#include "render/registry/judged_search.hpp"

#include <algorithm>

namespace quadrel {

bool is_judged(const StageInfo& trace) {
    const auto reads = [&](TextureSlot slot) {
        return std::ranges::count(trace.textures, slot) != 0;
    };
    return !reads(TextureSlot::layers) && (!trace.may_miss || reads(TextureSlot::prewarp));
}

}  // namespace quadrel
