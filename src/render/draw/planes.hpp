// The planes of films that are drawn into.
#pragma once

#include <cstdint>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/raster/viewport.hpp"
#include "quadrel/scene/scene.hpp"
#include "render/plan/channel_source.hpp"

namespace quadrel {

/// Throws InputError where a film of the window would be larger than a reader of EXR files takes:
/// 2^31 values, 8 GB.
void check_film_size(const Scene& scene, const Window& window, std::size_t channels);

/// Bits of each plane where nothing is drawn.
std::vector<std::uint32_t> undrawn_bits(const Scene& scene,
                                        const std::vector<ChannelSource>& channels);

/// Names the planes, which have no values yet.
void name_planes(Film& film, const Scene& scene, const Window& window,
                 const std::vector<ChannelSource>& channels);

/// Makes the planes, in the memory that the film has where it is large enough. Where it has as many
/// planes of that size already they keep what they hold, for tiles to clear; else they become
/// `undrawn`, on the arena's threads. Whether they did.
bool make_planes(Film& film, const Scene& scene, const Window& window,
                 const std::vector<ChannelSource>& channels,
                 const std::vector<std::uint32_t>& undrawn);

/// The window in window coordinates, grown to whole quads.
PixelRect quad_rect(const Viewport& viewport, const Window& window);

}  // namespace quadrel
