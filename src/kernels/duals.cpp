// Stages on dual numbers: compiled once, those that declare it.
#include "quadrel/num/dual.hpp"

#include "kernels/table.hpp"
#include "quadrel/quad/stage_list.hpp"
#include "quadrel/relief/stages.hpp"
#include "quadrel/shade/stages.hpp"

namespace quadrel {
namespace {

template <class Stage>
void append(std::vector<KernelRow>& rows) {
    if constexpr (Stage::runs_on_duals)
        rows.push_back({Stage::text.id, &run_stage<Stage, Quad<Dual>>});
}

template <class... S>
void append_list(StageList<S...>, std::vector<KernelRow>& rows) {
    (append<S>(rows), ...);
}

template <class... Lists>
std::vector<KernelRow> rows_of_lists() {
    std::vector<KernelRow> rows;
    (append_list(Lists(), rows), ...);
    return rows;
}

}  // namespace

const KernelTable& dual_kernels() {
    static const std::vector<KernelRow> rows =
        rows_of_lists<QuadStages, FrameStages, OffsetStages, MarchStages, ConeStages, ExactStages,
                      LayerStages, CurvedStages, TableStages, EngineStages, HitStages,
                      SurfaceStages, ShadowStages, OcclusionStages, ShadeStages>();
    static const KernelGroup group{rows.data(), static_cast<std::int32_t>(rows.size())};
    static const ChainGroup no_chains{nullptr, 0};
    static const KernelTable table{kernel_magic, kernel_abi_version, "scalar", 4, sizeof(Dual), 1,
                                   &group,       &no_chains};
    return table;
}

}  // namespace quadrel
