// Look-ups of ranges: better matches than the texts of sampler.hpp, lod.hpp and cube.hpp.
//
// A look-up gives what any coordinate and any level of detail in their ranges may give, as one
// range. What is too much to look through is all that the map holds.
#pragma once

#include "quadrel/texture/height_sampler.hpp"
#include "quadrel/texture/range/linear_form.hpp"

namespace quadrel {

namespace range_detail {

/// The least and the greatest of all levels and faces, and of the border. Remembered: a thread asks
/// for few maps.
inline const TexelRange& whole_map(const SampledTexture& texture) {
    struct Known {
        const float* texels;
        std::uint64_t maps;
        TexelRange range;
    };
    constexpr int kept = 32;
    static thread_local Known known[kept];
    static thread_local int next = 0;
    const TextureView& view = texture.view;
    const std::uint64_t maps = range_context().maps;
    for (const Known& entry : known)
        if (entry.texels == view.texels && entry.maps == maps) return entry.range;
    Known& entry = known[next++ % kept];
    entry.range = TexelRange::nothing();
    for (int l = 0; l < view.levels; ++l) {
        const float* texel = view.texels + view.offset[l];
        const std::int64_t count = std::int64_t{view.width[l]} * view.height[l] * view.faces;
        for (std::int64_t i = 0; i < count; ++i, texel += view.channels) {
            double value[4] = {0, 0, 0, 1};
            for (int c = 0; c < view.channels; ++c) value[c] = texel[c];
            entry.range.include(value);
        }
    }
    double border[4] = {0, 0, 0, 1};
    for (int c = 0; c < view.channels; ++c) border[c] = texture.sampler.border[c];
    if (has_border(texture.sampler)) entry.range.include(border);
    entry.texels = view.texels;
    entry.maps = maps;
    return entry.range;
}

/// What a level's filter may give over ranges of coordinates, in units of the texture.
inline TexelRange level_range(const SampledTexture& texture, int level, Filter filter,
                              const Ranged& u, const Ranged& v) {
    if (!u.is_bounded() || !v.is_bounded()) return whole_map(texture);
    const LevelTexels texels(texture, level);
    const RealInterval x = texel_coordinates(u.range(), texels.width(), texture.sampler);
    const RealInterval y = texel_coordinates(v.range(), texels.height(), texture.sampler);
    if (std::max(x.magnitude(), y.magnitude()) > coordinate_limit / 2) return whole_map(texture);
    TexelRange range = TexelRange::nothing();
    const bool done = filter == Filter::linear ? include_linear(range, texels, x, y)
                                               : include_nearest(range, texels, x, y);
    return done ? range : whole_map(texture);
}

/// a + t (b - a) for t in a range within [0, 1].
inline TexelRange blended(const TexelRange& a, const TexelRange& b, const RealInterval& t) {
    TexelRange result;
    for (int c = 0; c < 4; ++c) {
        const auto at = [&](double weight, double low, double high) {
            return low + weight * (high - low);
        };
        const double lows[2] = {at(t.lo, a.channel[c].lo, b.channel[c].lo),
                                at(t.hi, a.channel[c].lo, b.channel[c].lo)};
        const double highs[2] = {at(t.lo, a.channel[c].hi, b.channel[c].hi),
                                 at(t.hi, a.channel[c].hi, b.channel[c].hi)};
        result.channel[c] = {std::min(lows[0], lows[1]), std::max(highs[0], highs[1])};
    }
    return result;
}

/// The levels that a range of d, in [0, levels - 1], may select.
template <class LevelRange>
TexelRange range_of_levels(MipFilter mip, const RealInterval& d, const LevelRange& level) {
    TexelRange range = TexelRange::nothing();
    if (mip == MipFilter::none) return level(0);
    if (mip == MipFilter::nearest) {
        for (double l = std::ceil(d.lo + 0.5) - 1; l <= std::floor(d.hi + 0.5); ++l)
            range.include(level(static_cast<int>(l)));
        return range;
    }
    TexelRange fine = level(static_cast<int>(d.lo));
    for (double l = std::floor(d.lo); l <= d.hi; ++l) {
        const RealInterval weight = weights_in(d, l);
        if (weight.hi == 0) {
            range.include(fine);
            break;
        }
        const TexelRange coarse = level(static_cast<int>(l) + 1);
        range.include(blended(fine, coarse, weight));
        fine = coarse;
    }
    return range;
}

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

/// The look-up of a lane; `of(level, filter)` is the range of a level.
template <class LevelRange>
TexelRange look_up(const SampledTexture& texture, int lane, const Ranged& lambda,
                   const LevelRange& of) {
    const SamplerState& s = texture.sampler;
    const RealInterval clamped = clamped_lambda(s, lambda), d = level_of(texture, clamped);
    const bool mips = s.mip != MipFilter::none && texture.view.levels > 1;
    if (is_level_undecided(s, mips, clamped, d))
        range_context().undecided[lane] |= Undecided::mip_level;
    TexelRange range = TexelRange::nothing();
    for (const bool magnified : {true, false}) {
        if (magnified ? clamped.lo > 0 : clamped.hi <= 0) continue;
        const Filter filter = magnified ? s.mag : s.min;
        if (magnified && s.mag == s.min && clamped.hi > 0) continue;  // the other has it, too
        range.include(range_of_levels(mips ? s.mip : MipFilter::none, d,
                                      [&](int level) { return of(level, filter); }));
    }
    return filtered(range);
}

/// The named error that a level of detail moves with in look-ups beside a place: the same gradients
/// have the same level. -1 where the look-up is none of these.
inline int error_of_level(const SampledTexture& texture, const Ranged& u, const Ranged& v,
                          const RealInterval& d) {
    RangeContext& context = range_context();
    constexpr int level_error = 2;
    if (!context.is_place(u.named) || u.part[level_error] != 0 || v.part[level_error] != 0)
        return -1;
    RangeContext::PlaceLevel& level = context.place_level[(u.named - 1) % 4];
    if (level.place != u.named) level = {u.named, texture.view.texels, d};
    const bool same =
        level.texels == texture.view.texels && level.level.lo == d.lo && level.level.hi == d.hi;
    return same ? level_error : -1;
}

/// A look-up beside a place as a linear form; false elsewhere, and where filters or levels do not
/// allow for one.
inline bool form_of_look_up(LinearForm& form, const SampledTexture& texture, const Ranged& u,
                            const Ranged& v, const Ranged& lambda) {
    const SamplerState& s = texture.sampler;
    if (!range_context().is_place(u.named) || u.named != v.named || s.mag != Filter::linear ||
        s.min != Filter::linear)
        return false;
    const bool mips = s.mip != MipFilter::none && texture.view.levels > 1;
    const RealInterval d = mips ? level_of(texture, clamped_lambda(s, lambda)) : RealInterval(0);
    const double first = std::floor(d.lo);
    if ((mips && s.mip == MipFilter::nearest && d.hi > 0) || d.hi > first + 2) return false;
    const int level = static_cast<int>(first);
    LinearForm fine, coarse, coarsest;
    if (!linear_form(fine, LevelTexels(texture, level), u, v)) return false;
    form = fine;
    if (d.hi == first) return true;
    if (!linear_form(coarse, LevelTexels(texture, level + 1), u, v)) return false;
    const bool two = d.hi > first + 1;
    form = blended(fine, coarse, {d.lo - first, std::min(d.hi - first, 1.0)},
                   two ? -1 : error_of_level(texture, u, v, d));
    if (!two) return true;
    if (!linear_form(coarsest, LevelTexels(texture, level + 2), u, v)) return false;
    form = either(form, blended(coarse, coarsest, {0, d.hi - first - 1}, -1));
    return true;
}

inline vec4<Ranges> packet_of(const TexelRange (&lanes)[4]) {
    vec4<Ranges> result;
    for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 4; ++c) result[c].lane[i] = Ranged(lanes[i].channel[c]);
    return result;
}

/// Whether a lane asks at all: what the others get is theirs.
inline bool asks(const SampleContext<Ranges>& context, int lane) {
    return context.active.lane[lane].known().state != RangeTruth::no;
}

inline TexelRange unasked() {
    constexpr double most = std::numeric_limits<double>::infinity();
    const RealInterval all(-most, most);
    return {{all, all, all, all}};
}

}  // namespace range_detail

