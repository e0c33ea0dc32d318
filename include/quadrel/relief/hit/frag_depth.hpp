// frag-depth: the window depth of the hit, by the scene's own projection, for gl_FragDepth.
//
// Corrects frag-depth@published, which guesses 1 / (z + distance). Relief that is inset can only
// increase the depth of its polygon.
#pragma once

#include "quadrel/relief/view.hpp"

namespace quadrel {

struct FragDepth : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"frag-depth", "frag-depth",
                                    "window depth of the hit by the projection",
                                    "OpenGL specification, coordinate transformations"};
    static constexpr auto inputs = values(Value::hit_P);
    static constexpr auto outputs = values(Value::frag_depth);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> P = io.template load<Value::hit_P>();
        const F depth = clip_row(io, P, 2) / clip_row(io, P, 3);
        io.template store<Value::frag_depth>(depth * F(io.frame().depth_scale) +
                                             F(io.frame().depth_offset));
    }

  private:
    /// Component `row` of the clip coordinates of a point in eye space.
    template <class Io, class F>
    static F clip_row(Io& io, const vec3<F>& P, int row) {
        const auto& m = io.frame().projection;
        const auto entry = [&](int column) { return F(m[4 * row + column]); };
        return entry(0) * P.x + entry(1) * P.y + entry(2) * P.z + entry(3);
    }
};

}  // namespace quadrel
