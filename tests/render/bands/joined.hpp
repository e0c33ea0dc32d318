// Films of the bands that render_in_bands hands out.
#pragma once

#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {

inline Film joined_bands(const Scene& scene, const RenderOptions& options) {
    std::vector<Film> bands;
    render_in_bands(scene, options, [&](const Film& band) { bands.push_back(band); });
    return join(bands);
}

}  // namespace quadrel::render_tests
