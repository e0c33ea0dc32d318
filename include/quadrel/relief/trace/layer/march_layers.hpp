// Linear search and bisection through depth layers.
//
// Samples are indexed: s = k / n, k = 0 ... n. The first that is inside of a solid, and the one
// before, are halved by the same test. A miss is a miss: CLIP, at s = 1.
#pragma once

#include "quadrel/quad/shared_scales.hpp"
#include "quadrel/relief/trace/layer/layers.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

/// Depths at uv, with the gradients of the undisplaced UV (textureGrad). The stage loads dUVdx and
/// dUVdy.
template <class Io, int layers>
class MarchLayers {
  public:
    using F = typename Io::Number;

    /// `io` must outlive this object.
    explicit MarchLayers(const Io& io)
        : io_(io), map_(layer_map(io)), lod_(undisplaced_lod(io, map_)) {}

    /// At depth s of a ray, which a probe is told.
    vec4<F> operator()(Mask<F> active, F s, const vec2<F>& uv) const {
        const auto context = io_.template context<TextureSlot::layers>(active);
        const vec4<F> depths = layer_depths(map_, sample_expanded(map_, context, uv, lod_));
        io_.march_step(active, s, uv, F(1) - s, F(1) - nearest_layer<layers>(depths, s));
        return depths;
    }

  private:
    const Io& io_;
    const SampledTexture& map_;
    LodRecord<F> lod_;
};

/// The neighbouring samples of a march between which a ray enters a solid.
template <int layers, Number F>
struct LayerBracket {
    F s_outside = F(0);  ///< the last sample outside; the ray's start if there is none
    F s_inside = F(1);
    F depth = F(1);  ///< of the layer next to the sample inside
    Mask<F> found = Mask<F>(false), met_nan = Mask<F>(false);
    Int<F> steps = Int<F>(0);

    /// Tests s in the lanes of `active`; those where it is inside.
    template <class Depths>
    Mask<F> narrow(const Depths& depths_at, const SearchRay<F>& ray, Mask<F> active, F s) {
        const vec4<F> depths = depths_at(active, s, ray.at(s));
        const Mask<F> inside = active & is_inside<layers>(depths, s);
        s_inside = select(inside, s, s_inside);
        depth = select(inside, nearest_layer<layers>(depths, s), depth);
        s_outside = select(active & !inside, s, s_outside);
        met_nan = met_nan | (active & has_nan<layers>(depths));
        count_in<F>(steps, active);
        return inside;
    }
};

/// What marches through layers are told.
struct LayerMarchParams {
    std::int32_t steps = 15, binary_steps = 6;
};
inline constexpr std::array layer_march_parameters{
    parameter<&LayerMarchParams::steps>("steps", "1", "steps over the relief's depth", 1,
                                        most_steps, 15),
    parameter<&LayerMarchParams::binary_steps>("binary_steps", "1", "halvings of the last step", 0,
                                               60, 6)};

/// A search of the first `layers` depths in steps.
template <int layers>
struct MarchOfLayers : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr auto inputs = search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::layers);
    using Params = LayerMarchParams;
    static constexpr auto parameters = layer_march_parameters;

  protected:
    template <class Io>
    static void march(Io& io, const Params& params) {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const MarchLayers<Io, layers> depths(io);
        LayerBracket<layers, F> bracket;
        Mask<F> active = ray.active;
        for (const auto k : steps<F>(0, params.steps)) {
            const Mask<F> inside =
                bracket.narrow(depths, ray, active, number<F>(k) / number<F>(params.steps));
            bracket.found = bracket.found | inside;
            active = active & !inside;
            if (none(active)) break;
        }
        for (const auto k : steps<F>(1, params.binary_steps)) {
            const F middle = (bracket.s_outside + bracket.s_inside) * F(0.5f);
            bracket.narrow(depths, ray, bracket.found, middle);
        }
        SearchResult<F> result;
        result.s = bracket.s_inside;
        result.h = F(1) - bracket.depth;
        result.status = search_status<F>(bracket.found, bracket.met_nan, Status::clip);
        result.steps = bracket.steps;
        result.fetches = bracket.steps;
        store_search(io, ray, result);
    }
};

}  // namespace quadrel
