// The relief's depth D of every fragment: constant, or graded by what the material asks for.
//
// depth-graded is the remedy that "Derivative-Based Relief Mapping" (2012) proposes against the
// artefacts of grazing angles, "reduce the maximum parallax depth, based upon the angle between
// the surface normal and the camera"; and it takes a depth given as thickness over tile size
// (T. Welsh, "Parallax Mapping with Offset Limiting", 2004, 3) to world units.
#pragma once

#include "quadrel/quad/stage.hpp"

namespace quadrel {

struct DepthConstant : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"depth-constant", "depth", "the material's depth", "-"};
    static constexpr std::array<Value, 0> inputs{};
    static constexpr auto outputs = values(Value::relief_depth);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        io.template store<Value::relief_depth>(typename Io::Number(io.material().depth));
    }
};

struct DepthGraded : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"depth-graded", "depth",
                                    "depth in tiles of the texture, and faded at grazing angles",
                                    "Derivative-Based Relief Mapping (2012), conclusions"};
    static constexpr auto inputs = values(Value::P, Value::vertex_normal, Value::Ng, Value::face_J);
    static constexpr auto outputs = values(Value::relief_depth);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        F depth(io.material().depth);
        if (io.material().depth_in_tiles) depth = depth * tile_length<F>(io);
        if (io.material().fade_from > io.material().fade_to) depth = depth * fade<F>(io);
        io.template store<Value::relief_depth>(depth);
    }

  private:
    /// World length of one tile: the root of the area that the unit square of UV covers; 0 where
    /// the map is degenerate.
    template <class F, class Io>
    static F tile_length(Io& io) {
        const auto J = io.template load<Value::face_J>();
        const vec3<F> n = cross(J[0], J[1]);  // its length: UV area of a unit of world area
        const F density = sqrt(dot(n, n));
        return select(density > F(0), F(1) / sqrt(density), F(0));
    }

    /// 1 where the cosine of N and V is at least fade_from, 0 up to fade_to, linear between.
    template <class F, class Io>
    static F fade(Io& io) {
        const vec3<F> eye = uniform3<F>(io.frame().eye);
        const vec3<F> P = io.template load<Value::P>();
        const vec3<F> V = normalize(io.frame().orthographic ? eye : eye - P);
        const vec3<F> N = normalize(io.template load<Value::vertex_normal>());
        const F side = select(dot(io.template load<Value::Ng>(), V) < F(0), F(-1), F(1));
        const F from(io.material().fade_from), to(io.material().fade_to);
        return clamp((side * dot(N, V) - to) / (from - to), F(0), F(1));
    }
};

}  // namespace quadrel
