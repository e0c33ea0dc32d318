// What has to be computed: from the requested channels back to stages, values and textures.
#pragma once

#include <bitset>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "kernels/table.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/default_stage.hpp"
#include "quadrel/scene/scene.hpp"
#include "render/plan/channel_source.hpp"

namespace quadrel {

/// A bit for each rule about what stages store.
using BorderChecks = std::bitset<9>;

/// One call per batch.
struct PlannedStage {
    const StageInfo* info = nullptr;
    StageFunction run = nullptr;
    std::vector<std::max_align_t> params;
    int light = -1;  ///< which light, for stages that serve one at a time
    /// What of its outputs is to be looked at (render/draw/border_check.hpp), settled with the
    /// plan.
    BorderChecks checks;
};

/// Whether the stage has that output.
bool stores(const PlannedStage& stage, Value v);

using ValueSet = std::bitset<static_cast<std::size_t>(Value::count)>;
using SlotSet = std::bitset<texture_slot_count>;
using LightSet = std::bitset<max_lights>;

/// Stages [first, end) of a plan that one kernel runs.
struct PlannedChain {
    std::size_t first = 0, end = 0;
    ChainFunction run = nullptr;
};

/// The stages of one material that the wanted values need, in the order of the data flow.
struct MaterialPlan {
    std::vector<PlannedStage> stages;
    ValueSet values;    ///< every value that a stage loads or that is wanted
    ValueSet wanted;    ///< every value that the film or a decision about it reads
    ValueSet produced;  ///< those that a stage stores; the others read as 0
    std::vector<PlannedChain> chains;
    ValueSet in_arrays;  ///< of `values`, those that need an array where chains run
    SlotSet textures;
    bool needs_height = false;  ///< a relief stage reads heights
    /// The first stage that noise in place of a height map does not serve: it reads the map itself,
    /// or one that is baked from it. Null if there is none.
    const StageInfo* needs_height_map = nullptr;
    /// The first stage that reads the depth layers. Null if there is none.
    const StageInfo* needs_layers = nullptr;
};

/// Whether no later stage of the plan stores the value, of the same light where each has one: what
/// stage number `stage` leaves is what channels show.
bool is_last_to_store(const MaterialPlan& plan, std::size_t stage, Value v);

/// Where the material's heights come from, which its default stages follow.
HeightSource height_source(const Material& material);

/// Whether fragments of status CLIP are demoted: the material has a clipping stage, or its search
/// is one that rays may pass.
bool clips(const Material& material);

/// Whether fragments are tested and written with the depth of their hit.
bool writes_depth(const Material& material);

/// Whether the relief's depth differs from fragment to fragment.
bool grades_depth(const Material& material);

/// Stage ids of a material with defaults filled in, in the order of the data flow, quad stages
/// included; their parameters checked. Throws InputError.
std::vector<PlannedStage> material_stages(const Scene& scene, const Material& material);

/// Values, and of those that each light has one of, for which lights.
struct Wanted {
    ValueSet values;
    LightSet lights;
};

/// Keeps of the material's stages what `wanted` needs and binds it to the kernels of `table`.
MaterialPlan plan_material(const Scene& scene, const Material& material, const Wanted& wanted,
                           const KernelTable& table);

/// The values that channels read.
Wanted wanted_values(const std::vector<ChannelSource>& channels);

/// Every value, but for the judge's, which takes longer than all the rest: of those what channels
/// read.
Wanted all_values(const std::vector<ChannelSource>& channels);

}  // namespace quadrel
