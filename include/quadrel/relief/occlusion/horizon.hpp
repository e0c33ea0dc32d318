// ao-horizon: how much of the sky a point of the relief sees, by its horizons.
//
// Source: N. Max, "Horizon mapping: shadows for bump-mapped surfaces", 1988; as ambient occlusion
// the cosine-weighted openness of L. Bavoil, M. Sainz, R. Dimitrov, "Image-space horizon-based
// ambient occlusion", SIGGRAPH 2008: the mean of cos^2 of the horizon's elevation over the
// azimuths. Over the plane of the polygon, whatever the relief's own normal. The elevation's
// tangent in world units is the map's times depth over the length of a tile; where the UV map is
// sheared or stretched that length is the root of a tile's area.
#pragma once

#include "quadrel/relief/frame/store.hpp"
#include "quadrel/relief/trace/cone/cone_map.hpp"

namespace quadrel {

struct AoHorizon : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"ao-horizon", "occlusion",
                                    "mean openness of the horizons around a point",
                                    "Max 1988; Bavoil, Sainz, Dimitrov 2008"};
    static constexpr auto inputs =
        values(Value::relief_depth, Value::J, Value::frame_status, Value::hit_uv);
    static constexpr auto outputs = occlusion_outputs;
    static constexpr auto textures = slots(TextureSlot::horizon);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const auto J = io.template load<Value::J>();
        const F ordinary = ordinary_scale(J[0], J[1]);
        const vec3<F> n = cross(J[0] * ordinary, J[1] * ordinary);
        const F tiles_a_unit = sqrt(sqrt(dot(n, n))) / ordinary;
        const F scale = io.template load<Value::relief_depth>() * tiles_a_unit;
        const Mask<F> framed =
            io.template load<Value::frame_status>() == status_packet<F>(Status::hit);
        const Mask<F> active = io.active() & framed;
        const BakedLookUp<TextureSlot::horizon, 1, Io> read(io);
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const std::int32_t azimuths = io.template texture<TextureSlot::horizon>()->view.faces;
        F sum(0);
        for (const auto k : steps<F>(0, azimuths - 1)) {
            const F tangent = max(read(active, uv, to_int(number<F>(k))).channel[0], F(0)) * scale;
            sum = sum + F(1) / (F(1) + tangent * tangent);
        }
        const F open = sum / number<F>(azimuths);
        io.template store<Value::occlusion>(select(framed, open, F(1)));
    }
};

}  // namespace quadrel
