#include "conformance/judge/edges.hpp"

#include <algorithm>
#include <cmath>

#include "quadrel/render.hpp"
#include "render/plan/prepared.hpp"
#include "render/ranges/limits.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel::conformance {
namespace {

/// Whether an edge passes a pixel's centre, window coordinates, no farther than `pixels` away.
bool is_beside(const ScreenTriangle& triangle, int x, int y, double pixels) {
    const std::int64_t unit = subpixel_units, cx = x * unit + unit / 2, cy = y * unit + unit / 2;
    return std::ranges::any_of(triangle.edge, [&](const EdgeFunction& edge) {
        const auto here = static_cast<double>(edge(cx, cy));
        const double across = std::fabs(static_cast<double>(edge(cx + unit, cy)) - here) +
                              std::fabs(static_cast<double>(edge(cx, cy + unit)) - here);
        return std::fabs(here) <= pixels * across;
    });
}

}  // namespace

std::set<std::size_t> pixels_beside_edges(const Scene& scene, const std::string& limits) {
    RenderOptions options;
    options.channels = {"A"};
    const PreparedRender prepared = plan_render(scene, options, select_kernels(options));
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    const Film frame{{0, 0, scene.width, scene.height}, {0, 0, scene.width, scene.height}, {}};
    const double snapping = budget_of_limits(limits).snapping;
    std::set<std::size_t> pixels;
    for (const DrawnTriangle& triangle : prepared.geometry.triangles) {
        const PixelRect& b = triangle.screen.bounds;
        const PixelRect around =
            intersect({b.x0 - 1, b.y0 - 1, b.x1 + 1, b.y1 + 1}, {0, 0, scene.width, scene.height});
        for (int y = around.y0; y < around.y1; ++y)
            for (int x = around.x0; x < around.x1; ++x)
                if (is_beside(triangle.screen, x, y, snapping))
                    pixels.insert(frame.index(x, flip_row(viewport, y)));
    }
    return pixels;
}

}  // namespace quadrel::conformance
