// What searches of cells and hierarchies share: where in the grid each ray is, how it goes on, and
// what it has found. Every search that skips cells goes on in one that a walk of all cells would
// come to, and tests the cells that it stops at by the same code with the same numbers: all of them
// find the same hit, bit for bit.
#pragma once

#include "quadrel/relief/trace/exact/cell_ray.hpp"

namespace quadrel {

/// Cells [low_i, high_i) x [low_j, high_j).
template <Number F>
struct CellBlock {
    Int<F> low_i, low_j, high_i, high_j;
};

/// Where a ray leaves a block of cells.
template <Number F>
struct CellExit {
    F s;               ///< may be beyond 1
    Mask<F> across_x;  ///< through a border in x, on to the next i
};

template <Number F>
struct CellSearch {
    CellRay<F> ray;
    Int<F> i, j;  ///< the cell where each ray is
    Mask<F> active;
    Mask<F> found = Mask<F>(false), met_nan = Mask<F>(false), capped = Mask<F>(false);
    SearchResult<F> result;
    /// Whether the search is to take the steps that its source takes: someone counts them.
    bool counts_steps = true;
    /// Whether a test of a cell takes longer than some steps.
    bool tests_are_costly = false;

    CellSearch(const CellRay<F>& cells, Mask<F> lanes)
        : ray(cells), i(cells.x.first()), j(cells.y.first()), active(lanes & cells.searchable()) {}

    CellBlock<F> cell() const { return {i, j, i + Int<F>(1), j + Int<F>(1)}; }

    CellExit<F> exit(const CellBlock<F>& block) const {
        const F x = ray.x.exit(block.low_i, block.high_i);
        const F y = ray.y.exit(block.low_j, block.high_j);
        return {min(x, y), x <= y};
    }

    /// On to the next cell, out of the one where the ray is; ends at s = 1.
    void step(Mask<F> mask, const CellExit<F>& exit) {
        const Mask<F> moves = end_at_bottom(mask, exit.s);
        i = select(moves & exit.across_x, i + ray.x.step(), i);
        j = select(moves & !exit.across_x, j + ray.y.step(), j);
    }

    /// On to the next cell, out of a block around the ray's; ends at s = 1.
    void leap(Mask<F> mask, const CellBlock<F>& block, const CellExit<F>& exit) {
        const Mask<F> moves = end_at_bottom(mask, exit.s);
        const Int<F> one(1);
        const Int<F> next_i = select(ray.x.forward(), block.high_i, block.low_i - one);
        const Int<F> next_j = select(ray.y.forward(), block.high_j, block.low_j - one);
        // Borders of the other axis that come earlier, and where x is first, at once.
        const Int<F> same_i =
            ray.x.later(i, ray.x.locate(moves & !exit.across_x, exit.s, Mask<F>(true)));
        const Int<F> same_j =
            ray.y.later(j, ray.y.locate(moves & exit.across_x, exit.s, Mask<F>(false)));
        i = select(moves, select(exit.across_x, next_i, same_i), i);
        j = select(moves, select(exit.across_x, same_j, next_j), j);
    }

    /// On to the cell at s, if that is ahead; ends at s = 1. Nothing changes where s is NaN or not
    /// above 0: on a border, the ray's first cell is not left before it is tested.
    void leap_to(Mask<F> mask, F s) {
        const Mask<F> moves = end_at_bottom(mask & (s > F(0)), s);
        i = select(moves, ray.x.later(i, ray.x.locate(moves, s, Mask<F>(true))), i);
        j = select(moves, ray.y.later(j, ray.y.locate(moves, s, Mask<F>(true))), j);
    }

    /// Where the ray enters its cell, at least 0.
    F entry() const { return max(F(0), max(ray.x.entry(i), ray.y.entry(j))); }

    /// From where the ray enters its cell, on a border exactly, to where it leaves or ends.
    PatchRay<F> part_in_cell(const CellExit<F>& exit) const {
        const CellRayAxis<F>&x = ray.x, &y = ray.y;
        const F enters_x = x.entry(i), enters_y = y.entry(j);
        PatchRay<F> part;
        part.s = max(F(0), max(enters_x, enters_y));
        const auto position = [&](const CellRayAxis<F>& axis, Int<F> cell, F enters) {
            const F on_border = select(axis.forward(), F(0), F(1));
            const F inside = clamp(axis.at(part.s) - to_float<F>(cell), F(0), F(1));
            return select(enters == part.s, on_border, inside);
        };
        part.entry = {position(x, i, enters_x), position(y, j, enters_y)};
        part.rate = {x.rate, y.rate};
        part.slack = {x.slack, y.slack};
        part.length = min(exit.s, F(1)) - part.s;
        part.last = exit.s >= F(1);
        return part;
    }

    void hit(Mask<F> mask, F s, F height) {
        result.s = select(mask, s, result.s);
        result.h = select(mask, height, result.h);
        found = found | mask;
        active = active & !mask;
    }

    /// One step more in the lanes that are active. More than `a_cell` for every cell that the ray
    /// can cross, and `more`, would be an error of ours: such lanes end as CAP.
    void count_step(int a_cell, int more) {
        count_in<F>(result.steps, active);
        const F cells = ray.x.most_borders() + ray.y.most_borders() + F(2);
        const Mask<F> over = to_float<F>(result.steps) > cells * F(a_cell) + F(more);
        capped = capped | (active & over);
        active = active & !over;
    }

  private:
    Mask<F> end_at_bottom(Mask<F> mask, F s) {
        const Mask<F> ended = mask & (s >= F(1));
        active = active & !ended;
        return mask & !ended;
    }
};

/// Whether steps or look-ups of a search are asked for, marked or watched. If none are, they may be
/// others than the source's, as long as the hits are the same.
template <class Io>
bool are_steps_counted(const Io& io) {
    return marks_of(io.template context<TextureSlot::height>()) != nullptr ||
           io.call().log != nullptr || io.template wanted<Value::hit_steps>() ||
           io.template wanted<Value::hit_fetches>();
}

/// Stores what was found, with `wrapped` where the hit is in another tile than the fragment.
/// Unsearchable rays are NAN, or CAP at the top; those that end without a hit, `otherwise`.
template <class Io, class F = typename Io::Number>
void store_cell_search(const Io& io, const SearchRay<F>& ray, CellSearch<F>& search,
                       Status otherwise = Status::floor) {
    SearchResult<F>& result = search.result;
    const Mask<F> capped = search.capped | search.ray.too_long;
    result.status =
        select(capped, status_packet<F>(Status::cap),
               search_status<F>(search.found, search.met_nan | search.ray.is_nan, otherwise));
    result.s = select(search.ray.too_long, F(0), result.s);
    const vec2<F> uv = ray.at(result.s);
    const Mask<F> wrapped = (floor(uv.x) != floor(ray.uv.x)) | (floor(uv.y) != floor(ray.uv.y));
    const Mask<F> meets = result.status == status_packet<F>(Status::hit);
    result.flags = result.flags | select(wrapped & meets, Int<F>(HitFlag::wrapped), Int<F>(0));
    store_search(io, ray, result);
}

}  // namespace quadrel
