// steep-maxmip: linear search that cannot miss: each step against the greatest height of the cells
// that it crosses.
//
// The guarantee that McGuire and McGuire 2005 seek in coarser mip levels, with the maximum pyramid
// of Tevs, Ihrke, Seidel 2008 in place of averages. The level of a lane is the finest whose nodes
// are as long as a step on either axis, so that a step touches two nodes an axis (three where it
// runs over the rest of a tile into the next); the greatest of their heights bounds the bilinear
// field over the step. The first step whose end is not above that bound holds the result,
// s = 1 - bound: never later than the first crossing, however thin, but early where the crossing is
// elsewhere in the nodes, and HIT then too. No such step: FLOOR.
#pragma once

#include "quadrel/relief/cells.hpp"
#include "quadrel/relief/trace/search/search.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

/// Greatest heights around the steps of a march, from a map of BakeKind::max_mip.
template <Number F>
class StepBounds {
  public:
    /// For steps of `step` in UV over `height`.
    StepBounds(const SampledTexture& pyramid, const SampledTexture& height, const vec2<F>& step)
        : view_(pyramid.view),
          grid_(cell_grid(height.view.width[0], height.view.height[0], height.sampler)),
          columns_(static_cast<Scalar<F>>(height.view.width[0])),
          rows_(static_cast<Scalar<F>>(height.view.height[0])) {
        const F cells = max(abs(step.x) * columns_, abs(step.y) * rows_);
        // A step as long as a node but for rounding counts as longer.
        const F level = ceil(log2(max(cells * F(1 + 0x1p-20f), F(1))));
        level_ = min(to_int(level), Int<F>(view_.levels - 1));
        size_ = power_of_two(to_float<F>(level_));
    }

    /// Look-ups that one bound takes.
    static constexpr int fetches = 9;

    /// At least the height of every point between two that are a step apart, by an ulp or more.
    F operator()(const vec2<F>& from, const vec2<F>& to) const {
        const Touched x = touched(cell(from.x, columns_), cell(to.x, columns_), grid_.u);
        const Touched y = touched(cell(from.y, rows_), cell(to.y, rows_), grid_.v);
        const Int<F> width = gather_int<F>(view_.width, level_);
        const Int<F> height = gather_int<F>(view_.height, level_);
        F bound(-std::numeric_limits<Scalar<F>>::infinity());
        for (const Int<F>& row : y.nodes) {
            for (const Int<F>& column : x.nodes) {
                const F node = first_channel<F>(view_, min(column, width - Int<F>(1)),
                                                min(row, height - Int<F>(1)), level_);
                bound = select(is_nan(node), node, max(bound, node));
            }
        }
        return bound + abs(bound) * F(0x1p-22f);
    }

  private:
    struct Touched {
        std::array<Int<F>, 3> nodes;
    };

    static Int<F> cell(F u, F texels) {
        constexpr float limit = 8388608;
        const F x = floor(u * texels - F(0.5f));
        return to_int(clamp(x, F(-limit), F(limit)));
    }
    Int<F> node(Int<F> stored) const { return to_int(floor(to_float<F>(stored) / size_)); }

    Touched touched(Int<F> from, Int<F> to, const GridAxis& axis) const {
        const Int<F> a = stored_index<F>(from, axis), b = stored_index<F>(to, axis);
        // Into another tile: its neighbour's last node may be shorter than the step.
        const Mask<F> leaves = (from - a) != (to - b);
        const Mask<F> periodic = leaves & Mask<F>(axis.periodic);
        return {{node(a), node(b), select(periodic, node(Int<F>(axis.count - 1)), node(a))}};
    }

    const TextureView& view_;
    Grid grid_;
    F columns_, rows_, size_;
    Int<F> level_;
};

struct SteepMaxmip : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"steep-maxmip", "trace",
                                    "linear search against the greatest height of each step",
                                    "McGuire and McGuire 2005; Tevs, Ihrke, Seidel 2008"};
    static constexpr auto inputs = search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::max_mip);
    static constexpr bool needs_height_map = true;
    struct Params {
        std::int32_t steps = 64;
    };
    static constexpr std::array parameters{parameter<&Params::steps>(
        "steps", "1", "steps over the relief's depth", 1, most_steps, 64)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F n = number<F>(params.steps);
        const StepBounds<F> bounds(*io.template texture<TextureSlot::max_mip>(),
                                   *io.template texture<TextureSlot::height>(), ray.K / n);
        SearchResult<F> result;
        Mask<F> active = ray.active, found(false), met_nan(false);
        for (const auto k : steps<F>(0, params.steps - 1)) {
            const F s = number<F>(k) / n, end = number<F>(k + 1) / n;
            const F bound = bounds(ray.at(s), ray.at(end));
            const auto context = io.template context<TextureSlot::max_mip>(active);
            for (int i = 0; i < bounds.fetches; ++i) count_fetch(context);
            io.march_step(active, s, ray.at(s), F(1) - s, bound);
            count_in<F>(result.steps, active);
            met_nan = met_nan | (active & is_nan(bound));
            const Mask<F> reached = active & (bound >= F(1) - end);
            result.s = select(reached, max(s, F(1) - bound), result.s);
            result.h = select(active, bound, result.h);
            found = found | reached;
            active = active & !reached;
            if (none(active)) break;
        }
        result.status = search_status<F>(found, met_nan);
        result.fetches = result.steps * Int<F>(bounds.fetches);
        store_search(io, ray, result);
    }
};

}  // namespace quadrel
