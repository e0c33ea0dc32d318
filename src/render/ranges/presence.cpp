#include "render/ranges/presence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

namespace quadrel {
namespace {

/// Of a pixel's square, in its halves.
constexpr int places[][2] = {{0, 0}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
constexpr std::uint8_t all_places = 31;

bool covers(const ScreenTriangle& triangle, std::int64_t x, std::int64_t y) {
    return std::ranges::all_of(
        triangle.edge, [&](const EdgeFunction& edge) { return edge(x, y) >= edge.threshold; });
}

/// Errs towards true, beyond sharp corners.
bool may_touch(const ScreenTriangle& triangle, std::int64_t x, std::int64_t y, std::int64_t reach) {
    return std::ranges::all_of(triangle.edge, [&](const EdgeFunction& edge) {
        return edge(x, y) + reach * (std::abs(edge.a) + std::abs(edge.b)) >= 0;
    });
}

}  // namespace

Presence::Presence(const PixelRect& rect, double snapping)
    : rect_(rect),
      reach_(static_cast<std::int64_t>(std::ceil(snapping * subpixel_units))),
      places_(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height())),
      touched_(places_.size()) {}

std::size_t Presence::index(int x, int y) const {
    return static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
           static_cast<std::size_t>(x - rect_.x0);
}

void Presence::add(const ScreenTriangle& triangle) {
    if (reach_ == 0) return;
    const PixelRect& bounds = triangle.bounds;
    const PixelRect near =
        intersect(rect_, {bounds.x0 - 1, bounds.y0 - 1, bounds.x1 + 1, bounds.y1 + 1});
    for (int y = near.y0; y < near.y1; ++y)
        for (int x = near.x0; x < near.x1; ++x) {
            const std::int64_t u = std::int64_t{x} * subpixel_units + subpixel_units / 2,
                               v = std::int64_t{y} * subpixel_units + subpixel_units / 2;
            const std::size_t i = index(x, y);
            if (!may_touch(triangle, u, v, reach_)) continue;
            touched_[i] = true;
            for (std::size_t k = 0; k < std::size(places); ++k)
                if (covers(triangle, u + reach_ * places[k][0], v + reach_ * places[k][1]))
                    places_[i] |= static_cast<std::uint8_t>(1u << k);
        }
}

bool Presence::is_open(int x, int y) const {
    const std::size_t i = index(x, y);
    return touched_[i] && places_[i] != all_places;
}

}  // namespace quadrel
