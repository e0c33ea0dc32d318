// A stage as plain data: what crosses into the registry from a plugin, or from the program that
// uses the library. Pointers are to data that lives as long as the process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "quadrel/num/dual.hpp"
#include "quadrel/num/quad.hpp"
#include "quadrel/quad/stage.hpp"

namespace quadrel {

struct StageRow {
    StageText text;
    const Value* inputs;
    const Value* outputs;
    const TextureSlot* textures;
    const ParameterText* parameters;
    std::int32_t input_count, output_count, texture_count, parameter_count;
    std::int64_t params_size;
    /// See StageDefaults and StageInfo.
    std::int32_t uses_height_bounds, needs_height_map, may_miss, reads_vertices, runs_on_duals;
    std::int32_t reads_finest_heights_only, reads_first_gloss_only;
    const char* not_reproduced;  ///< see StageInfo; never null
    /// Of a search that leaves out steps by the maxima of the height map (MaterialUniforms), with
    /// the same bits but for counts: how many it makes at most. Null for other stages.
    std::int32_t (*lattice_steps)(const void* params);
    /// Writes the parameters' defaults into `params` (params_size bytes, aligned for any type).
    void (*set_defaults)(void* params);
    StageFunction run;         ///< on floats: Quad<float>, or the lanes of an instruction set
    StageFunction run_double;  ///< on Quad<double>; null in what is for one instruction set
    StageFunction run_dual;    ///< on Quad<Dual>; null there, and where it is not declared
};

namespace detail {
/// Whether a stage says that it reads the height map itself:
///     static constexpr bool needs_height_map = true;
template <class Stage>
constexpr bool declares_height_map() {
    if constexpr (requires { Stage::needs_height_map; }) return Stage::needs_height_map;
    return false;
}

/// Whether a search says that rays may pass it without a hit:
///     static constexpr bool may_miss = true;
template <class Stage>
constexpr bool declares_misses() {
    if constexpr (requires { Stage::may_miss; }) return Stage::may_miss;
    return false;
}

/// What a stage says that its source does and it doesn't:
///     static constexpr const char* not_reproduced = "the loop's bound of 30 steps";
template <class Stage>
constexpr const char* declared_not_reproduced() {
    if constexpr (requires { Stage::not_reproduced; }) return Stage::not_reproduced;
    return "";
}

/// How many steps a stage says that it makes at most, some of them left out:
///     static std::int32_t lattice_steps(const Params& params) { return params.steps; }
template <class Stage>
constexpr auto declared_lattice_steps() {
    using Params = typename Stage::Params;
    std::int32_t (*steps)(const void*) = nullptr;
    if constexpr (requires(Params params) { Stage::lattice_steps(params); })
        steps = [](const void* params) {
            return Stage::lattice_steps(*static_cast<const Params*>(params));
        };
    return steps;
}
}  // namespace detail

/// The row of a stage without its functions.
template <class Stage>
StageRow describe_stage() {
    using Params = typename Stage::Params;
    static_assert(std::is_trivially_copyable_v<Params>, "parameters are plain data");
    static_assert(alignof(Params) <= alignof(std::max_align_t));
    StageRow row{};
    row.text = Stage::text;
    row.inputs = Stage::inputs.data();
    row.outputs = Stage::outputs.data();
    row.textures = Stage::textures.data();
    row.parameters = Stage::parameters.data();
    row.input_count = static_cast<std::int32_t>(Stage::inputs.size());
    row.output_count = static_cast<std::int32_t>(Stage::outputs.size());
    row.texture_count = static_cast<std::int32_t>(Stage::textures.size());
    row.parameter_count = static_cast<std::int32_t>(Stage::parameters.size());
    row.params_size = sizeof(Params);
    row.uses_height_bounds = Stage::uses_height_bounds;
    row.needs_height_map = detail::declares_height_map<Stage>();
    row.may_miss = detail::declares_misses<Stage>();
    row.reads_vertices = Stage::reads_vertices;
    row.runs_on_duals = Stage::runs_on_duals;
    row.reads_finest_heights_only = Stage::reads_finest_heights_only;
    row.reads_first_gloss_only = Stage::reads_first_gloss_only;
    row.not_reproduced = detail::declared_not_reproduced<Stage>();
    row.lattice_steps = detail::declared_lattice_steps<Stage>();
    row.set_defaults = [](void* params) { *static_cast<Params*>(params) = {}; };
    return row;
}

/// The row of a stage whose float kernel runs on F; where F is Quad<float> with a double kernel,
/// and one on duals if the stage declares it.
template <class Stage, class F>
StageRow make_stage_row() {
    StageRow row = describe_stage<Stage>();
    row.run = &run_stage<Stage, F>;
    if constexpr (std::is_same_v<F, Quad<float>>) {
        row.run_double = &run_stage<Stage, Quad<double>>;
        if constexpr (Stage::runs_on_duals) row.run_dual = &run_stage<Stage, Quad<Dual>>;
    }
    return row;
}

namespace detail {
/// FNV-1a, 32 bits (Fowler, Noll and Vo).
class Fingerprint {
  public:
    constexpr void add(std::uint64_t number) {
        for (int i = 0; i < 8; ++i) mix(static_cast<unsigned char>(number >> (8 * i)));
    }
    constexpr void add(std::string_view text) {
        for (const char c : text) mix(static_cast<unsigned char>(c));
        add(text.size());
    }
    constexpr std::uint32_t value() const { return hash_; }

  private:
    constexpr void mix(unsigned char byte) { hash_ = (hash_ ^ byte) * 16777619u; }
    std::uint32_t hash_ = 2166136261u;
};
}  // namespace detail

/// Tells apart what stages compiled at different times take for granted. Follows by itself from the
/// values, their order and the sizes of all that a stage is handed; `revision` is raised by hand
/// when a meaning changes and no size does.
inline constexpr std::uint32_t stage_abi_version = [] {
    constexpr std::uint64_t revision = 4;
    detail::Fingerprint print;
    print.add(revision);
    for (const ValueInfo& value : value_table) {
        print.add(value.name);
        print.add(std::uint64_t(value.components) * 4 + std::uint64_t(value.kind) * 2 +
                  std::uint64_t(value.per_light));
    }
    for (const std::size_t size :
         {std::size_t(texture_slot_count), std::size_t(max_lights), sizeof(StageRow),
          sizeof(StageCall), sizeof(ParameterText), sizeof(ValueName), sizeof(FrameUniforms),
          sizeof(LightUniforms), sizeof(MaterialUniforms), sizeof(HeightMaxima),
          sizeof(PrimitiveData), sizeof(PrimitiveFrame), sizeof(PrimitiveVertices),
          sizeof(PlaneSetup), sizeof(EdgeSlopes), sizeof(SampledTexture), sizeof(FetchCounters),
          sizeof(FetchEvent), sizeof(MarchStep)})
        print.add(size);
    return print.value();
}();

}  // namespace quadrel
