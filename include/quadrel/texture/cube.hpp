// Cube map look-ups, seamless: linear footprints reach over the edges of a face, and the texel that
// a corner lacks is the mean of the three that meet there (Vulkan specification, "Cube Map Edge
// Handling"). Nearest filtering stays on the face. The sampler's wrap modes do not apply.
#pragma once

#include "quadrel/texture/cube_face.hpp"
#include "quadrel/texture/fetch_log.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel {

/// The row of a texel among those of all faces.
template <Number F>
Int<F> cube_row(const LevelGeometry<F>& level, const CubeTexel<F>& at) {
    return at.face * level.height + at.y;
}

template <int channels, Number F>
Texel<channels, F> load_cube_texel(const SampledTexture& texture, const LevelGeometry<F>& level,
                                   const CubeTexel<F>& at) {
    return load_texel<channels, F>(texture.view.texels,
                                   texel_index<channels, F>(level, at.x, cube_row(level, at)));
}

template <Number F>
CubeTexel<F> nearest_cube_texel(const SamplerState& sampler, const LevelGeometry<F>& level,
                                const CubePoint<F>& at) {
    const auto axis = [&](F coordinate) {
        return address_axis(coordinate, level.width, level.width_number, Wrap::clamp_to_edge,
                            Filter::nearest, sampler)
            .first;
    };
    return {at.face, axis(at.st.x), axis(at.st.y)};
}

template <int channels, Number F>
Texel<channels, F> sample_cube_nearest(const SampledTexture& texture, const LevelGeometry<F>& level,
                                       const CubePoint<F>& at) {
    return load_cube_texel<channels, F>(texture, level,
                                        nearest_cube_texel(texture.sampler, level, at));
}

/// First texel (-1 to n - 1) and weight of a linear footprint along one axis, not wrapped.
template <Number F>
struct OpenAxis {
    Int<F> first;
    F weight;
};

template <Number F>
OpenAxis<F> open_axis(F coordinate, F size, const SamplerState& sampler) {
    const F known = clamp(saturate_coordinate(coordinate), F(0), F(1));
    const F shifted = round_to_bits(known * size, sampler.weight_bits) - F(0.5f);
    const F base = floor(shifted);
    return {to_int(base), shifted - base};
}

