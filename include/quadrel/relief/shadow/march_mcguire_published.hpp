// shadow-march-mcguire@published: steep parallax mapping's self-shadow, as listed.
//
// Source: M. McGuire, M. McGuire, "Steep Parallax Mapping", 2005, fragment shader. The light vector
// is that of the vertices, interpolated (tangent_light.hpp) and normalised; the bump scale is a UV
// length, as in steep@published; the height starts from the texel that the view search ended on.
// Not reproduced: the page's vertex shader, which it does not show; vertex_frame.hpp names the one
// that is taken. Kept: dark where N.L <= 0, N being the map's normal, and for that alone: a light
// below the plane of the polygon marches away from where it stands; the height starts a tenth of a
// step up, the coordinate does not; heights are accumulated; the number of steps is cut to an
// integer; the last test may lie above the top plane; nothing bounds the loop (here: 65536 steps).
// Visible where the march left the field. texture2D in the loop takes implicit derivatives. Without
// a frame or depth nothing is searched.
#pragma once

#include "quadrel/relief/tangent_light.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"

namespace quadrel {

struct ShadowMarchMcguirePublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shadow-march-mcguire@published", "shadow",
                                    "linear march, 60 to 5 steps, as listed",
                                    "McGuire and McGuire 2005, Steep Parallax Mapping"};
    static constexpr const char* not_reproduced =
        "the vertex shader, which the page does not show: G3D's bump.vert of 2004 stands in its "
        "place; with mip levels, what an implementation reads in quads in which a fragment stays "
        "out "
        "of the listing's branch: derivatives are undefined there";
    static constexpr auto inputs = values_and(tangent_light_inputs, Value::relief_depth,
                                              Value::frame_status, Value::hit_uv, Value::hit_h);
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_vertices = true;
    struct Params {
        float bump_scale = 0.05f;
    };
    static constexpr std::array parameters{parameter<&Params::bump_scale>(
        "bump_scale", "UV", "UV length of the height range", 0, 16, 0.05)};
    static constexpr int most_steps = 65536;
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params&) { return 60; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const TangentLight light(io);
        const vec3<F> tsL = normalize(light.to(io.frame().lights[io.light()]));
        const F NdotL = max(F(0), dot(light.normal(), tsL));
        const F numShadowSteps = trunc(mix(F(60), F(5), tsL.z));
        const F step = F(1) / numShadowSteps;
        // The page's (tsL.x, -tsL.y), whose y axis is against growing v.
        const vec2<F> delta =
            vec2<F>(tsL.x, tsL.y) * F(params.bump_scale) / (numShadowSteps * tsL.z);
        F NB = io.template load<Value::hit_h>();
        // offsetCoord and height
        vec3<F> march(io.template load<Value::hit_uv>(), NB + step * F(0.1f));
        const ImplicitHeights heights(io);
        const Course course{[](const vec3<F>& at) { return vec2<F>(at.x, at.y); },
                            [](const vec3<F>& at, F h) { return (h < at.z) & (at.z < F(1)); },
                            [&](const vec3<F>& at) { return at + vec3<F>(delta, step); }};
        const Mask<F> marches = io.active() & (NdotL > F(0)) & light.framed() & has_relief(io);
        Int<F> points(0);
        Mask<F> active = marches & course.passes(march, NB);
        march = select(active, course.next(march), march);
        for (const auto k : steps_on_course<F>(course, march, heights, active, 1, most_steps)) {
            if (none(active)) break;
            const F h = heights(active, course.at(march));
            io.march_step(active, F(1) - march.z, course.at(march), march.z, h);
            NB = select(active, h, NB);
            count_in<F>(points, active);
            active = active & course.passes(march, NB);
            march = select(active, course.next(march), march);
        }
        const Mask<F> selfShadow = (NdotL > F(0)) & ((NB < march.z) | !marches);
        io.template store<Value::shadow_visibility>(select(selfShadow, F(1), F(0)), io.light());
        io.template store<Value::shadow_steps>(points, io.light());
    }

  private:
    template <class Io, class F = typename Io::Number>
    static Mask<F> has_relief(const Io& io) {
        return (io.template load<Value::frame_status>() == status_packet<F>(Status::hit)) &
               (io.template load<Value::relief_depth>() != F(0));
    }
};

}  // namespace quadrel
