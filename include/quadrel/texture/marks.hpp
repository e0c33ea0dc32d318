// Which texels look-ups touch, a bit each, on demand.
//
// The rule: an active lane, helper lanes included, touches every texel of its footprint, those of
// weight 0 too: one texel (nearest) or four (linear) of its finer level, and as many of the coarser
// one where its level of detail has a fraction. Taps that read the border colour touch nothing, nor
// does the corner that a cube map lacks. What a packet computes only because a neighbour needs it
// is not touched, so that the marks do not depend on how wide a packet is.
//
// The functions are out of line and take packets by value, so that a look-up without marks keeps
// its operands in registers.
#pragma once

#include <atomic>
#include <cstdint>

#include "quadrel/texture/filter.hpp"

namespace quadrel {

/// One texture's marks: texel i of the texture (its first float's index over the channels) is bit
/// i % 64 of word i / 64. Threads may share them.
struct TexelMarks {
    std::uint64_t* words;
};

/// Where this look-up is to be marked, or null.
template <Number F>
const TexelMarks* marks_of(const SampleContext<F>& context) {
    return context.counters != nullptr ? context.counters->marks : nullptr;
}

inline void mark_texel(const TexelMarks& marks, std::uint32_t texel) {
    const std::uint64_t bit = std::uint64_t(1) << (texel % 64);
    const std::atomic_ref<std::uint64_t> word(marks.words[texel / 64]);
    if ((word.load(std::memory_order_relaxed) & bit) == 0)
        word.fetch_or(bit, std::memory_order_relaxed);
}

/// Marks the texels that begin at float `index`, of the lanes of `asked`.
template <Number F>
[[gnu::noinline]] void mark_lanes(const TexelMarks& marks, std::int32_t channels, Mask<F> asked,
                                  Int<F> index) {
    std::int32_t first[lanes_of<F>], is_asked[lanes_of<F>];
    store(first, index);
    store(is_asked, select(asked, Int<F>(1), Int<F>(0)));
    for (int lane = 0; lane < lanes_of<F>; ++lane)
        if (is_asked[lane] != 0)
            mark_texel(marks, static_cast<std::uint32_t>(first[lane] / channels));
}

/// Marks the texel at column x and row y of a level.
template <Number F>
void mark_tap(const TexelMarks& marks, const TextureView& view, const LevelGeometry<F>& level,
              Int<F> x, Int<F> y, Mask<F> asked) {
    const Int<F> index = level.offset + (y * level.width + x) * Int<F>(view.channels);
    mark_lanes<F>(marks, view.channels, asked, index);
}

/// Marks a two-dimensional footprint of one level.
template <Number F>
[[gnu::noinline]] void mark_footprint(const TexelMarks& marks, const SampledTexture& texture,
                                      LevelGeometry<F> level, vec2<F> uv, Filter filter,
                                      Mask<F> asked) {
    const auto [x, y] = address(texture, level, uv, filter);
    const auto tap = [&](Int<F> column, Int<F> row, Mask<F> inside) {
        mark_tap<F>(marks, texture.view, level, column, row, asked & inside);
    };
    tap(x.first, y.first, x.first_inside & y.first_inside);
    if (filter == Filter::nearest) return;
    tap(x.second, y.first, x.second_inside & y.first_inside);
    tap(x.first, y.second, x.first_inside & y.second_inside);
    tap(x.second, y.second, x.second_inside & y.second_inside);
}

/// Calls `mark(level, filter, asked)` for each level and filter that a look-up may use, with the
/// lanes that use it.
template <Number F, class Mark>
void for_each_footprint(const SamplerState& sampler, const LevelGeometry<F>& fine,
                        const LevelGeometry<F>& coarse, Mask<F> active, Mask<F> blended,
                        Mask<F> magnified, const Mark& mark) {
    const auto filtered = [&](const LevelGeometry<F>& of, Filter filter, Mask<F> asked) {
        if (when(asked)) mark(of, filter, asked);
    };
    const auto level = [&](const LevelGeometry<F>& of, Mask<F> asked) {
        if (sampler.mag == sampler.min) return filtered(of, sampler.mag, asked);
        filtered(of, sampler.mag, asked & magnified);
        filtered(of, sampler.min, asked & !magnified);
    };
    level(fine, active);
    level(coarse, active & blended);
}

}  // namespace quadrel
