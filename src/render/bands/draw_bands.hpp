// Drawing whose film is never there as a whole.
#pragma once

#include <filesystem>

#include "film/band_sink.hpp"
#include "render/plan/prepared.hpp"

namespace quadrel {

/// Draws band by band into the sink, as `draw` does into a film; bands are drawn while the sink is
/// at work on others. Throws what the sink throws, and then draws no further. Does not end it.
void draw_bands(const PreparedRender& prepared, const RenderOptions& options, BandSink& sink,
                DrawRecord& record, Recording recording);

/// Renders into the sink that `make` makes once the scene is planned and its textures are loaded,
/// and ends it. Throws as `render` and the sink do; any size of frame is possible.
void render_bands(const Scene& scene, const RenderOptions& options, const BandSinkMaker& make,
                  GeometryCache* geometry = nullptr);

/// Makes the sinks of render_to_exr.
BandSinkMaker to_exr(const std::filesystem::path& file, const Scene& scene,
                     const RenderOptions& options, ExrCompression compression);

}  // namespace quadrel
