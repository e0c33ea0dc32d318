// shade-debug: what the stages before handed on, as colours.
//
// `view` is one of
//   s       grey, 0 at the top plane, 1 at the bottom
//   uv      of the hit: red and green, its fractional part
//   K       direction about middle grey, 0.5 + 0.5 K / (|K| + `gain` / 1000); blue: |K| / gain
//   N       0.5 + 0.5 N in eye space
//   status  black NONE, green HIT, blue FLOOR, yellow CAP, cyan CLIP, red NOFRAME, magenta NAN,
//           white OUTSIDE
//   depth   of the hit below the polygon, over the relief's depth, in red: "Derivative-Based Relief
//           Mapping" (2012), the note at the end of Parallax.frag,
//               dot( SP - P, EC_SurfaceNormal ) / MaxParallaxOffset
// SP, the hit straight above in the surface, is P + N times the hit's depth, so that depth is
// dot(N, vertex normal) depth / D: the vertex normal is not normalised, as listed; 0 without depth.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

struct ShadeDebug : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-debug", "shade", "values of the search as colours",
                                    "Derivative-Based Relief Mapping (2012), Parallax.frag"};
    static constexpr auto inputs =
        values(Value::hit_s, Value::hit_uv, Value::hit_depth, Value::hit_status, Value::K, Value::N,
               Value::frame_normal, Value::vertex_normal, Value::relief_depth);
    static constexpr auto outputs = values(Value::color, Value::opacity);
    struct Params {
        std::int32_t view = 0;
        float gain = 1;
    };
    static constexpr ValueName view_names[] = {{0, "s"}, {1, "uv"},     {2, "K"},
                                               {3, "N"}, {4, "status"}, {5, "depth"}};
    static constexpr std::array parameters{
        choice<&Params::view>("view", "what is shown", view_names, 0),
        parameter<&Params::gain>("gain", "tile", "view K: |K| that is shown as 1", 1e-6, 1e6, 1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        io.template store<Value::color>(color<F>(io, params));
        io.template store<Value::opacity>(F(1));
    }

  private:
    template <class F, class Io>
    static vec3<F> color(Io& io, const Params& params) {
        const vec3<F> grey(F(0.5f));
        switch (params.view) {
            case 0:
                return vec3<F>(io.template load<Value::hit_s>());
            case 1:
                return vec3<F>(fract(io.template load<Value::hit_uv>()), F(0));
            case 2:
                return shift(io.template load<Value::K>(), F(params.gain));
            case 3:
                return io.template load<Value::N>() * F(0.5f) + grey;
            case 4:
                return status_color<F>(io.template load<Value::hit_status>());
            default:
                return {surface_depth<F>(io), F(0), F(0)};
        }
    }

    template <class F>
    static vec3<F> shift(const vec2<F>& K, F gain) {
        const F size = length(K);
        const vec2<F> direction = K * (F(0.5f) / (size + gain * F(0.001f)));
        return {direction.x + F(0.5f), direction.y + F(0.5f), size / gain};
    }

    /// By the bits of a code: 1 green, 2 blue, 3 red and green, 4 green and blue, 5 red, 6 red and
    /// blue, 7 all.
    template <class F>
    static vec3<F> status_color(Int<F> status) {
        const auto one_of = [&](auto... codes) {
            Mask<F> found(false);
            ((found = found | (status == status_packet<F>(codes))), ...);
            return select(found, F(1), F(0));
        };
        using enum Status;
        return {one_of(cap, no_frame, Status::nan, outside), one_of(hit, cap, clip, outside),
                one_of(Status::floor, clip, Status::nan, outside)};
    }

    template <class F, class Io>
    static F surface_depth(Io& io) {
        const F depth = io.template load<Value::relief_depth>();
        const F along =
            dot(io.template load<Value::frame_normal>(), io.template load<Value::vertex_normal>());
        return select(depth != F(0), along * io.template load<Value::hit_depth>() / depth, F(0));
    }
};

}  // namespace quadrel
