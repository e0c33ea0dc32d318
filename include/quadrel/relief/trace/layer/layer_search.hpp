// An exact search of depth layers over the dual cells of level 0. Depths are those of the texels,
// whatever filters the sampler has; its wrap modes hold.
#pragma once

#include "quadrel/relief/trace/exact/recorded_look_ups.hpp"
#include "quadrel/relief/trace/layer/solid.hpp"

namespace quadrel {

/// The layers of a cell: front, back, second front, second back.
template <Number F>
struct CellLayers {
    CellHeights<F> layer[4];
};

/// Of stored cell (i, j), both in [0, count) of their axis. `cells` is cell_grid of level 0.
template <Number F>
CellLayers<F> cell_layers(const SampledTexture& map, const Grid& cells, Int<F> i, Int<F> j) {
    const TextureView& view = map.view;
    const SamplerState& sampler = map.sampler;
    const auto x = cell_texels<F>(i, cells.u, view.width[0], sampler.wrap_u);
    const auto y = cell_texels<F>(j, cells.v, view.height[0], sampler.wrap_v);
    const auto texel = [&](Int<F> column, Int<F> row, Mask<F> inside) {
        const vec4<F> depths = all_channels<F>(view, column, row, Int<F>(0));
        if (!has_border(sampler)) return depths;
        const float* const border = sampler.border;
        const vec4<F> outside{F(border[0]), F(border[1]), F(border[2]), F(border[3])};
        return select(inside, depths, layer_depths(map, outside));
    };
    const vec4<F> d00 = texel(x.first, y.first, x.first_inside & y.first_inside);
    const vec4<F> d10 = texel(x.second, y.first, x.second_inside & y.first_inside);
    const vec4<F> d01 = texel(x.first, y.second, x.first_inside & y.second_inside);
    const vec4<F> d11 = texel(x.second, y.second, x.second_inside & y.second_inside);
    CellLayers<F> layers;
    for (int layer = 0; layer < 4; ++layer)
        layers.layer[layer] = {d00[layer], d10[layer], d01[layer], d11[layer]};
    return layers;
}

/// Where a part of a ray first is inside of a solid.
template <Number F>
struct LayerMeeting {
    F tau, depth;  ///< where `hit`; depth is the layer's there
    Mask<F> hit, ambiguous, not_finite;
};

/// Goes through the first `layers` of a cell, pair by pair.
template <int layers, Number F>
LayerMeeting<F> meet_layers(const CellLayers<F>& cell, const PatchRay<F>& part,
                            const RayDepth<F>& ray, bool tells_grazes) {
    const F never(std::numeric_limits<Scalar<F>>::infinity());
    LayerMeeting<F> meeting{never, F(1), Mask<F>(false), Mask<F>(false), Mask<F>(false)};
    for (int layer = 0; layer < layers; layer += 2) {
        const CellHeights<F>&front = cell.layer[layer], &back = cell.layer[layer + 1];
        const F sum = (front.h00 + front.h10) + (front.h01 + front.h11) +
                      ((back.h00 + back.h10) + (back.h01 + back.h11));
        meeting.not_finite = meeting.not_finite | !is_finite(sum);
        const SolidQuadratics<F> solid = solid_quadratics(front, back, part, ray);
        const SolidEntry<F> entry = enter_solid(solid, part.length);
        const Mask<F> nearer = entry.hit & (entry.tau < meeting.tau);
        const vec2<F> at = clamp(part.entry + part.rate * entry.tau, F(0), F(1));
        const F depth = select(entry.front, patch_height(front, at), patch_height(back, at));
        meeting.tau = select(nearer, entry.tau, meeting.tau);
        meeting.depth = select(nearer, depth, meeting.depth);
        meeting.hit = meeting.hit | nearer;
        if (tells_grazes) {
            const F error = solid_error(front, back, part.slack);
            const Mask<F> grazed = is_solid_grazed(solid, part.length, error, meeting.tau);
            meeting.ambiguous = meeting.ambiguous | (is_solid(front, back) & grazed);
        }
    }
    meeting.hit = meeting.hit & !meeting.not_finite;
    return meeting;
}

/// Of the first `layers`.
template <class Io, int layers>
class LayerSearch : public CellSearch<typename Io::Number> {
  public:
    using F = typename Io::Number;

    explicit LayerSearch(const Io& io) : LayerSearch(io, search_ray(io), layer_map(io)) {}

    const Grid& grid() const { return grid_; }

    /// Tests the cells where the rays are. Out of line: a search has one copy.
    [[gnu::noinline]] void test(Mask<F> mask, const CellExit<F>& exit) {
        const CellLayers<F> cell = cell_layers<F>(map_, grid_, stored_index<F>(this->i, grid_.u),
                                                  stored_index<F>(this->j, grid_.v));
        const PatchRay<F> part = this->part_in_cell(exit);
        const CellHeights<F>& front = cell.layer[0];
        record_cell<TextureSlot::layers>(io_, *this, fragment_, map_, mask, part.s, front,
                                         F(1) - patch_height(front, part.entry));
        const auto meeting = meet_layers<layers, F>(cell, part, {part.s, F(1)}, tells_grazes_);
        this->met_nan = this->met_nan | (mask & meeting.not_finite);
        this->result.flags = this->result.flags | select(mask & meeting.ambiguous,
                                                         Int<F>(HitFlag::ambiguous), Int<F>(0));
        const F leaves = min(exit.s, F(1));
        this->hit(mask & meeting.hit, min(part.s + meeting.tau, leaves), F(1) - meeting.depth);
    }

    /// Counts a look-up in the pyramid of bounds, and shows a probe the depth that it gave.
    void record_node(Mask<F> mask, F depth) {
        quadrel::record_node<TextureSlot::layer_bounds>(io_, *this, fragment_, mask, F(1) - depth);
    }

    /// A ray that meets nothing is a miss.
    void store() { store_cell_search(io_, fragment_, *this, Status::clip); }

  private:
    LayerSearch(const Io& io, const SearchRay<F>& fragment, const SampledTexture& map)
        : LayerSearch(io, fragment, map,
                      cell_grid(map.view.width[0], map.view.height[0], map.sampler)) {}
    LayerSearch(const Io& io, const SearchRay<F>& fragment, const SampledTexture& map,
                const Grid& grid)
        : CellSearch<F>(make_cell_ray(fragment, map, grid, 0.5f), fragment.active),
          io_(io),
          fragment_(fragment),
          map_(map),
          grid_(grid) {}

    const Io& io_;
    SearchRay<F> fragment_;
    const SampledTexture& map_;
    Grid grid_;
    bool tells_grazes_ = io_.template wanted<Value::hit_flags>();
};

}  // namespace quadrel
