// Levels of detail of ranges: better matches than the texts of lod.hpp. rho in all forms that the
// budget permits; a run takes a part of what the followed lane's level may be.
#pragma once

#include "quadrel/texture/height_sampler.hpp"
#include "quadrel/texture/range/footprint.hpp"

namespace quadrel {

namespace range_detail {

/// Lambda after the sampler's clamps, of one lane; NaN selects as an infinite level does.
inline RealInterval clamped_lambda(const SamplerState& s, const Ranged& lambda) {
    const RealInterval x =
        lambda.is_bounded() ? lambda.range() : RealInterval(s.lod_min, s.lod_max);
    const auto clamped = [&](double l) {
        return std::max(std::min(l, double(s.lod_max)), double(s.lod_min));
    };
    return {clamped(x.lo), clamped(x.hi)};
}
inline RealInterval level_of(const SampledTexture& texture, const RealInterval& lambda) {
    const double last = texture.view.levels - 1;
    return {std::clamp(lambda.lo, 0.0, last), std::clamp(lambda.hi, 0.0, last)};
}

/// What this run takes of what a lane's level may be: a part of it, where the gradients are those
/// of the lane's first look-up in the map whose levels are gone through part by part. In a map of
/// another size the level of these gradients is as much higher or lower, whatever it is made of,
/// but for the error of either level.
inline RealInterval part_of_levels(const SampledTexture& texture, int lane,
                                   const RealInterval& all) {
    RangeContext& context = range_context();
    RealInterval& first = context.lane_level[lane];
    if (!context.level_known[lane] && context.leveled_map == texture.view.texels) {
        context.level_known[lane] = true;
        first = all;
        context.clamped_level[lane] =
            level_of(texture, clamped_lambda(texture.sampler, Ranged(all)));
    }
    if (!context.level_known[lane] || context.followed != lane) return all;
    constexpr double rounding = 1e-9;
    double higher = all.lo - first.lo;
    if (std::fabs(all.hi - first.hi - higher) > rounding) return all;
    const double whole = std::nearbyint(higher);
    if (std::fabs(higher - whole) <= rounding) higher = whole;
    const double apart = texture.view.texels == context.leveled_map ? 0 : 2 * budget().lod;
    return {std::clamp(context.level_from + higher - apart, all.lo, all.hi),
            std::clamp(context.level_to + higher + apart, all.lo, all.hi)};
}

/// Whether the level, or which filter, depends on rounding.
inline bool is_level_undecided(const SamplerState& s, bool mips, const RealInterval& lambda,
                               const RealInterval& d) {
    if (s.mag != s.min && lambda.lo <= 0 && lambda.hi > 0) return true;
    return mips && s.mip == MipFilter::nearest &&
           std::ceil(d.lo + 0.5) - 1 != std::floor(d.hi + 0.5);
}

inline RealInterval square(const RealInterval& x) {
    const double least = x.has_zero() ? 0 : std::min(std::fabs(x.lo), std::fabs(x.hi));
    return {next_down(least * least), next_up(x.magnitude() * x.magnitude())};
}
inline RealInterval root(const RealInterval& x) {
    return {next_down(std::sqrt(std::max(x.lo, 0.0))), next_up(std::sqrt(std::max(x.hi, 0.0)))};
}
inline RealInterval size_of(const RealInterval& x) {
    return {x.has_zero() ? 0 : std::min(std::fabs(x.lo), std::fabs(x.hi)), x.magnitude()};
}
inline RealInterval larger(const RealInterval& a, const RealInterval& b) {
    return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}

/// rho of one lane's gradients in texels, in all forms that are permitted.
inline RealInterval permitted_rho(LodForm form, const RealInterval (&x)[2],
                                  const RealInterval (&y)[2]) {
    const LodFreedom freedom = budget().lod_freedom;
    const RealInterval square_x = square(x[0]) + square(x[1]),
                       square_y = square(y[0]) + square(y[1]);
    const RealInterval longest = root(larger(square_x, square_y));
    const RealInterval both = root(square_x + square_y);
    if (freedom == LodFreedom::exact)
        return form == LodForm::ellipse ? RealInterval(longest.lo, both.hi) : longest;
    if (freedom == LodFreedom::d3d) return {longest.lo, both.hi};
    const double least =
        std::max(larger(size_of(x[0]), size_of(x[1])).lo, larger(size_of(y[0]), size_of(y[1])).lo);
    const double most =
        std::max(x[0].magnitude() + x[1].magnitude(), y[0].magnitude() + y[1].magnitude());
    const double greatest = freedom == LodFreedom::gl
                                ? std::max(x[0].magnitude(), y[0].magnitude()) +
                                      std::max(x[1].magnitude(), y[1].magnitude())
                                : 0;
    return {least, next_up(std::max(most * 0x1.6a09e667f3bcdp+0, greatest))};
}

/// log2, with what the sampler's form of it is off by; of 0, less than any level.
inline RealInterval level_of_rho(LodForm form, const RealInterval& rho) {
    const auto level = [](double x) { return x < 0x1p-500 ? -500 : log2(x); };
    // A linear mantissa is low by up to 0.0861 of the square's logarithm.
    const double low = form == LodForm::linear_log2 || form == LodForm::quartic_log2 ? 0.0431 : 0;
    return {level(rho.lo) - low - 0x1p-40, level(rho.hi) + 0x1p-40};
}

}  // namespace range_detail

inline ScaleFactor<Ranges> scale_factor(LodForm form, const vec2<Ranges>& dx,
                                        const vec2<Ranges>& dy) {
    using namespace range_detail;
    ScaleFactor<Ranges> result{Ranges(Ranged::anything()), Ranges(Ranged::anything())};
    for (int i = 0; i < 4; ++i) {
        if (!dx.x.lane[i].is_bounded() || !dx.y.lane[i].is_bounded() ||
            !dy.x.lane[i].is_bounded() || !dy.y.lane[i].is_bounded())
            continue;
        const RealInterval x[2] = {dx.x.lane[i].range(), dx.y.lane[i].range()};
        const RealInterval y[2] = {dy.x.lane[i].range(), dy.y.lane[i].range()};
        const RealInterval rho = permitted_rho(form, x, y);
        result.rho.lane[i] = number(rounded(rho, budget().square_root));
        result.log2_rho.lane[i] = Ranged(level_of_rho(form, rho));
    }
    return result;
}

/// Never known: which forms are permitted decides.
inline bool all_magnified(const SampledTexture&, const Gradients<Ranges>&, const Ranges&) {
    return false;
}

/// Each lane's own or lane 0's: look-ups with implicit derivatives may have a level for the quad.
inline LodRecord<Ranges> lod_of_quad(const LodRecord<Ranges>& own) {
    LodRecord<Ranges> lod = own;
    for (Ranges LodRecord<Ranges>::*number : {&LodRecord<Ranges>::rho, &LodRecord<Ranges>::lambda,
                                              &LodRecord<Ranges>::level, &LodRecord<Ranges>::frac})
        for (int i = 1; i < 4; ++i)
            (lod.*number).lane[i] = join((own.*number).lane[i], (own.*number).lane[0]);
    return lod;
}

/// `lambda` is the level before clamps, with what samplers are off by; look-ups clamp it again.
inline LodRecord<Ranges> select_level(const SampledTexture& texture, const Ranges& rho,
                                      const Ranges& lambda) {
    using namespace range_detail;
    const SamplerState& s = texture.sampler;
    const double off = budget().lod + (s.lod_bits > 0 ? std::ldexp(0.5, -s.lod_bits) : 0);
    LodRecord<Ranges> record{rho, lambda, Ranges(0), Ranges(0), RangeMask(false)};
    for (int i = 0; i < 4; ++i) {
        Ranged& raw = record.lambda.lane[i];
        if (raw.is_bounded()) raw = Ranged(part_of_levels(texture, i, widened(raw.range(), off)));
        const RealInterval clamped = clamped_lambda(s, raw), d = level_of(texture, clamped);
        RangeTruth& magnified = record.magnified.lane[i];
        magnified = clamped.hi <= 0  ? RangeTruth(true)
                    : clamped.lo > 0 ? RangeTruth(false)
                                     : RangeTruth(RangeTruth::perhaps);
        if (s.mip == MipFilter::none) continue;
        if (s.mip == MipFilter::nearest) {
            record.level.lane[i] = Ranged(std::ceil(d.lo + 0.5) - 1, std::floor(d.hi + 0.5));
            continue;
        }
        record.level.lane[i] = Ranged(d);
        const double whole = std::floor(d.lo);
        record.frac.lane[i] =
            whole == std::floor(d.hi) ? Ranged(d.lo - whole, d.hi - whole) : Ranged(0.0, 1.0);
    }
    return record;
}

}  // namespace quadrel
