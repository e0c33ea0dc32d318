// What drawing counts, on demand.
#pragma once

#include <cstdint>

#include "quadrel/texture/counters.hpp"
#include "render/stage_clock.hpp"

namespace quadrel {

struct DrawRecord {
    StageTimes stages;
    FetchCounters fetches;
    std::uint64_t quads = 0, covered_lanes = 0, helper_lanes = 0;
};

/// Adds what another thread recorded.
inline void merge(DrawRecord& into, const DrawRecord& from) {
    merge(into.stages, from.stages);
    into.fetches.fetches += from.fetches.fetches;
    into.fetches.nan_coordinates += from.fetches.nan_coordinates;
    into.fetches.huge_coordinates += from.fetches.huge_coordinates;
    into.quads += from.quads;
    into.covered_lanes += from.covered_lanes;
    into.helper_lanes += from.helper_lanes;
}

}  // namespace quadrel
