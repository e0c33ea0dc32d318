// shadow-march-thesis@published: the self-shadow march of the thesis, as published.
//
// Source: "Derivative-Based Relief Mapping" (2012), appendix, Parallax.frag, "Perform per light
// self-shadowing". Defects kept: the ray's world depth is compared with heights that are not scaled
// by the relief's depth, so that shallow reliefs hardly ever shadow; the step assumes unit depth;
// Sample + 1 iterations end above the surface; lights below 0.01 of the face normal are cut hard.
// Sample counts the view march's steps, some 128; hits deeper than twice that march are no reason
// for more.
// Its light is a point; a directional one, which it does not know, keeps its direction.
#pragma once

#include "quadrel/relief/frame/thesis.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"

namespace quadrel {

struct ShadowMarchThesisPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{
        "shadow-march-thesis@published", "shadow", "the thesis' march from the hit to the light",
        "Derivative-Based Relief Mapping (2012), appendix, Parallax.frag 3"};
    static constexpr auto inputs =
        values(Value::vertex_normal, Value::dPdx, Value::dPdy, Value::dUVdx, Value::dUVdy,
               Value::hit_uv, Value::hit_depth, Value::hit_P);
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool needs_height_map = true;

    static constexpr float offset_per_sample = 1.0f / 128.0f;
    static constexpr int most_steps = 255;
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params&) { return 129; }

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const auto t =
            thesis_tangents<F>(io.template load<Value::dPdx>(), io.template load<Value::dPdy>(),
                               io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>(),
                               io.template load<Value::vertex_normal>());
        const vec3<F> L = to_light(io.template load<Value::hit_P>(), io.frame().lights[io.light()]);
        const vec3<F> light_ray = L / dot(L, t.N_flat);
        const vec2<F> tex_offset = t.dUVdT * dot(light_ray, t.T) + t.dUVdB * dot(light_ray, t.B);
        const vec2<F> tex_offset_per_sample = tex_offset / F(128);
        const ImplicitHeights heights(io);
        // uv, light_h and the listing's loop counter: as many steps as the view march took.
        const F hit_h = io.template load<Value::hit_depth>();
        vec4<F> light(io.template load<Value::hit_uv>(), hit_h, hit_h * F(128));
        const vec4<F> step(tex_offset_per_sample, F(-offset_per_sample), F(-1));
        const auto in_light = [](const vec4<F>& at, F h) { return !(at.z > F(1) - h); };
        const Course course{
            [](const vec4<F>& at) { return vec2<F>(at.x, at.y); },
            [&](const vec4<F>& at, F h) { return in_light(at, h) & (at.w >= F(0)); },
            [&](const vec4<F>& at) { return at + step; }};
        const Mask<F> dark = dot(L, t.N_flat) <= F(0.01f);
        Mask<F> active = io.active() & !dark & (light.w >= F(0));
        Mask<F> shadowed(false);
        Int<F> points(0);
        light = select(active, course.next(light), light);
        for (const auto k : steps_on_course<F>(course, light, heights, active, 0, most_steps)) {
            if (none(active)) break;
            const F h = heights(active, course.at(light));
            io.march_step(active, light.z, course.at(light), F(1) - light.z, h);
            points = points + select(active, Int<F>(1), Int<F>(0));
            shadowed = shadowed | (active & !in_light(light, h));
            active = active & course.passes(light, h);
            light = select(active, course.next(light), light);
        }
        io.template store<Value::shadow_visibility>(select(dark | shadowed, F(0), F(1)),
                                                    io.light());
        io.template store<Value::shadow_steps>(points, io.light());
    }
};

}  // namespace quadrel
