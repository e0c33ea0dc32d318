// Two-dimensional look-ups, as in GLSL. One-channel textures give (r, 0, 0, 1), two-channel ones
// (r, g, 0, 1). On plain floats and doubles, too; where gradients are implicit, on quads alone.
//
//     using namespace quadrel;
//     const float checks[] = {0, 1, 1, 0};                    // texels of one's own, row by row
//     SamplerState sampler;
//     sampler.mag = Filter::nearest;
//     const SampledTexture t = texture_of_texels(checks, 2, 2, sampler);  // texture/of_texels.hpp
//     texture_lod(t, {}, vec2<float>(0.75f, 0.25f), 0.0f);    // (1, 0, 0, 1)
//
//     // an image with its mip levels (texture/texture.hpp, with the library)
//     const auto bricks = make_texture(load_image("bricks.png"), {.srgb = true});
//     texture_lod({bricks->view(), sampler}, {}, vec2<double>(0.5, 0.5), 1.5);
#pragma once

#include "quadrel/num/derivative.hpp"
#include "quadrel/texture/fetch_log.hpp"
#include "quadrel/texture/filter.hpp"
#include "quadrel/texture/lod.hpp"
#include "quadrel/texture/marks.hpp"

namespace quadrel {

/// Missing components: 0, and 1 for alpha.
template <int channels, Number F>
vec4<F> expand(const Texel<channels, F>& texel) {
    const auto component = [&](int c, float missing) {
        return c < channels ? texel.channel[c < channels ? c : 0] : F(missing);
    };
    return {component(0, 0), component(1, 0), component(2, 0), component(3, 1)};
}

/// Calls `body` with the channel count of a texture (1, 2 or 4) as a compile-time constant.
template <class Body>
auto with_channels(int channels, const Body& body) {
    if (channels == 1) return body(std::integral_constant<int, 1>());
    if (channels == 2) return body(std::integral_constant<int, 2>());
    return body(std::integral_constant<int, 4>());
}

/// Picks between magnification and minification where the sampler's two filters differ.
/// `nearest` and `linear` are called at most once each.
template <int channels, Number F, class Nearest, class Linear>
Texel<channels, F> choose_filter(const SamplerState& sampler, Mask<F> magnified,
                                 const Nearest& nearest, const Linear& linear) {
    if (sampler.mag == sampler.min) {
        return sampler.mag == Filter::nearest ? nearest() : linear();
    }
    const Mask<F> is_linear = sampler.mag == Filter::linear ? magnified : !magnified;
    return select(is_linear, linear(), nearest());
}

/// One level, filtered.
template <int channels, Number F>
Texel<channels, F> sample_level(const SampledTexture& texture, const LevelGeometry<F>& level,
                                const vec2<F>& uv, Mask<F> magnified) {
    return choose_filter<channels, F>(
        texture.sampler, magnified, [&] { return sample_nearest<channels, F>(texture, level, uv); },
        [&] { return sample_linear<channels, F>(texture, level, uv); });
}

/// The levels that a record selects; settled once for all look-ups of a march.
template <Number F>
struct MipLevels {
    LevelGeometry<F> fine, coarse;
    bool blends;  ///< false: `fine` alone counts
};

template <Number F>
MipLevels<F> mip_levels(const SampledTexture& texture, const LodRecord<F>& lod) {
    if (texture.sampler.mip == MipFilter::none || texture.view.levels == 1) {
        const LevelGeometry<F> only = level_geometry<F>(texture.view, 0);
        return {only, only, false};
    }
    const Int<F> finer = to_int(lod.level);
    const LevelGeometry<F> fine = level_geometry<F>(texture.view, finer);
    // Where no lane blends, the coarser level cannot change the result: its weight is 0.
    if (texture.sampler.mip == MipFilter::nearest || none(lod.frac > F(0))) {
        return {fine, fine, false};
    }
    const Int<F> coarser = min(finer + Int<F>(1), Int<F>(texture.view.levels - 1));
    return {fine, level_geometry<F>(texture.view, coarser), true};
}

/// Blends two levels that `sample(level)` filters, or takes one, as the mip filter says.
template <int channels, Number F, class Sample>
Texel<channels, F> sample_mips(const MipLevels<F>& levels, const LodRecord<F>& lod,
                               const Sample& sample) {
    const auto fine = sample(levels.fine);
    if (!levels.blends) return fine;
    const auto coarse = sample(levels.coarse);
    return select(lod.frac > F(0), lerp(fine, coarse, lod.frac), fine);
}

/// Whether a look-up's state is the commonest but for levels: one wrap mode for both axes, linear
/// within a level, no hardware's rounding.
inline bool is_common(const SamplerState& s, Wrap wrap) {
    return s.wrap_u == wrap && s.wrap_v == wrap && s.mag == Filter::linear &&
           s.min == Filter::linear && s.weight_bits == 0 && s.scale_first == 0;
}

/// sample_texture of such a state, which is a constant here. Out of line: one copy of it.
template <Wrap wrap, Number F>
[[gnu::noinline]] Texel<4, F> sample_common(const SampledTexture& texture, const vec2<F>& uv,
                                            F weight, const MipLevels<F>& levels) {
    static constexpr SamplerState state{.wrap_u = wrap, .wrap_v = wrap};
    const auto footprint = [&](const LevelGeometry<F>& l) -> Footprint<F> {
        return {address_axis(uv.x, l.width, l.width_number, wrap, Filter::linear, state),
                address_axis(uv.y, l.height, l.height_number, wrap, Filter::linear, state)};
    };
    Texel<4, F> result;
    const Footprint<F> at = footprint(levels.fine);
    const TapIndices<4, F> fine(levels.fine, at);
    if (!levels.blends) {
        PacketOps<F>::bilinear4(texture.view.texels, fine.tap, at.x.weight, at.y.weight,
                                result.channel);
        return result;
    }
    const Footprint<F> coarse_at = footprint(levels.coarse);
    const TapIndices<4, F> coarse(levels.coarse, coarse_at);
    PacketOps<F>::trilinear4(texture.view.texels, fine.tap, at.x.weight, at.y.weight, coarse.tap,
                             coarse_at.x.weight, coarse_at.y.weight, weight, result.channel);
    return result;
}

/// sample_texture of any state. Out of line, too: all filters and wrap modes are much code.
template <int channels, Number F>
[[gnu::noinline]] Texel<channels, F> sample_any(const SampledTexture& texture, const vec2<F>& uv,
                                                const LodRecord<F>& lod,
                                                const MipLevels<F>& levels) {
    return sample_mips<channels, F>(levels, lod, [&](const LevelGeometry<F>& level) {
        return sample_level<channels, F>(texture, level, uv, lod.magnified);
    });
}

/// The filtered texel for a record of compute_lod or lod_from_level, and its levels.
template <int channels, Number F>
Texel<channels, F> sample_texture(const SampledTexture& texture, const vec2<F>& uv,
                                  const LodRecord<F>& lod, const MipLevels<F>& levels) {
    if constexpr (channels == 4 && requires { &PacketOps<F>::trilinear4; }) {
        if (is_common(texture.sampler, Wrap::repeat))
            return sample_common<Wrap::repeat, F>(texture, uv, lod.frac, levels);
        if (is_common(texture.sampler, Wrap::clamp_to_edge))
            return sample_common<Wrap::clamp_to_edge, F>(texture, uv, lod.frac, levels);
    }
    return sample_any<channels, F>(texture, uv, lod, levels);
}

/// Marks what sample_texture touches.
template <Number F>
[[gnu::noinline]] void mark_look_up(const TexelMarks& marks, const SampledTexture& texture,
                                    vec2<F> uv, LodRecord<F> lod, MipLevels<F> levels,
                                    Mask<F> active) {
    const Mask<F> blended = Mask<F>(levels.blends) & (lod.frac > F(0));
    for_each_footprint<F>(texture.sampler, levels.fine, levels.coarse, active, blended,
                          lod.magnified,
                          [&](const LevelGeometry<F>& level, Filter filter, Mask<F> asked) {
                              mark_footprint<F>(marks, texture, level, uv, filter, asked);
                          });
}

template <Number F>
vec4<F> sample_expanded(const SampledTexture& texture, const SampleContext<F>& context,
                        const vec2<F>& uv, const LodRecord<F>& lod, const MipLevels<F>& levels) {
    count_fetch(context);
    count_coordinate(context, uv.x, F(coordinate_limit));
    count_coordinate(context, uv.y, F(coordinate_limit));
    if (const TexelMarks* marks = marks_of(context))
        mark_look_up<F>(*marks, texture, uv, lod, levels, context.active);
    const vec4<F> value = with_channels(texture.view.channels, [&](auto channels) {
        return expand(sample_texture<channels(), F>(texture, uv, lod, levels));
    });
    log_fetch(context, texture, uv, lod, value);
    return value;
}

template <Number F>
vec4<F> sample_expanded(const SampledTexture& texture, const SampleContext<F>& context,
                        const vec2<F>& uv, const LodRecord<F>& lod) {
    return sample_expanded(texture, context, uv, lod, mip_levels(texture, lod));
}

/// Level from the gradients dx and dy of uv (per pixel). `out`, if given, receives the record.
template <Number F>
vec4<F> texture_grad(const SampledTexture& texture, const SampleContext<F>& context,
                     const vec2<F>& uv, const vec2<F>& dx, const vec2<F>& dy,
                     LodRecord<F>* out = nullptr) {
    const LodUse use = out != nullptr ? LodUse::shown : lod_use(context);
    const LodRecord<F> lod = lod_for(use, texture, dx, dy);
    if (out != nullptr) *out = lod;
    return sample_expanded(texture, context, uv, lod);
}

/// Level of detail given, 0 the finest; the sampler's bias and clamps apply.
template <Number F>
vec4<F> texture_lod(const SampledTexture& texture, const SampleContext<F>& context,
                    const vec2<F>& uv, std::type_identity_t<F> lod) {
    return sample_expanded(texture, context, uv, lod_from_level(texture, lod));
}

/// Implicit gradients: each lane's own, or lane 0's in all lanes of a quad where the sampler says
/// so. All four lanes of a quad must have valid uv.
template <Packet F>
Gradients<F> implicit_gradients(const SampledTexture& texture, const vec2<F>& uv,
                                DerivativeMode mode) {
    const Gradients<F> own{dFdx(uv, mode), dFdy(uv, mode)};
    if (texture.sampler.quad_lod == 0) return own;
    const auto of_lane_0 = [](F x) { return broadcast_lane<0>(x); };
    return {map_components(of_lane_0, own.x), map_components(of_lane_0, own.y)};
}

/// Their record. The bias is each lane's own.
template <Packet F>
LodRecord<F> implicit_lod(const SampledTexture& texture, const vec2<F>& uv,
                          DerivativeMode mode = DerivativeMode::fine, F bias = F(0),
                          LodUse use = LodUse::shown) {
    if (use == LodUse::look_up && !lod_matters(texture)) return finest_lod<F>();
    const auto [dx, dy] = implicit_gradients(texture, uv, mode);
    return lod_for(use, texture, dx, dy, bias);
}

/// Implicit gradients and a bias in levels. All four lanes of a quad must have valid uv.
template <Packet F>
vec4<F> texture_bias(const SampledTexture& texture, const SampleContext<F>& context,
                     const vec2<F>& uv, std::type_identity_t<F> bias,
                     DerivativeMode mode = DerivativeMode::fine) {
    return sample_expanded(texture, context, uv,
                           implicit_lod(texture, uv, mode, bias, lod_use(context)));
}

/// Implicit gradients. All four lanes of a quad must have valid uv.
template <Packet F>
vec4<F> texture(const SampledTexture& from, const SampleContext<F>& context, const vec2<F>& uv,
                DerivativeMode mode = DerivativeMode::fine) {
    return sample_expanded(from, context, uv, implicit_lod(from, uv, mode, F(0), lod_use(context)));
}

/// (level of detail after clamps and rounding, lambda before them).
template <Number F>
vec2<F> texture_query_lod(const SampledTexture& texture, const vec2<F>& /*uv*/, const vec2<F>& dx,
                          const vec2<F>& dy) {
    const LodRecord<F> lod = compute_lod(texture, dx, dy);
    return {lod.level, lod.lambda};
}

/// Size of a level in texels.
inline vec2<std::int32_t> texture_size(const SampledTexture& texture, int level) {
    return {texture.view.width[level], texture.view.height[level]};
}

/// One texel, unfiltered; 0 in every stored channel when x, y or level is out of range (missing
/// channels as ever).
template <Number F>
vec4<F> texel_fetch(const SampledTexture& texture, const SampleContext<F>& context, Int<F> x,
                    Int<F> y, Int<F> level) {
    count_fetch(context);
    const Int<F> zero(0);
    const Mask<F> known = (level >= zero) & (level < Int<F>(texture.view.levels));
    const LevelGeometry<F> geometry =
        level_geometry<F>(texture.view, Int<F>(select(known, level, zero)));
    const Mask<F> inside =
        known & (x >= zero) & (x < geometry.width) & (y >= zero) & (y < geometry.height);
    if (const TexelMarks* marks = marks_of(context))
        mark_tap<F>(*marks, texture.view, geometry, x, y, context.active & inside);
    return with_channels(texture.view.channels, [&](auto channels) {
        const Int<F> index =
            texel_index<channels(), F>(geometry, select(inside, x, zero), select(inside, y, zero));
        auto texel = load_texel<channels(), F>(texture.view.texels, index);
        for (F& value : texel.channel) value = select(inside, value, F(0));
        return expand(texel);
    });
}

/// One component (0 to 3) of the four texels of the linear footprint of level 0, in GLSL's order:
/// (left, larger v), (right, larger v), (right, smaller v), (left, smaller v).
template <Number F>
vec4<F> texture_gather(const SampledTexture& texture, const SampleContext<F>& context,
                       const vec2<F>& uv, int component = 0) {
    count_fetch(context);
    count_coordinate(context, uv.x, F(coordinate_limit));
    count_coordinate(context, uv.y, F(coordinate_limit));
    const LevelGeometry<F> level = level_geometry<F>(texture.view, 0);
    const Footprint<F> at = address(texture, level, uv, Filter::linear);
    if (const TexelMarks* marks = marks_of(context))
        mark_footprint<F>(*marks, texture, level, uv, Filter::linear, context.active);
    return with_channels(texture.view.channels, [&](auto channels) {
        const auto taps = load_taps<channels(), F>(texture, level, at);
        const auto pick = [&](int tap) { return expand(taps.tap[tap])[component]; };
        return vec4<F>(pick(2), pick(3), pick(1), pick(0));
    });
}

}  // namespace quadrel
