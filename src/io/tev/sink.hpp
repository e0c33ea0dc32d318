// Tiles to tev as they are drawn.
#pragma once

#include <memory>
#include <string>

#include "film/band_sink.hpp"
#include "io/tev/connection.hpp"

namespace quadrel {

/// Creates the image `name` of the layout's window there; then sends the tiles of each row of tiles
/// once that is drawn. `connection` must outlive it.
std::unique_ptr<BandSink> tev_sink(TevConnection& connection, const std::string& name,
                                   const Film& layout);

/// Sends the tiles of a part of a film, which is of the window that the image was created for.
void send_to_tev(TevConnection& connection, const std::string& name, const Film& film,
                 const Window& part, const Window& whole);

}  // namespace quadrel
