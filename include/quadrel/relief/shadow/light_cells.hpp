// The cells that a light's ray crosses on its way out of the relief.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"
#include "quadrel/relief/trace/exact/cell_search.hpp"

namespace quadrel {

/// A walk over the dual cells of level 0 of a map, from the UV of the hit.
template <Number F>
struct LightCells : CellSearch<F> {
    Grid grid;
    vec2<F> start;  ///< where in the first cell, [0, 1]

    LightCells(const LightRay<F>& light, const SampledTexture& map)
        : LightCells(upwards(light), map) {}
    LightCells(const SearchRay<F>& light, const SampledTexture& map)
        : LightCells(light, map, cell_grid(map.view.width[0], map.view.height[0], map.sampler)) {}

    Int<F> stored_i() const { return stored_index<F>(this->i, grid.u); }
    Int<F> stored_j() const { return stored_index<F>(this->j, grid.v); }

    /// Makes s = 1 where the ray, which starts `rise` below the top, leaves the relief. One that
    /// starts there is out.
    void leave_after(F rise) {
        this->active = this->active & (rise > F(0));
        this->ray.x.rate = this->ray.x.rate * rise;
        this->ray.y.rate = this->ray.y.rate * rise;
    }

  private:
    LightCells(const SearchRay<F>& light, const SampledTexture& map, const Grid& cells)
        : CellSearch<F>(make_cell_ray(light, map, cells, 0.5f), light.active),
          grid(cells),
          start(clamp(this->ray.x.start - to_float<F>(this->i), F(0), F(1)),
                clamp(this->ray.y.start - to_float<F>(this->j), F(0), F(1))) {}

    static SearchRay<F> upwards(const LightRay<F>& light) {
        return {light.uv, light.K, F(1), Scalar<F>(0), light.active, Int<F>(0), Int<F>(0)};
    }
};

}  // namespace quadrel