/// Replaces a tap outside in both axes by the mean of the other three, in tap order.
template <int channels, Number F>
void mend_corners(FourTaps<channels, F>& of, const Mask<F> (&corner)[4]) {
    static constexpr int others[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
    const FourTaps<channels, F> given = of;
    for (int tap = 0; tap < 4; ++tap) {
        for (int c = 0; c < channels; ++c) {
            const auto other = [&](int i) { return given.tap[others[tap][i]].channel[c]; };
            const F mean = (other(0) + other(1) + other(2)) / F(3);
            of.tap[tap].channel[c] = select(corner[tap], mean, given.tap[tap].channel[c]);
        }
    }
}

/// The texels of a linear footprint, each on its own face.
template <Number F>
struct CubeFootprint {
    CubeTexel<F> texel[4];
    Mask<F> corner[4];  ///< this texel does not exist; what stands in for it may be read
    F weight_x, weight_y;
};

template <Number F>
CubeFootprint<F> cube_footprint(const SamplerState& sampler, const LevelGeometry<F>& level,
                                const CubePoint<F>& at) {
    const OpenAxis<F> x = open_axis(at.st.x, level.width_number, sampler);
    const OpenAxis<F> y = open_axis(at.st.y, level.width_number, sampler);
    const Int<F> zero(0), size = level.width;
    CubeFootprint<F> of;
    of.weight_x = x.weight;
    of.weight_y = y.weight;
    for (int tap = 0; tap < 4; ++tap) {
        CubeTexel<F> texel = {at.face, x.first + Int<F>(tap & 1), y.first + Int<F>(tap >> 1)};
        const Mask<F> out_x = (texel.x < zero) | (texel.x >= size);
        const Mask<F> out_y = (texel.y < zero) | (texel.y >= size);
        of.corner[tap] = out_x & out_y;
        // A corner's own read is thrown away; it only has to be inside the texture.
        texel.y = select(of.corner[tap], zero, texel.y);
        of.texel[tap] = texel;
        if (when(out_x | out_y)) of.texel[tap] = cross_edge(texel, size);
    }
    return of;
}

template <int channels, Number F>
Texel<channels, F> sample_cube_linear(const SampledTexture& texture, const LevelGeometry<F>& level,
                                      const CubePoint<F>& at) {
    const CubeFootprint<F> of = cube_footprint(texture.sampler, level, at);
    FourTaps<channels, F> taps;
    for (int tap = 0; tap < 4; ++tap)
        taps.tap[tap] = load_cube_texel<channels, F>(texture, level, of.texel[tap]);
    if (when(of.corner[0] | of.corner[1] | of.corner[2] | of.corner[3]))
        mend_corners(taps, of.corner);
    return blend(taps, of.weight_x, of.weight_y);
}

/// Marks a footprint of one level.
template <Number F>
void mark_cube_footprint(const TexelMarks& marks, const SampledTexture& texture,
                         const LevelGeometry<F>& level, const CubePoint<F>& at, Filter filter,
                         Mask<F> asked) {
    const auto tap = [&](const CubeTexel<F>& texel, Mask<F> lanes) {
        mark_tap<F>(marks, texture.view, level, texel.x, cube_row(level, texel), lanes);
    };
    if (filter == Filter::nearest)
        return tap(nearest_cube_texel(texture.sampler, level, at), asked);
    const CubeFootprint<F> of = cube_footprint(texture.sampler, level, at);
    for (int i = 0; i < 4; ++i) tap(of.texel[i], asked & !of.corner[i]);
}

/// Marks what a cube look-up touches.
template <Number F>
[[gnu::noinline]] void mark_cube_look_up(const TexelMarks& marks, const SampledTexture& texture,
                                         CubePoint<F> at, LodRecord<F> lod, Mask<F> active) {
    const MipLevels<F> levels = mip_levels(texture, lod);
    const Mask<F> blended = Mask<F>(levels.blends) & (lod.frac > F(0));
    for_each_footprint<F>(texture.sampler, levels.fine, levels.coarse, active, blended,
                          lod.magnified,
                          [&](const LevelGeometry<F>& level, Filter filter, Mask<F> asked) {
                              mark_cube_footprint<F>(marks, texture, level, at, filter, asked);
                          });
}

template <Number F>
vec4<F> sample_cube_expanded(const SampledTexture& texture, const SampleContext<F>& context,
                             const CubePoint<F>& at, const LodRecord<F>& lod) {
    count_fetch(context);
    count_coordinate(context, at.st.x, F(1));
    count_coordinate(context, at.st.y, F(1));
    if (const TexelMarks* marks = marks_of(context))
        mark_cube_look_up<F>(*marks, texture, at, lod, context.active);
    const vec4<F> value = with_channels(texture.view.channels, [&](auto channels) {
        constexpr int n = channels();
        return expand(
            sample_mips<n, F>(mip_levels(texture, lod), lod, [&](const LevelGeometry<F>& level) {
                return choose_filter<n, F>(
                    texture.sampler, lod.magnified,
                    [&] { return sample_cube_nearest<n, F>(texture, level, at); },
                    [&] { return sample_cube_linear<n, F>(texture, level, at); });
            }));
    });
    log_fetch(context, texture, at.st, lod, value);
    return value;
}

/// The record of gradients of the direction, each lane on its own face.
template <Number F>
LodRecord<F> cube_lod_for(LodUse use, const SampledTexture& texture, const CubePoint<F>& at,
                          const vec3<F>& dx, const vec3<F>& dy) {
    if (use == LodUse::look_up && !lod_matters(texture)) return finest_lod<F>();
    return lod_for(use, texture, cube_derivative(at, dx), cube_derivative(at, dy));
}

/// Level from the gradients of the direction, which need not have unit length.
template <Number F>
vec4<F> texture_cube_grad(const SampledTexture& texture, const SampleContext<F>& context,
                          const vec3<F>& direction, const vec3<F>& dx, const vec3<F>& dy,
                          LodRecord<F>* out = nullptr) {
    const CubePoint<F> at = project_to_cube(direction);
    const LodUse use = out != nullptr ? LodUse::shown : lod_use(context);
    const LodRecord<F> lod = cube_lod_for(use, texture, at, dx, dy);
    if (out != nullptr) *out = lod;
    return sample_cube_expanded(texture, context, at, lod);
}

/// Level of detail given; the sampler's bias and clamps apply.
template <Number F>
vec4<F> texture_cube_lod(const SampledTexture& texture, const SampleContext<F>& context,
                         const vec3<F>& direction, std::type_identity_t<F> lod) {
    return sample_cube_expanded(texture, context, project_to_cube(direction),
                                lod_from_level(texture, lod));
}

/// Implicit gradients. All four lanes of a quad must have valid directions.
template <Packet F>
vec4<F> texture_cube(const SampledTexture& texture, const SampleContext<F>& context,
                     const vec3<F>& direction, DerivativeMode mode = DerivativeMode::fine) {
    return texture_cube_grad(texture, context, direction, dFdx(direction, mode),
                             dFdy(direction, mode));
}

}  // namespace quadrel
