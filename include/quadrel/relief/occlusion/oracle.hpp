// ao-oracle: how much of the sky a point of the relief sees, by rays at random.
//
// No source's: what ao-horizon approximates, the cosine-weighted part of the sky over the plane of
// the polygon that no point of the height field hides. Directions by Malley's method (Pharr, Jakob,
// Humphreys, "Physically Based Rendering", 13.6.3): points of a disk, raised to the hemisphere.
// They are independent, drawn from a hash of the hit's uv, the seed and a count, so that equal
// inputs give equal bits; occlusion.error is the estimate's standard error. The ray of each is that
// of shadow-oracle.
#pragma once

#include "quadrel/relief/trace/oracle/lanes.hpp"
#include "quadrel/relief/trace/oracle/sky.hpp"
#include "quadrel/relief/view.hpp"

namespace quadrel {

struct AoOracle : StageDefaults {
    static constexpr StageText text{"ao-oracle", "occlusion",
                                    "the open part of the sky, by rays at random",
                                    "Malley's method: Pharr, Jakob, Humphreys 2016"};
    static constexpr auto inputs = values(Value::relief_depth, Value::frame_normal, Value::J,
                                          Value::frame_status, Value::hit_uv, Value::hit_s);
    static constexpr auto outputs = values(Value::occlusion, Value::occlusion_error);
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::max_mip);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;

    struct Params {
        std::int32_t samples = 64;
        std::int32_t seed = 0;
        std::int32_t surface = 0;
    };
    static constexpr std::array parameters{
        parameter<&Params::samples>("samples", "rays", "directions", 2, 65536, 64),
        parameter<&Params::seed>("seed", "1", "of the directions", 0, 1 << 30, 0),
        oracle::surface_parameter<&Params::surface>()};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const auto J = io.template load<Value::J>();
        const vec3<F> N = io.template load<Value::frame_normal>();
        const F depth = io.template load<Value::relief_depth>();
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const F s = io.template load<Value::hit_s>();
        const Mask<F> framed =
            io.template load<Value::frame_status>() == status_packet<F>(Status::hit);
        const Mask<F> active = io.active() & framed & (depth != F(0));
        const oracle::Field field =
            oracle::field_of(io, static_cast<oracle::Surface>(params.surface));
        F open(1), error(0);
        for (int lane = 0; lane < 4; ++lane) {
            const auto row = [&](const vec3<F>& v) {
                return vec3<double>(v.x.lane[lane], v.y.lane[lane], v.z.lane[lane]);
            };
            const oracle::SkyPoint point{uv.x.lane[lane],
                                         uv.y.lane[lane],
                                         1 - static_cast<double>(s.lane[lane]),
                                         row(N),
                                         row(J[0]) * double(depth.lane[lane]),
                                         row(J[1]) * double(depth.lane[lane])};
            if (!active.lane[lane]) continue;
            const auto sky = oracle::open_sky(field, point, params.samples, params.seed);
            open.lane[lane] = static_cast<Scalar<F>>(sky.open);
            error.lane[lane] = static_cast<Scalar<F>>(sky.error);
        }
        io.template store<Value::occlusion>(open);
        io.template store<Value::occlusion_error>(error);
    }
};

}  // namespace quadrel
