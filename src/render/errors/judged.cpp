#include "render/errors/judged.hpp"

#include <algorithm>

#include "quadrel/error.hpp"

namespace quadrel {

void require_judged(const ErrorSummary& summary, const Scene& scene) {
    if (summary.judged > 0) return;
    const bool has_map = std::ranges::any_of(scene.materials, [](const Material& material) {
        return !material.noise && material.textures.contains("height");
    });
    const char* const found = summary.covered == 0 ? "nothing to judge: no pixel is covered"
                              : !has_map ? "nothing to judge: no material has a height map"
                                         : "nothing to judge: no covered pixel has a height map, a "
                                           "frame and a straight ray";
    throw InputError(scene.file.string(), "", found, "objects in view whose heights are a map");
}

}  // namespace quadrel
