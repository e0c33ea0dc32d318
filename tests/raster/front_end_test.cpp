// The planted errors that concern set-up, coverage and quads.
#include "raster/support.hpp"

namespace quadrel::test {
namespace {

template <class Change>
auto changed_setup(Change change) {
    return [change](const std::array<glm::dvec4, 3>& clip, const RasterState& state,
                    ScreenTriangle& triangle) {
        const SetupOutcome outcome = set_up_triangle(clip, state, triangle);
        if (outcome == SetupOutcome::drawn) change(triangle, state);
        return outcome;
    };
}

auto with_thresholds(std::int64_t factor, std::int64_t offset) {
    return changed_setup([=](ScreenTriangle& t, const RasterState&) {
        for (EdgeFunction& edge : t.edge) edge.threshold = factor * edge.threshold + offset;
    });
}

auto with_rounding(SnapRounding rounding) {
    return [=](const std::array<glm::dvec4, 3>& clip, RasterState state, ScreenTriangle& triangle) {
        state.snap_rounding = rounding;
        return set_up_triangle(clip, state, triangle);
    };
}

std::int64_t wrap32(std::int64_t x) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(x));
}

using Inside = std::function<bool(const ScreenTriangle&, int x, int y)>;

/// Draws pixel by pixel those that `inside` accepts, ignoring depth.
auto draw_where(Inside inside) {
    return [inside](const ScreenTriangle& t, std::uint32_t index, TileBuffer& tile) {
        const PixelRect pixels = intersect(t.bounds, tile.rect());
        for (int y = pixels.y0; y < pixels.y1; ++y)
            for (int x = pixels.x0; x < pixels.x1; ++x)
                for (int s = 0; s < tile.samples(); ++s)
                    if (inside(t, x, y)) tile.write(x, y, s, 0.5f, index);
    };
}

bool inside_int32(const ScreenTriangle& t, int x, int y) {
    for (const EdgeFunction& e : t.edge)
        if (wrap32(e(x * 256 + 128, y * 256 + 128)) < e.threshold) return false;
    return true;
}

bool block_corner_covered(const ScreenTriangle& t, int x, int y) {
    const int x0 = x & ~7, y0 = y & ~7;
    return coverage_mask(t, x0, y0, 1) | coverage_mask(t, x0 + 7, y0, 1) |
           coverage_mask(t, x0, y0 + 7, 1) | coverage_mask(t, x0 + 7, y0 + 7, 1);
}

auto draw_with_depth(std::function<bool(float, std::uint32_t, float, std::uint32_t)> passes,
                     std::function<float(const ScreenTriangle&, int, int)> depth) {
    return [=](const ScreenTriangle& t, std::uint32_t index, TileBuffer& tile) {
        const PixelRect pixels = intersect(t.bounds, tile.rect());
        for (int y = pixels.y0; y < pixels.y1; ++y)
            for (int x = pixels.x0; x < pixels.x1; ++x) {
                const float z = depth(t, x, y);
                if (coverage_mask(t, x, y, 1) &&
                    passes(z, index, tile.depth(x, y, 0), tile.triangle(x, y, 0)))
                    tile.write(x, y, 0, z, index);
            }
    };
}

float real_depth(const ScreenTriangle& t, int x, int y) {
    return depth_at(t, x * 256 + 128, y * 256 + 128);
}

float weighted_depth(const ScreenTriangle& t, int x, int y, bool perspective) {
    double sum = 0, total = 0;
    for (int i = 0; i < 3; ++i) {
        const double e = double(t.edge[i](x * 256 + 128, y * 256 + 128));
        const double q = perspective ? e / t.vertex[i].w : e;
        sum += q * t.vertex[i].depth;
        total += q;
    }
    return float(sum / total);
}

bool nearer(float z, std::uint32_t, float old, std::uint32_t) { return z < old; }
bool nearer_or_equal(float z, std::uint32_t, float old, std::uint32_t) { return z <= old; }
bool always(float, std::uint32_t, float, std::uint32_t) { return true; }