// ---- Level of detail ----------------------------------------------------------------------------

namespace range_detail {

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

// ---- Look-ups -----------------------------------------------------------------------------------

/// Settled by each look-up itself.
inline MipLevels<Ranges> mip_levels(const SampledTexture&, const LodRecord<Ranges>&) {
    MipLevels<Ranges> levels{};
    levels.blends = true;
    return levels;
}

inline vec4<Ranges> sample_expanded(const SampledTexture& texture,
                                    const SampleContext<Ranges>& context, const vec2<Ranges>& uv,
                                    const LodRecord<Ranges>& lod) {
    using namespace range_detail;
    TexelRange lanes[4];
    for (int i = 0; i < 4; ++i)
        lanes[i] = asks(context, i) ? look_up(texture, i, lod.lambda.lane[i],
                                              [&](int level, Filter filter) {
                                                  return level_range(texture, level, filter,
                                                                     uv.x.lane[i], uv.y.lane[i]);
                                              })
                                    : unasked();
    vec4<Ranges> result = packet_of(lanes);
    for (int i = 0; i < 4; ++i) {
        const Ranged &u = uv.x.lane[i], &v = uv.y.lane[i];
        LinearForm form;
        if (!asks(context, i) || !form_of_look_up(form, texture, u, v, lod.lambda.lane[i]))
            continue;
        for (int c = 0; c < 4; ++c)
            result[c].lane[i] = narrower(form, c, u.named, lanes[i].channel[c]);
    }
    return result;
}
inline vec4<Ranges> sample_expanded(const SampledTexture& texture,
                                    const SampleContext<Ranges>& context, const vec2<Ranges>& uv,
                                    const LodRecord<Ranges>& lod, const MipLevels<Ranges>&) {
    return sample_expanded(texture, context, uv, lod);
}

/// One level, linear, whatever the sampler's filters say.
template <>
class FastHeight<Ranges> {
  public:
    static bool applies(const SampledTexture&) { return false; }
    static bool applies(const SampledTexture&, const MipLevels<Ranges>&) { return false; }
    explicit FastHeight(const SampledTexture& texture, int level = 0)
        : texture_(texture), level_(level) {}
    FastHeight(const SampledTexture& texture, const MipLevels<Ranges>&) : FastHeight(texture) {}

    Ranges operator()(const SampleContext<Ranges>& context, const vec2<Ranges>& uv) const {
        using namespace range_detail;
        Ranges result(Ranged::anything());
        for (int i = 0; i < 4; ++i)
            if (asks(context, i))
                result.lane[i] = Ranged(filtered(level_range(texture_, level_, Filter::linear,
                                                             uv.x.lane[i], uv.y.lane[i]))
                                            .channel[0]);
        return result;
    }

  private:
    const SampledTexture& texture_;
    int level_;
};

/// Anything that the map holds.
inline vec4<Ranges> texture_gather(const SampledTexture& texture, const SampleContext<Ranges>&,
                                   const vec2<Ranges>&, int component = 0) {
    return vec4<Ranges>(Ranges(
        Ranged(range_detail::filtered(range_detail::whole_map(texture)).channel[component])));
}

}  // namespace quadrel
