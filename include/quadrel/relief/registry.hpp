// Every stage by its id: what it is, what it reads and writes, which parameters it takes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quadrel/quad/stage_row.hpp"

namespace quadrel {

/// A stage as the planner and `list algorithms` see it.
struct StageInfo {
    StageText text;
    std::span<const Value> inputs, outputs;
    std::span<const TextureSlot> textures;
    std::span<const ParameterText> parameters;
    std::span<const std::string_view> number_types;  ///< float, double, and dual if it declares it
    std::size_t params_size;
    bool uses_height_bounds;  ///< see StageDefaults
    /// Whether it reads the height map itself (its texels, sizes or levels), so that heights of
    /// noise do not serve it.
    bool needs_height_map;
    /// Whether it is a search that a ray may pass without a hit: its fragments of status CLIP are
    /// demoted, whatever clipping the material has.
    bool may_miss;
    bool reads_vertices;  ///< see StageDefaults, as of the next two
    bool reads_finest_heights_only, reads_first_gloss_only;
    /// Of a search that leaves out steps by the maxima of the height map: see StageRow. Else null.
    std::int32_t (*lattice_steps)(const void* params);
    /// What its source does and the stage doesn't, in words; empty where it does all.
    std::string_view not_reproduced;
    /// Writes the parameters' defaults into `params` (params_size bytes, aligned for any type).
    void (*set_defaults)(void* params);
};

/// Whether the stage, at these parameters, leaves out steps by what the height map's heights are.
inline bool leaves_out_steps(const StageInfo& stage, const void* params) {
    return stage.lattice_steps != nullptr ? stage.lattice_steps(params) > 0
                                          : stage.uses_height_bounds;
}

/// All stages: Quadrel's own in the order of the data flow, then those that were added, as they
/// were. Adding keeps what was handed out valid; it must not happen while another thread renders.
std::span<const StageInfo> all_stages();

/// The stage of that id, or null.
const StageInfo* find_stage(std::string_view id);

/// Name of a texture slot in scene files: height, color, gloss, emissive, normal, environment,
/// layers.
std::string_view slot_name(TextureSlot slot);

/// Adds stages of the calling program (see register_stages): all or none; the rows must live as
/// long as the process. Adding the same again changes nothing. Throws UsageError for an id that
/// another stage has, and for a stage that cannot be planned.
void register_rows(std::span<const StageRow> rows);

/// Makes stages of the calling program usable by id in scenes, in this process. They are compiled
/// with the program, for plain numbers only: where a render runs on an instruction set, they run on
/// Quad<float> between the others, with the same bits. A plugin has lanes too.
template <class... Stages>
void register_stages() {
    static const StageRow rows[] = {make_stage_row<Stages, Quad<float>>()...};
    register_rows(rows);
}

/// Loads a plugin built by quadrel_add_stages for the rest of the process and adds its stages. Its
/// parts for instruction sets lie beside it and are loaded when a render first runs on them. Adding
/// the same file again changes nothing. Throws InputError for a file that is missing, no plugin, of
/// another version of Quadrel, or has stages that register_rows would refuse.
void load_plugin(const std::filesystem::path& file);

}  // namespace quadrel
