#include "quadrel/relief/registry.hpp"

#include <array>

#include "quadrel/error.hpp"
#include "quadrel/quad/slot_names.hpp"
#include "quadrel/relief/stages.hpp"
#include "quadrel/shade/stages.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

/// Every stage works on the first two of them.
constexpr std::array<std::string_view, 3> number_types{"float", "double", "dual"};

/// More than any program adds; so that what all_stages gave out stays where it is.
constexpr std::size_t added_capacity = 4096;

template <class T>
std::span<const T> list(const T* first, std::int32_t count) {
    return {first, static_cast<std::size_t>(count)};
}

StageInfo describe(const StageRow& row) {
    return {.text = row.text,
            .inputs = list(row.inputs, row.input_count),
            .outputs = list(row.outputs, row.output_count),
            .textures = list(row.textures, row.texture_count),
            .parameters = list(row.parameters, row.parameter_count),
            .number_types = list(number_types.data(), row.runs_on_duals != 0 ? 3 : 2),
            .params_size = static_cast<std::size_t>(row.params_size),
            .uses_height_bounds = row.uses_height_bounds != 0,
            .needs_height_map = row.needs_height_map != 0,
            .may_miss = row.may_miss != 0,
            .reads_vertices = row.reads_vertices != 0,
            .reads_finest_heights_only = row.reads_finest_heights_only != 0,
            .reads_first_gloss_only = row.reads_first_gloss_only != 0,
            .lattice_steps = row.lattice_steps,
            .not_reproduced = row.not_reproduced,
            .set_defaults = row.set_defaults};
}

template <class... S>
void describe_all(StageList<S...>, std::vector<StageInfo>& all) {
    (all.push_back(describe(describe_stage<S>())), ...);
}

template <class... Lists>
std::vector<StageInfo> describe_lists() {
    std::vector<StageInfo> all;
    (describe_all(Lists(), all), ...);
    all.reserve(all.size() + added_capacity);
    return all;
}

std::vector<StageInfo>& registry() {
    static auto stages =
        describe_lists<QuadStages, FrameStages, OracleStages, OffsetStages, MarchStages, ConeStages,
                       ExactStages, LayerStages, CurvedStages, TableStages, OracleTraceStages,
                       EngineStages, ShellStages, HitStages, SurfaceStages, ShadowStages,
                       OracleShadowStages, OcclusionStages, OracleOcclusionStages, ShadeStages>();
    return stages;
}

}  // namespace

std::span<const StageInfo> all_stages() { return registry(); }

void append_to_registry(std::span<const StageRow* const> rows) {
    std::vector<StageInfo>& all = registry();
    if (all.size() + rows.size() > all.capacity())
        throw UsageError("more stages than the registry has room for");
    for (const StageRow* row : rows) all.push_back(describe(*row));
}

const StageInfo* find_stage(std::string_view id) {
    for (const StageInfo& stage : all_stages())
        if (id == stage.text.id) return &stage;
    return nullptr;
}

std::string_view slot_name(TextureSlot slot) {
    return texture_slot_names[static_cast<std::size_t>(slot)];
}

}  // namespace quadrel
