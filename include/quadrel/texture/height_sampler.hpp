// Height fetches of a march, in two models of one concept that agree bit for bit where both apply:
// FastHeight (one float channel, bilinear, one level) and GeneralHeight (any sampler, level from
// gradients). The level of detail of a march is settled once, before the first fetch: inside a
// data-dependent loop there are no implicit derivatives.
#pragma once

#include <concepts>

#include "quadrel/texture/sampler.hpp"

namespace quadrel {

/// Heights at uv. Any trace stage is a template over one of these.
template <class S, class F>
concept HeightSampler = requires(const S sampler, const SampleContext<F> context, vec2<F> uv) {
    { sampler(context, uv) } -> std::same_as<F>;
};

/// One level of a one-channel texture, bilinear, any wrap mode.
template <Number F>
class FastHeight {
  public:
    /// Whether the model gives what the sampler asks for, level 0 for every lane.
    static bool applies(const SampledTexture& texture) {
        const SamplerState& s = texture.sampler;
        return texture.view.channels == 1 && texture.view.faces == 1 && s.mag == Filter::linear &&
               s.min == Filter::linear && (s.mip == MipFilter::none || texture.view.levels == 1);
    }

    /// Whether the model gives what the sampler asks for at `levels` of GeneralHeight.
    static bool applies(const SampledTexture& texture, const MipLevels<F>& levels) {
        const SamplerState& s = texture.sampler;
        return texture.view.channels == 1 && texture.view.faces == 1 && s.mag == Filter::linear &&
               s.min == Filter::linear && !levels.blends;
    }

    /// `texture` must outlive this object. `level` is in [0, levels - 1]; filters are ignored.
    explicit FastHeight(const SampledTexture& texture, int level = 0)
        : texture_(texture), level_(level_geometry<F>(texture.view, level)) {}
    /// The finer of the levels, one per lane.
    FastHeight(const SampledTexture& texture, const MipLevels<F>& levels)
        : texture_(texture), level_(levels.fine) {}

    F operator()(const SampleContext<F>& context, const vec2<F>& uv) const {
        count_fetch(context);
        count_coordinate(context, uv.x, F(coordinate_limit));
        count_coordinate(context, uv.y, F(coordinate_limit));
        if (const TexelMarks* marks = marks_of(context))
            mark_footprint<F>(*marks, texture_, level_, uv, Filter::linear, context.active);
        return sample_linear<1, F>(texture_, level_, uv).channel[0];
    }

  private:
    const SampledTexture& texture_;
    LevelGeometry<F> level_;
};

/// Any texture and sampler; the height is channel 0.
template <Number F>
class GeneralHeight {
  public:
    /// Gradients of the undisplaced uv, per pixel. `texture` must outlive this object.
    GeneralHeight(const SampledTexture& texture, const vec2<F>& dx, const vec2<F>& dy)
        : GeneralHeight(texture, compute_lod(texture, dx, dy)) {}
    /// Level of detail settled by the caller.
    GeneralHeight(const SampledTexture& texture, const LodRecord<F>& lod)
        : texture_(texture), lod_(lod), levels_(mip_levels(texture, lod)) {}

    F operator()(const SampleContext<F>& context, const vec2<F>& uv) const {
        return sample_expanded(texture_, context, uv, lod_, levels_).x;
    }

    const LodRecord<F>& lod() const { return lod_; }
    const MipLevels<F>& levels() const { return levels_; }

  private:
    const SampledTexture& texture_;
    LodRecord<F> lod_;
    MipLevels<F> levels_;
};

}  // namespace quadrel