/// Quads whose first pixel is moved by (dx, dy).
auto shifted_quads(std::function<std::pair<int, int>(const TileBuffer&)> origin) {
    return [origin](const TileBuffer& tile, std::vector<QuadCoverage>& quads) {
        const auto [dx, dy] = origin(tile);
        const PixelRect& r = tile.rect();
        for (int y = r.y0 + dy - 2; y < r.y1; y += 2)
            for (int x = r.x0 + dx - 2; x < r.x1; x += 2) {
                QuadCoverage quad{x, y, no_triangle, {}};
                for (int k = 0; k < 4; ++k)
                    if (r.contains(lane_x(quad, k), lane_y(quad, k)) &&
                        tile.triangle(lane_x(quad, k), lane_y(quad, k), 0) != no_triangle) {
                        quad.triangle = tile.triangle(lane_x(quad, k), lane_y(quad, k), 0);
                        quad.samples[k] = 1;
                    }
                if (quad.triangle != no_triangle) quads.push_back(quad);
            }
    };
}

std::pair<int, int> first_covered(const TileBuffer& tile) {
    int x0 = tile.rect().x1, y0 = tile.rect().y1;
    for (int y = tile.rect().y0; y < tile.rect().y1; ++y)
        for (int x = tile.rect().x0; x < tile.rect().x1; ++x)
            if (tile.triangle(x, y, 0) != no_triangle) {
                x0 = std::min(x0, x);
                y0 = std::min(y0, y);
            }
    return {x0 - tile.rect().x0, y0 - tile.rect().y0};
}

void quads_per_pixel(const TileBuffer& tile, std::vector<QuadCoverage>& quads) {
    std::vector<QuadCoverage> whole;
    collect_quads(tile, whole);
    for (const QuadCoverage& quad : whole)
        for (int k = 0; k < 4; ++k)
            if (quad.samples[k]) quads.push_back(quad);
}

void plant_setup(FrontEnd& front, Planted planted) {
    switch (planted) {
        case Planted::half_away_snapping:
            front.set_up = with_rounding(SnapRounding::half_away);
            break;
        case Planted::inclusive_edges:
            front.set_up = with_thresholds(0, 0);
            break;
        case Planted::exclusive_edges:
            front.set_up = with_thresholds(0, 1);
            break;
        case Planted::bottom_right_rule:
            front.set_up = with_thresholds(-1, 1);
            break;
        case Planted::one_winding_only:
            front.set_up = changed_setup([](ScreenTriangle& t, const RasterState&) {
                for (EdgeFunction& e : t.edge)
                    if (!t.front_facing) e = {-e.a, -e.b, -e.c, e.threshold};
            });
            break;
        case Planted::facing_without_axes:
            front.set_up = changed_setup([](ScreenTriangle& t, const RasterState& state) {
                if (state.viewport.conventions != Conventions::gl) t.front_facing ^= true;
            });
            break;
        case Planted::slivers_dropped:
            front.set_up = [](const std::array<glm::dvec4, 3>& clip, const RasterState& state,
                              ScreenTriangle& t) {
                const SetupOutcome outcome = set_up_triangle(clip, state, t);
                return t.area2 < 256 * 256 ? SetupOutcome::zero_area : outcome;
            };
            break;
        default:
            break;
    }
}

void plant_drawing(FrontEnd& front, Planted planted) {
    switch (planted) {
        case Planted::int32_edges:
            front.draw = draw_where(inside_int32);
            break;
        case Planted::corner_test_only:
            front.draw = draw_where([](const ScreenTriangle& t, int x, int y) {
                return block_corner_covered(t, x, y) && coverage_mask(t, x, y, 1);
            });
            break;
        case Planted::perspective_depth:
            front.draw = draw_with_depth(nearer, [](const ScreenTriangle& t, int x, int y) {
                return weighted_depth(t, x, y, true);
            });
            break;
        case Planted::unclamped_depth:
            front.draw = draw_with_depth(nearer, [](const ScreenTriangle& t, int x, int y) {
                return weighted_depth(t, x, y, false);
            });
            break;
        case Planted::later_wins_ties:
            front.draw = draw_with_depth(nearer_or_equal, real_depth);
            break;
        case Planted::nearest_by_order:
            front.draw = draw_with_depth(always, real_depth);
            break;
        case Planted::quads_from_bounding_box:
            front.collect = shifted_quads(first_covered);
            break;
        case Planted::quads_from_tile:
            front.collect = shifted_quads([](const TileBuffer& tile) {
                return std::pair{tile.rect().x0 % 4 / 2, tile.rect().y0 % 4 / 2};
            });
            break;
        case Planted::quad_once_per_pixel:
            front.collect = quads_per_pixel;
            break;
        default:
            break;
    }
}

}  // namespace

FrontEnd front_end(Planted planted) {
    FrontEnd front;
    plant_setup(front, planted);
    plant_drawing(front, planted);
    return front;
}

}  // namespace quadrel::test
