#include "quadrel/raster/planes.hpp"

#include <algorithm>
#include <array>

#include "quadrel/check.hpp"
#include "quadrel/raster/setup.hpp"
#include "quadrel/raster/snap.hpp"

namespace quadrel {
namespace {

using Order = std::array<int, 3>;

PlaneSetup ordered_setup(const ScreenTriangle& triangle, const Order& order) {
    PlaneSetup setup{};
    for (std::size_t i = 0; i < 3; ++i) {
        setup.order[i] = static_cast<float>(order[i]);
        setup.inverse_w[i] = 1.0f / triangle.vertex[static_cast<std::size_t>(order[i])].w;
    }
    return setup;
}

/// lp_setup_tri.c: a triangle of the other winding has its first two vertices exchanged.
Order llvmpipe_order(const ScreenTriangle& triangle) {
    return signed_area2(triangle.vertex) > 0 ? Order{1, 0, 2} : Order{0, 1, 2};
}

PlaneSetup llvmpipe_setup(const ScreenTriangle& triangle, int samples) {
    const Order order = llvmpipe_order(triangle);
    PlaneSetup setup = ordered_setup(triangle, order);
    const auto at = [&](std::size_t i) -> const ScreenVertex& {
        return triangle.vertex[static_cast<std::size_t>(order[i])];
    };
    const ScreenVertex &v0 = at(0), &v1 = at(1), &v2 = at(2);
    const float dx01 = v0.window_x - v1.window_x, dy01 = v0.window_y - v1.window_y;
    const float dx20 = v2.window_x - v0.window_x, dy20 = v2.window_y - v0.window_y;
    const float inverse_area = 1.0f / (dx01 * dy20 - dy01 * dx20);
    const float deltas[4] = {dx01, dx20, dy01, dy20};
    for (int i = 0; i < 4; ++i) setup.slope[i] = deltas[i] * inverse_area;
    // Pixel coordinates are whole numbers, but for multisampling, where they are centres.
    setup.centre = samples > 1 ? 0.0f : 0.5f;
    setup.origin[0] = v0.window_x - setup.centre;
    setup.origin[1] = v0.window_y - setup.centre;
    return setup;
}

/// SetupRoutine.cpp: "sort by minimum y", then "by maximum w"; where several vertices tie, both of
/// its rotations happen. They begin with the vertex that flat values come from (Renderer.cpp,
/// setBatchIndices), of OpenGL the last one.
Order swiftshader_order(const ScreenTriangle& triangle) {
    Order order{2, 0, 1};
    const auto sort = [&](auto key, auto best) {
        const float k[3] = {key(order[0]), key(order[1]), key(order[2])};
        const float found = best(best(k[0], k[1]), k[2]);
        if (found == k[1]) std::rotate(order.begin(), order.begin() + 1, order.end());
        if (found == k[2]) std::rotate(order.begin(), order.begin() + 2, order.end());
    };
    const auto vertex = [&](int i) -> const ScreenVertex& {
        return triangle.vertex[static_cast<std::size_t>(i)];
    };
    sort([&](int i) { return vertex(i).clip_y; }, [](float a, float b) { return std::min(a, b); });
    sort([&](int i) { return vertex(i).w; }, [](float a, float b) { return std::max(a, b); });
    return order;
}

/// slope: the coefficients in x and y of the values of the first, second and third vertex.
PlaneSetup swiftshader_setup(const ScreenTriangle& triangle) {
    const Order order = swiftshader_order(triangle);
    PlaneSetup setup = ordered_setup(triangle, order);
    const auto at = [&](std::size_t i) -> const ScreenVertex& {
        return triangle.vertex[static_cast<std::size_t>(order[i])];
    };
    const float w1 = at(1).w, w2 = at(2).w;
    const auto from_first = [&](std::size_t i, std::int32_t ScreenVertex::*coordinate) {
        return static_cast<float>(at(i).*coordinate - at(0).*coordinate);
    };
    const float unit = 1.0f / subpixel_units;
    const float x1 = w1 * unit * from_first(1, &ScreenVertex::x);
    const float y1 = w1 * unit * from_first(1, &ScreenVertex::y);
    const float x2 = w2 * unit * from_first(2, &ScreenVertex::x);
    const float y2 = w2 * unit * from_first(2, &ScreenVertex::y);
    const float a = x1 * y2 - x2 * y1;
    const float inverse_a = 1.0f / a, scale = inverse_a * setup.inverse_w[0];
    const float slopes[6] = {(y1 * w2 - y2 * w1) * scale,
                             (x2 * w1 - x1 * w2) * scale,
                             y2 * inverse_a,
                             -x2 * inverse_a,
                             -y1 * inverse_a,
                             x1 * inverse_a};
    if (a != 0) std::copy(std::begin(slopes), std::end(slopes), setup.slope);
    // Half a pixel less: pixel centres are whole numbers.
    setup.origin[0] = static_cast<float>(at(0).x - subpixel_units / 2) * unit;
    setup.origin[1] = static_cast<float>(at(0).y - subpixel_units / 2) * unit;
    return setup;
}

}  // namespace

PlaneSetup plane_setup(Interpolation form, const ScreenTriangle& triangle, int samples) {
    QUADREL_CHECK(form != Interpolation::exact, static_cast<int>(form));
    return form == Interpolation::llvmpipe ? llvmpipe_setup(triangle, samples)
                                           : swiftshader_setup(triangle);
}

}  // namespace quadrel
