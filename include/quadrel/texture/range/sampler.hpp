// Look-ups of ranges: better matches than the texts of sampler.hpp and cube.hpp.
//
// A look-up gives what any coordinate and any level of detail in their ranges may give, as one
// range.
#pragma once

#include "quadrel/texture/range/level_of_detail.hpp"
#include "quadrel/texture/range/linear_form.hpp"
#include "quadrel/texture/range/map_range.hpp"
#include "quadrel/texture/range/srgb.hpp"

namespace quadrel {

namespace range_detail {

/// With what decoding and filters are off by.
inline TexelRange filtered(const SampledTexture& texture, TexelRange range) {
    for (int c = 0; c < 4; ++c) range.channel[c] = decoded(texture, c, range.channel[c]);
    return filtered(range);
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
    return filtered(texture, range);
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
            result[c].lane[i] = narrower(form, c, u.named, lanes[i].channel[c],
                                         decoding_error(texture, c, greatest_of(form, c)));
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
                result.lane[i] =
                    Ranged(filtered(texture_, level_range(texture_, level_, Filter::linear,
                                                          uv.x.lane[i], uv.y.lane[i]))
                               .channel[0]);
        return result;
    }

  private:
    const SampledTexture& texture_;
    int level_;
};

namespace range_detail {

/// The four texels around a place of level 0, in the order of textureGather: each of any cell that
/// the place may be in; false if these are too many.
inline bool gather_range(TexelRange (&taps)[4], const SampledTexture& texture, const Ranged& u,
                         const Ranged& v) {
    if (!u.is_bounded() || !v.is_bounded()) return false;
    const LevelTexels level(texture, 0);
    const RealInterval x = texel_coordinates(u.range(), level.width(), texture.sampler);
    const RealInterval y = texel_coordinates(v.range(), level.height(), texture.sampler);
    if (std::max(x.magnitude(), y.magnitude()) > coordinate_limit / 2) return false;
    const RealInterval column(std::floor(x.lo - 0.5), std::floor(x.hi - 0.5));
    const RealInterval row(std::floor(y.lo - 0.5), std::floor(y.hi - 0.5));
    if (!((column.width() + 1) * (row.width() + 1) <= most_patches)) return false;
    constexpr int right[4] = {0, 1, 1, 0}, above[4] = {1, 1, 0, 0};
    for (int tap = 0; tap < 4; ++tap) {
        taps[tap] = TexelRange::nothing();
        include_texels(taps[tap], level, {column.lo + right[tap], column.hi + right[tap]},
                       {row.lo + above[tap], row.hi + above[tap]});
    }
    return true;
}

}  // namespace range_detail

inline vec4<Ranges> texture_gather(const SampledTexture& texture,
                                   const SampleContext<Ranges>& context, const vec2<Ranges>& uv,
                                   int component = 0) {
    using namespace range_detail;
    vec4<Ranges> result(Ranges(Ranged::anything()));
    for (int i = 0; i < 4; ++i) {
        if (!asks(context, i)) continue;
        TexelRange taps[4];
        const bool few = gather_range(taps, texture, uv.x.lane[i], uv.y.lane[i]);
        for (int tap = 0; tap < 4; ++tap) {
            const TexelRange& texel = few ? taps[tap] : whole_map(texture);
            result[tap].lane[i] = Ranged(filtered(texture, texel).channel[component]);
        }
    }
    return result;
}

}  // namespace quadrel
