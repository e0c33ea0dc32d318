#include "render/ranges/presence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace quadrel {
namespace {

constexpr std::uint8_t all_corners = 15;

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
      corners_(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height())),
      touched_(corners_.size()) {}

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
            for (int corner = 0; corner < 4; ++corner)
                if (covers(triangle, u + (corner % 2 == 0 ? -reach_ : reach_),
                           v + (corner / 2 == 0 ? -reach_ : reach_)))
                    corners_[i] |= static_cast<std::uint8_t>(1u << corner);
        }
}

bool Presence::is_open(int x, int y, bool covered) const {
    if (reach_ == 0) return false;
    const std::size_t i = index(x, y);
    return covered ? corners_[i] != all_corners : touched_[i];
}

}  // namespace quadrel
