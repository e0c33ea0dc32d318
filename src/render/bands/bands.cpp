#include "render/bands/bands.hpp"

#include <algorithm>

#include "render/draw/planes.hpp"

namespace quadrel {
namespace {

/// Rows of pixels, unless tiles have more: enough for a chunk of any compression.
constexpr int least_rows = 64;

int band_rows(int tile) { return (least_rows + tile - 1) / tile * tile; }

std::vector<Band> cut(const PixelRect& area, const Viewport& viewport, const Window& window,
                      int rows) {
    std::vector<Band> bands;
    for (int y = area.y0 / rows * rows; y < area.y1; y += rows) {
        const PixelRect part = intersect(area, {area.x0, y, area.x1, y + rows});
        const PixelRect image = flip_rect(viewport, part);
        bands.push_back(
            {part,
             {window.x0, std::max(image.y0, window.y0), window.x1, std::min(image.y1, window.y1)},
             {}});
    }
    return bands;
}

/// Adds each triangle to the bands, which lie in window order.
void add_triangles(const Geometry& geometry, const PixelRect& area, int rows,
                   std::vector<Band>& bands) {
    const int first = area.y0 / rows;
    for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
        const PixelRect bounds = intersect(area, geometry.triangles[t].screen.bounds);
        if (bounds.empty()) continue;
        for (int band = bounds.y0 / rows; band <= (bounds.y1 - 1) / rows; ++band)
            bands[static_cast<std::size_t>(band - first)].triangles.push_back(t);
    }
}

}  // namespace

std::vector<Band> make_bands(const PreparedRender& prepared, int tile) {
    const Scene& scene = *prepared.scene;
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    const PixelRect area = quad_rect(viewport, prepared.window);
    const int rows = band_rows(tile);
    std::vector<Band> bands = cut(area, viewport, prepared.window, rows);
    add_triangles(prepared.geometry, area, rows, bands);
    if (bands.front().window.y0 > bands.back().window.y0) std::reverse(bands.begin(), bands.end());
    return bands;
}

}  // namespace quadrel
