// Which stages run once more, on dual numbers, for the exact derivatives that channels ask for.
#pragma once

#include <vector>

#include "render/plan/plan.hpp"

namespace quadrel {

/// Whether the channel is an exact derivative, or a difference from one.
bool is_exact(const ChannelSource& channel);

/// The values that an exact channel's derivative is made of. A level of detail follows from uv.
std::vector<Value> differentiated(const ChannelSource& channel);

/// The stages of a material that store `wanted`, on dual numbers. Throws UsageError that names
/// `asked`, what asks for them, and the first of them that does not run on dual numbers.
MaterialPlan plan_on_duals(const Scene& scene, const Material& material,
                           const std::vector<Value>& wanted, const std::string& asked);

/// What the channels' exact derivatives need of each of the scene's materials; empty where no
/// channel asks for one. Throws UsageError as plan_on_duals does.
std::vector<MaterialPlan> plan_exact(const Scene& scene,
                                     const std::vector<ChannelSource>& channels);

}  // namespace quadrel
