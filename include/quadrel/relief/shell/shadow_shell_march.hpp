// shadow-shell-march: even steps along the light ray through a shell, from tetrahedron to
// tetrahedron.
//
// What shadow-march-thesis is over a plane: hard shadow, a test every 1 / `steps` of the shell's
// depth from the hit on, in world units, until the ray leaves the shell (shell_walk.hpp); misses
// what is thinner than a step.
#pragma once

#include "quadrel/relief/shell/shell_walk.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct ShadowShellMarch : StageDefaults {
    static constexpr StageText text{"shadow-shell-march", "shadow",
                                    "even steps through a shell towards the light",
                                    "after Hirche et al. 2004"};
    static constexpr auto inputs = light_ray_inputs_and(Value::uv, Value::dUVdx, Value::dUVdy);
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool reads_vertices = true;

    struct Params {
        std::int32_t steps = 64, most = 1024;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the shell's depth", 1, most_steps, 64),
        parameter<&Params::most>("most", "1", "most steps", 1, most_steps, 1024)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec3<F> L = to_light(io.template load<Value::hit_P>(), io.frame().lights[io.light()]);
        const auto heights = march_heights(io);
        const F step = io.template load<Value::relief_depth>() / number<F>(params.steps);
        // A search may have stopped below the surface.
        const F lift =
            max(io.template load<Value::hit_h>() - (F(1) - io.template load<Value::hit_s>()), F(0));
        ShellWalk<F> walk(io, L);
        Int<F> points(0);
        F next = step;
        for (const auto k : steps<F>(1, most_shell_cells + params.most)) {
            walk.active = walk.active & (to_float<F>(points) < number<F>(params.most));
            if (none(walk.active)) break;
            const ShellPart<F> part = walk.part();
            const F along = next - walk.travelled;
            const Mask<F> tests = walk.active & (along <= part.length);
            if (when(tests)) {
                const vec2<F> uv = part.uv_at(along);
                const F z = part.height_at(along) + lift, h = heights(tests, uv);
                io.march_step(tests, F(1) - z, uv, z, h);
                count_in<F>(points, tests);
                walk.darken(tests & (h > z));
                next = select(tests, number_after(points, step), next);
            }
            walk.cross_over(walk.active & !tests, part);
        }
        walk.store(io, points);
    }

  private:
    /// The distance of the next point: not summed up.
    template <class F>
    static F number_after(Int<F> points, F step) {
        return step * (to_float<F>(points) + F(1));
    }
};

}  // namespace quadrel
