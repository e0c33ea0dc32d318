#include "stress/affordable.hpp"

#include <algorithm>

#include "quadrel/relief/registry.hpp"
#include "quadrel/render.hpp"
#include "quadrel/stats.hpp"

namespace quadrel::stress {
namespace {

/// Look-ups that take as long as a step of a judge, which is counted as none.
constexpr double look_ups_of_judges_step = 16;
/// And as a ray of the judge of occlusion, which nothing counts.
constexpr double look_ups_of_sky_ray = 64;

bool judges(const StageChoice& choice) { return choice.id.find("oracle") != std::string::npos; }

/// Rays towards the sky from a fragment.
double sky_rays(const StageChoice& occlusion) {
    if (!judges(occlusion)) return 0;
    const auto given = occlusion.parameters.find("samples");
    if (given != occlusion.parameters.end())
        if (const double* number = given->second.number()) return *number;
    const StageInfo* const stage = find_stage(occlusion.id);
    if (stage == nullptr) return 0;
    for (const ParameterText& parameter : stage->parameters)
        if (std::string_view(parameter.name) == "samples") return parameter.default_value;
    return 0;
}

/// What drawing a window takes, by its look-ups: lanes draw it, quickly.
double look_ups_of(const Scene& scene, const Window& window) {
    RenderStats stats;
    RenderOptions options;
    options.window = window;
    options.channels = plain_channels();
    options.threads = 1;
    options.stats = &stats;
    options.touched = true;  // all steps are counted, those that drawing leaves out, too
    render(scene, options);
    const Material& material = scene.materials.front();
    double look_ups = static_cast<double>(stats.fetches.fetches);
    // Walks over cells read texels that are not counted as look-ups: their steps are.
    const auto of_step = [](const StageChoice& stage) {
        return judges(stage) ? look_ups_of_judges_step : 1;
    };
    look_ups += of_step(material.trace) * static_cast<double>(stats.trace_steps);
    look_ups += of_step(material.shadow) * static_cast<double>(stats.shadow_steps);
    const auto lanes = static_cast<double>(stats.covered_lanes + stats.helper_lanes);
    return look_ups + look_ups_of_sky_ray * sky_rays(material.occlusion) * lanes;
}

/// At most `side` pixels along each axis, whole quads, around the middle.
Window middle(const Scene& scene, int side) {
    const int width = std::min(scene.width, side), height = std::min(scene.height, side);
    const int x0 = (scene.width - width) / 4 * 2, y0 = (scene.height - height) / 4 * 2;
    return {x0, y0, x0 + width, y0 + height};
}

}  // namespace

const std::vector<std::string>& plain_channels() {
    static const std::vector<std::string> all = {
        "R",     "G",    "B",    "A", "Z",      "depth", "P",    "Ng",       "uv", "dUVdx",
        "dUVdy", "dPdx", "dPdy", "J", "T",      "B.X",   "B.Y",  "B.Z",      "r",  "relief.depth",
        "K",     "lod",  "hit",  "N", "shadow", "light", "bary", "quad.lane"};
    return all;
}

std::optional<Window> affordable_window(const Scene& scene, double look_ups) {
    constexpr int fewest = 2;  // a quad
    const int longest = std::max(scene.width, scene.height);
    // From small to large, so that finding out what is too much does not take long itself.
    Window affordable = middle(scene, fewest);
    for (int side = fewest;; side *= 2) {
        const Window window = middle(scene, side);
        if (look_ups_of(scene, window) > look_ups) return affordable;
        if (side >= longest) return std::nullopt;
        affordable = window;
    }
}

}  // namespace quadrel::stress
