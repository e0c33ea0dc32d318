#include "quadrel/relief/registry.hpp"

#include <array>

#include "quadrel/relief/stages.hpp"
#include "quadrel/shade/stages.hpp"

namespace quadrel {
namespace {

/// Every stage so far works on all of them.
constexpr std::array<std::string_view, 2> number_types{"float", "double"};

/// Whether a stage says that it reads the height map itself:
///     static constexpr bool needs_height_map = true;
template <class Stage>
constexpr bool declares_height_map() {
    if constexpr (requires { Stage::needs_height_map; }) return Stage::needs_height_map;
    return false;
}

template <class Stage>
StageInfo describe() {
    return {Stage::text,
            Stage::inputs,
            Stage::outputs,
            Stage::textures,
            Stage::parameters,
            number_types,
            sizeof(typename Stage::Params),
            declares_height_map<Stage>(),
            [](void* params) { *static_cast<typename Stage::Params*>(params) = {}; }};
}

template <class... S>
void describe_all(StageList<S...>, std::vector<StageInfo>& all) {
    (all.push_back(describe<S>()), ...);
}

template <class... Lists>
std::vector<StageInfo> describe_lists() {
    std::vector<StageInfo> all;
    (describe_all(Lists(), all), ...);
    return all;
}

}  // namespace

std::span<const StageInfo> all_stages() {
    static const auto stages =
        describe_lists<QuadStages, FrameStages, OffsetStages, MarchStages, ConeStages, ExactStages,
                       HitStages, SurfaceStages, ShadowStages, OcclusionStages, ShadeStages>();
    return stages;
}

const StageInfo* find_stage(std::string_view id) {
    for (const StageInfo& stage : all_stages())
        if (id == stage.text.id) return &stage;
    return nullptr;
}

std::string_view slot_name(TextureSlot slot) {
    constexpr std::array<std::string_view, texture_slot_count> names{
        "height",          "color",      "gloss",     "emissive",       "normal",
        "environment",     "max-mip",    "min-max",   "texel-max",      "cone",
        "cone-robust",     "cone-quick", "cone-cell", "relaxed-cone",   "relaxed-cone-exact",
        "quad-cone",       "aniso-cone", "distance",  "distance-exact", "horizon",
        "horizon-sampled", "rmq"};
    return names[static_cast<std::size_t>(slot)];
}

}  // namespace quadrel
