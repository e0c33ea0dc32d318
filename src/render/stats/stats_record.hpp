// How the figures of RenderStats are gathered.
#pragma once

#include "quadrel/stats.hpp"
#include "render/plan/prepared.hpp"

namespace quadrel {

/// Largest resident size of the process so far; 0 where the system cannot tell.
std::uint64_t peak_memory_kib();

/// What the plan settles: kernels, primitives, textures, what is left out.
void record_plan(const PreparedRender& prepared, const RenderOptions& options, RenderStats& stats);

/// What drawing counted.
void record_drawing(const DrawRecord& record, RenderStats& stats);

/// What a marking pass found, after record_plan.
void record_marks(const PreparedRender& prepared, const DrawRecord& record,
                  const TouchedTexels& touched, RenderStats& stats);

}  // namespace quadrel
