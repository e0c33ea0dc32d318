// A render in two halves: what is settled once (plan, textures, geometry), and drawing.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "quadrel/render.hpp"
#include "render/draw/draw_record.hpp"
#include "render/draw/tile_renderer.hpp"

namespace quadrel {

class GeometryCache;

/// Everything that a render needs before its first tile. Refers to the scene, which must outlive
/// it unless the render is one of a changed copy; may be drawn any number of times.
struct PreparedRender {
    const Scene* scene;
    Window window;
    std::vector<ChannelSource> channels;
    RenderPlan plan;
    Geometry geometry;
    std::vector<bool> used;                ///< materials that have a triangle in the window
    std::shared_ptr<const Scene> changed;  ///< `scene`, where that is not the caller's
};

/// Checks the options, plans and assembles geometry, or takes it from where one is given; loads no
/// texture.
PreparedRender plan_render(const Scene& scene, const RenderOptions& options,
                           const KernelTable& kernels, GeometryCache* geometry = nullptr);

/// plan_render, and loads the textures that the plan reads. Throws as `render` does.
PreparedRender prepare_render(const Scene& scene, const RenderOptions& options,
                              const KernelTable& kernels);

/// Draws. Takes threads, tile and progress from `options`; adds to `record` where it is given. With
/// Recording::counts, times the stage functions and counts.
Film draw(const PreparedRender& prepared, const RenderOptions& options,
          DrawRecord* record = nullptr, Recording recording = Recording::counts);

/// The same into `film`, in the memory of its planes where they are large enough. What it held is
/// lost.
void draw_into(Film& film, const PreparedRender& prepared, const RenderOptions& options,
               DrawRecord* record = nullptr, Recording recording = Recording::counts);

/// What draws what is prepared.
using Drawing = std::function<void(const PreparedRender&, DrawRecord&, Recording)>;

/// A whole render: plans, loads, draws by `drawing`, and hands out summary and statistics where
/// they are asked for. Leaves the geometry in the cache.
void render_by(const Scene& scene, const RenderOptions& options, const Drawing& drawing,
               GeometryCache* geometry = nullptr);

/// Draws by draw_into. `film` and `options` must outlive it.
Drawing drawing_into(Film& film, const RenderOptions& options);

/// The part of render_by that comes before drawing, for the one that follows.
void load_ahead(const Scene& scene, const RenderOptions& options, GeometryCache& geometry);

/// Runs all that `draw` runs once more, without a film, and marks the texels that look-ups touch.
/// Adds to `record` the steps that searches make. Equal for any number of threads and tile size.
TouchedTexels mark_touched(const PreparedRender& prepared, const RenderOptions& options,
                           DrawRecord& record);

/// The plan for people: kernels, what each material runs and reads, and what is left out.
std::string explain(const PreparedRender& prepared);
/// Stages, textures and materials that nothing asked for, a line each.
std::vector<std::string> left_out(const PreparedRender& prepared);

/// The quads of the prepared window that are to be shaded, in no matter how many tiles.
std::vector<QuadCoverage> visible_quads(const PreparedRender& prepared);

}  // namespace quadrel
