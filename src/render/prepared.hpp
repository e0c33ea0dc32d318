// A render in two halves: what is settled once (plan, textures, geometry), and drawing.
#pragma once

#include <vector>

#include "quadrel/render.hpp"
#include "render/stage_clock.hpp"
#include "render/tile_renderer.hpp"

namespace quadrel {

/// Everything that a render needs before its first tile. Refers to the scene, which must outlive
/// it; may be drawn any number of times.
struct PreparedRender {
    const Scene* scene;
    Window window;
    std::vector<ChannelSource> channels;
    RenderPlan plan;
    Geometry geometry;
};

/// Checks the options, plans, loads textures and assembles geometry. Throws as `render` does.
PreparedRender prepare_render(const Scene& scene, const RenderOptions& options,
                              const KernelTable& kernels);

/// Draws. Takes threads, tile and progress from `options`; where `times` is given, measures the
/// stage functions and adds to it.
Film draw(const PreparedRender& prepared, const RenderOptions& options,
          StageTimes* times = nullptr);

/// The quads of the prepared window that are to be shaded, in no matter how many tiles.
std::vector<QuadCoverage> visible_quads(const PreparedRender& prepared);

}  // namespace quadrel
