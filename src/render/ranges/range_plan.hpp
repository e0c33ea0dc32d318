// Which stages run once more, on ranges, for the channels that ask for them.
#pragma once

#include <optional>
#include <vector>

#include "kernels/ranges.hpp"
#include "quadrel/relief/trace/oracle/first_hit.hpp"
#include "render/plan/plan.hpp"

namespace quadrel {

class InjectedValues;

/// By what a material's fragments are discarded.
struct Discarding {
    bool by_status = false;  ///< those that the search clips
    double below = -1;       ///< those of less opacity; negative: none
    bool any() const { return by_status || below >= 0; }
};

/// Ranges under one budget.
struct RangePlan {
    ErrorBudget budget;
    std::uint64_t maps = 0;  ///< RangeContext::maps
    const RangeTable* table = nullptr;
    std::vector<MaterialPlan> materials;  ///< per material of the scene
    /// Per material and stage: all that is read of it is injected.
    std::vector<std::vector<bool>> known;
    std::vector<int> slots;  ///< arrays that channels show
    /// Texels of all maps that are decoded from sRGB8, once they are loaded.
    std::vector<const float*> srgb_maps;
    /// Per material, how its heights are read as a surface; none where they are no map.
    std::vector<std::optional<oracle::Surface>> surfaces;
    /// Per material; of all none where nobody asks what is undecided.
    std::vector<Discarding> discarding;
    bool certifies = false;  ///< what all rays of a pixel have in common is asked for
};

/// Whether the channel is a range, or says how many there are.
bool is_range(const ChannelSource& channel);

/// What the channels of a set (exact arithmetic, or an implementation's) need; no materials where
/// none asks. `limits`: as RenderOptions has it; empty is `rounding` where
/// nothing but `undecided` asks. A stage of which all that is read is `injected`
/// (or null) need not run on ranges: its values are those that are drawn. Throws UsageError that
/// names the first other one that does not, or what else is in the way.
RangePlan plan_ranges(const Scene& scene, const std::vector<ChannelSource>& channels, RangeSet set,
                      const std::string& limits, const InjectedValues* injected = nullptr);

}  // namespace quadrel
