// linear: march in n equal steps of depth, first sample at or below the surface wins.
//
// Corrects linear-thesis: the n + 1 tests are at s = k / n over the relief's own depth (the thesis
// marches world units, so that at its default depth 7 of 129 samples can matter), the test is >=,
// and heights are fetched with the gradients of the undisplaced UV.
// May miss features thinner than |K| / n; the s that it returns is at most 1 / n late, never early.
#pragma once

#include "quadrel/relief/view.hpp"
#include "quadrel/texture/height_sampler.hpp"

namespace quadrel {

/// What a search returns, lane by lane.
template <Number F>
struct MarchResult {
    F s;  ///< depth below the top plane in units of the relief's depth
    F h;  ///< height that ended the search
    Mask<F> found;
    Int<F> steps;  ///< samples taken
};

/// First k in [0, n] with height(uv0 + (k/n - s_polygon) K) >= 1 - k/n, for the lanes in `active`.
/// `height(active, s, uv)` fetches.
template <Number F, class Height>
MarchResult<F> linear_march(const Height& height, Mask<F> active, const vec2<F>& uv0,
                            const vec2<F>& K, Scalar<F> s_polygon, int n) {
    MarchResult<F> result{F(1), F(0), Mask<F>(false), Int<F>(0)};
    for (int k = 0; k <= n; ++k) {
        const Scalar<F> s = static_cast<Scalar<F>>(k) / static_cast<Scalar<F>>(n);
        const F h = height(active, s, uv0 + K * F(s - s_polygon));
        const Mask<F> below = active & (h >= F(1 - s));
        result.s = select(below, F(s), result.s);
        result.h = select(active, h, result.h);
        result.steps = result.steps + select(active, Int<F>(1), Int<F>(0));
        result.found = result.found | below;
        active = active & !below;
        if (!any(active)) break;
    }
    return result;
}

struct Linear : StageDefaults {
    static constexpr StageText text{"linear", "trace", "linear search in equal steps of depth",
                                    "correction of linear-thesis; McGuire and McGuire 2005"};
    static constexpr auto inputs = values(Value::uv, Value::dUVdx, Value::dUVdy, Value::K,
                                          Value::frame_status, Value::frame_flags);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    struct Params {
        std::int32_t steps = 128;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, 65536, 128)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec2<F> uv = io.template load<Value::uv>();
        const vec2<F> K = io.template load<Value::K>();
        const Int<F> frame_status = io.template load<Value::frame_status>();
        const Mask<F> framed = frame_status == status_packet<F>(Status::hit);
        const Mask<F> active = io.active() & framed;
        const Scalar<F> s_polygon = Scalar<F>(1) - Scalar<F>(io.material().seat);

        const GeneralHeight<F> sampler(*io.template texture<TextureSlot::height>(),
                                       io.template load<Value::dUVdx>(),
                                       io.template load<Value::dUVdy>());
        const auto height = [&](Mask<F> mask, Scalar<F> s, const vec2<F>& at) {
            const F h = sampler(io.context(mask), at);
            io.march_step(mask, F(s), at, F(1 - s), h);
            return h;
        };
        const auto march = linear_march<F>(height, active, uv, K, s_polygon, params.steps);

        const F s = select(framed, march.s, F(s_polygon));
        const F from_polygon = s - F(s_polygon);
        const Int<F> searched = select(march.found, status_packet<F>(Status::hit),
                                       select(is_nan(march.h), status_packet<F>(Status::nan),
                                              status_packet<F>(Status::floor)));
        const Mask<F> starts_below = march.found & (march.s == F(0)) & (march.h > F(1));
        io.template store<Value::hit_uv>(uv + K * from_polygon);
        io.template store<Value::hit_s>(s);
        io.template store<Value::hit_h>(march.h);
        io.template store<Value::hit_depth>(from_polygon * F(io.material().depth));
        io.template store<Value::hit_status>(select(framed, searched, frame_status));
        io.template store<Value::hit_flags>(
            io.template load<Value::frame_flags>() |
            select(starts_below, Int<F>(HitFlag::start_below), Int<F>(0)));
        io.template store<Value::hit_steps>(march.steps);
        io.template store<Value::hit_fetches>(march.steps);
    }
};

}  // namespace quadrel
