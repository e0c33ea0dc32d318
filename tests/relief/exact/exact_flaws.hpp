// Exact searches with errors planted.
#pragma once

#include "quadrel/num/quad.hpp"
#include "quadrel/relief/trace/exact/max_mip.hpp"
#include "quadrel/relief/trace/exact/texel_exact.hpp"
#include "relief/exact/every_cell.hpp"
#include "relief/exact/exact_search.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {

/// texel-exact with its borders moved along the ray.
struct LateBorders : TexelExact {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        for (CellRayAxis<F>* axis : {&search.ray.x, &search.ray.y})
            axis->start = axis->start - sign(axis->rate) * F(0.01f);
        search_every_cell(search);
        search.store();
    }
};

/// texel-exact that crosses both borders at once where they are less than 0.002 apart.
struct SkippedCorners : TexelExact {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        search_every_cell(search, [&](const CellExit<F>& exit) {
            const CellExit<F> next = search.exit(search.cell());
            search.step(search.active & (next.s - exit.s < F(0.002f)), next);
        });
        search.store();
    }
};

/// max-mip with another margin.
template <int thousandths>
struct MarginOf : MaxMip {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        PatchSearch<Io> search(io);
        const HeightPyramid<F> pyramid(*io.template texture<TextureSlot::max_mip>(), search.grid());
        search.ray.margin = F(static_cast<Scalar<F>>(thousandths) / 1000);
        search_pyramid<F>(
            search, pyramid, -1,
            [&](Mask<F> mask, const CellExit<F>& exit, F) { search.test(mask, exit); },
            [](Mask<F>, F) {});
        search.store();
    }
};

/// The walk of all cells with parameters summed up, in T.
template <PlainFloat T>
T accumulating_walk(const oracle::Field& field, const oracle::Ray& ray) {
    const oracle::GridRay grid(field, ray, 0.5L);
    long cell[2] = {long(std::floor(grid.x)), long(std::floor(grid.y))};
    const T start[2] = {T(grid.x), T(grid.y)}, rate[2] = {T(grid.dx), T(grid.dy)};
    T next[2], step[2];
    for (int c = 0; c < 2; ++c) {
        const T border = T(cell[c]) + T(rate[c] > 0);
        next[c] = rate[c] == 0 ? T(2) : (border - start[c]) / rate[c];
        step[c] = rate[c] == 0 ? T(0) : 1 / std::abs(rate[c]);
    }
    for (T s = 0; s < 1;) {
        const int c = next[0] <= next[1] ? 0 : 1;
        const T to = std::min(T(1), next[c]);
        const long i = cell[0], j = cell[1];
        const oracle::Real h[4] = {field.texel(i, j), field.texel(i + 1, j), field.texel(i, j + 1),
                                   field.texel(i + 1, j + 1)};
        if (to > s) {
            const oracle::Hit hit = oracle::meet_patch(h, grid, i, j, s, to);
            if (hit.found) return static_cast<T>(hit.s);
        }
        s = to;
        next[c] += step[c];
        cell[c] += rate[c] > 0 ? 1 : -1;
    }
    return 1;
}

/// A row of the exact searches, or a defective one in its place.
template <PlainFloat T>
StageUnderTest<T> exact(const std::string& row, Planted planted = Planted::none) {
    const auto stage = [&](StageFunction function) {
        return StageUnderTest<T>{row, {}, {}, [function](Batch<T>& batch, const Parameters&) {
                                     static const NoParams none;
                                     batch.run(function, &none);
                                 }};
    };
    const auto after = [&](std::function<void(Batch<T>&)> change) {
        return StageUnderTest<T>{row, {}, std::move(change)};
    };
    using F = Quad<T>;
    switch (planted) {
        case Planted::late_border:
            return stage(run_stage<LateBorders, F>);
        case Planted::corner_cell_skipped:
            return stage(run_stage<SkippedCorners, F>);
        case Planted::leap_without_margin:
            return stage(run_stage<MarginOf<0>, F>);
        case Planted::leap_from_entry:
            return stage(run_stage<MarginOf<-50>, F>);
        case Planted::wrong_wrap:
            return {row, {}, {}, [row](Batch<T>& batch, const Parameters&) {
                        SampledTexture other = *batch.bound(TextureSlot::height);
                        for (Wrap* wrap : {&other.sampler.wrap_u, &other.sampler.wrap_v})
                            *wrap = *wrap == Wrap::repeat ? Wrap::clamp_to_edge : Wrap::repeat;
                        Batch<T> copy = batch;
                        copy.bind(TextureSlot::height, other);
                        copy.run(row);
                        for (int lane = 0; lane < batch.lanes; ++lane)
                            batch.real(Value::hit_s, lane) = copy.real(Value::hit_s, lane);
                    }};
        case Planted::accumulated_borders:
            return after([](Batch<T>& batch) {
                const oracle::Field field(*batch.bound(TextureSlot::height));
                for (int lane = 0; lane < batch.lanes; ++lane)
                    batch.real(Value::hit_s, lane) =
                        accumulating_walk<T>(field, oracle_ray(batch, lane));
            });
        case Planted::grazes_unflagged:
            return after([](Batch<T>& batch) {
                for (int lane = 0; lane < batch.lanes; ++lane)
                    batch.integer(Value::hit_flags, lane) &= ~HitFlag::ambiguous;
            });
        default:
            return {row};
    }
}

}  // namespace quadrel::test
