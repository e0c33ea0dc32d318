// A height field with its wrap modes worked in: the stored grid of texels (texel_grid), so that
// generators see one kind of plane, periodic or not an axis, whatever the mode.
#pragma once

#include <span>
#include <vector>

#include "quadrel/relief/cells.hpp"
#include "quadrel/texture/texture.hpp"

namespace quadrel {

struct HeightPlane {
    /// `height` must outlive it: texels that lie as the plane's do are not copied. Of a map of
    /// several channels one is taken, and that component of the border colour.
    HeightPlane(const Texture& height, const SamplerState& sampler, int channel = 0);
    HeightPlane(const HeightPlane&) = delete;
    HeightPlane& operator=(const HeightPlane&) = delete;

    /// Stored index of any texel index of one axis; most are stored themselves.
    static int wrap(int i, const GridAxis& axis) {
        const int from_first = i - axis.first;
        if (from_first >= 0 && from_first < axis.count) return from_first;
        return stored_index<double>(i, axis);
    }
    /// Stored index of one that is at most one step outside of [0, count).
    static int wrap_step(int stored, const GridAxis& axis) {
        if (stored >= 0 && stored < axis.count) return stored;
        return (stored < 0) == axis.periodic ? axis.count - 1 : 0;
    }
    /// By stored indices.
    float at(int i, int j) const { return heights[static_cast<std::size_t>(j) * grid.u.count + i]; }
    /// Where texel (i, j) of the plane is stored.
    std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(wrap(j, grid.v)) * grid.u.count + wrap(i, grid.u);
    }
    /// By texel indices anywhere in the plane; (0, 0) is the texture's first texel.
    float texel(int i, int j) const { return heights[index(i, j)]; }

    int width, height;  ///< of the texture
    Grid grid;
    std::span<const float> heights;  ///< grid.u.count * grid.v.count, row by row

  private:
    std::vector<float> wrapped_;  ///< what they are where the texture's texels do not serve
};

}  // namespace quadrel
