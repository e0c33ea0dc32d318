// Runs of a plan's stages that kernels have as chains, and which values still need arrays then.
#pragma once

#include "render/plan/plan.hpp"

namespace quadrel {

/// Finds the longest chains of `table` in the plan, from its first stage on.
void find_chains(MaterialPlan& plan, const KernelTable& table);

/// The links of a chain as they are called. Points into the plan.
std::vector<ChainStage> chain_stages(const MaterialPlan& plan, const PlannedChain& chain);

}  // namespace quadrel
