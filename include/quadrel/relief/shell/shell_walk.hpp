// A straight ray through the tetrahedra of a shell, from one to the next, for as long as it is in
// the shell: what shadows go through. Out through the shell's top, or an open border, it is in the
// light; whether it comes into the shell again elsewhere, as through the hole of a torus, is not
// asked. Its bottom lets no light through.
#pragma once

#include "quadrel/relief/shadow/light_ray.hpp"
#include "quadrel/relief/shell/shell_cell.hpp"

namespace quadrel {

/// What shadows of shells load.
inline constexpr auto shell_light_inputs = light_ray_inputs;

/// Tetrahedra that a ray goes through at most; beyond, it is taken to be out.
inline constexpr int most_shell_cells = 65536;

/// The part of a ray in one tetrahedron.
template <Number F>
struct ShellPart {
    F length;             ///< world units until it leaves
    vec2<F> uv, uv_rate;  ///< where the ray is, and a world unit on
    F s, s_rate;          ///< depth below the shell's top, likewise
    Int<F> link;          ///< where it leaves to
    F error;              ///< of s, at most, where the ray is
    vec2<F> uv_error;     ///< likewise

    vec2<F> uv_at(F along) const { return uv + uv_rate * along; }
    F height_at(F along) const { return (F(1) - s) - s_rate * along; }
};

template <Number F>
class ShellWalk {
  public:
    /// From a fragment's hit towards a light, in the tetrahedron of the hit.
    template <class Io>
    ShellWalk(const Io& io, const vec3<F>& L)
        : cells_(io), P_(io.template load<Value::hit_P>()), L_(L) {
        const Mask<F> framed =
            io.template load<Value::frame_status>() == status_packet<F>(Status::hit);
        active = io.active() & framed & (io.template load<Value::relief_depth>() > F(0));
    }

    Mask<F> active;                 ///< still on the way
    Mask<F> dark = Mask<F>(false);  ///< met something
    F travelled = F(0);             ///< world units

    /// In the tetrahedron where each ray is.
    ShellPart<F> part() const {
        const vec3<F> origin = cells_.origin(), from = (P_ + L_ * travelled) - origin;
        const F never(std::numeric_limits<Scalar<F>>::infinity()), zero(0);
        ShellPart<F> part;
        part.length = never;
        part.link = Int<F>(ShellCell::outside);
        const vec2<F> uv = cells_.uv(0);
        const F s = cells_.s(0);
        part.uv = uv;
        part.s = s;
        part.uv_rate = vec2<F>(zero);
        part.s_rate = zero;
        F steepest(0);
        vec2<F> spread(zero);
        for (int k = 0; k < 4; ++k) {
            const vec3<F> gradient = cells_.gradient(k);
            const F weight = dot(gradient, from) + F(Scalar<F>(k == 0 ? 1 : 0));
            const F rate = dot(gradient, L_);
            steepest = max(steepest, largest_component(gradient));
            // The face by which it came is behind it, whatever rounding says.
            const Mask<F> ahead = (rate < zero) & !(entered_ == Int<F>(k));
            const F leaves = select(ahead, max(weight, zero) / -rate, never);
            const Mask<F> first = leaves < part.length;
            part.length = select(first, leaves, part.length);
            part.link = select(first, cells_.link(k), part.link);
            if (k == 0) continue;
            const vec2<F> du = cells_.uv(k) - uv;
            const F ds = cells_.s(k) - s;
            spread = max(spread, abs(du));
            part.uv = part.uv + du * weight;
            part.uv_rate = part.uv_rate + du * rate;
            part.s = part.s + ds * weight;
            part.s_rate = part.s_rate + ds * rate;
        }
        part.length = select(part.length < never, part.length, zero);
        const F size = max(largest_component(P_), travelled) + largest_component(from);
        part.error = F(16 * unit_roundoff<F>) * (size * steepest);
        part.uv_error = spread * part.error;
        return part;
    }

    /// Lifts the ray's beginning by `height` of the shell's depth, at the same texture coordinates.
    void lift(F height) {
        vec3<F> u(F(0)), v(F(0)), s(F(0));
        for (int k = 1; k < 4; ++k) {
            const vec3<F> gradient = cells_.gradient(k);
            const vec2<F> uv = cells_.uv(k) - cells_.uv(0);
            u = u + gradient * uv.x;
            v = v + gradient * uv.y;
            s = s + gradient * (cells_.s(k) - cells_.s(0));
        }
        const vec3<F> along = cross(u, v);
        const F fall = dot(s, along);
        const vec3<F> lifted = P_ - along * (height / fall);
        const Mask<F> holds = is_finite(lifted.x + lifted.y + lifted.z);
        P_ = select(holds, lifted, P_);
    }

    void darken(Mask<F> mask) {
        dark = dark | mask;
        active = active & !mask;
    }

    /// On to the next tetrahedron, where `mask`, or out.
    void cross_over(Mask<F> mask, const ShellPart<F>& part) {
        const Mask<F> crosses = mask & active;
        darken(crosses & (part.link == Int<F>(ShellCell::below)));
        active = active & !(crosses & (part.link == Int<F>(ShellCell::outside)));
        const Mask<F> on = crosses & active;
        travelled = select(on, travelled + part.length, travelled);
        entered_ = select(on, cells_.follow(on, part.link), entered_);
    }

    /// Stores visibility: 0 also behind a surface without relief.
    template <class Io>
    void store(const Io& io, Int<F> steps) const {
        const F r = dot(L_, io.template load<Value::frame_normal>());
        const Mask<F> deep = io.template load<Value::relief_depth>() > F(0);
        const Mask<F> unlit = select_mask(deep, dark, r <= F(0));
        io.template store<Value::shadow_visibility>(select(unlit, F(0), F(1)), io.light());
        io.template store<Value::shadow_steps>(steps, io.light());
    }

  private:
    static Mask<F> select_mask(Mask<F> which, Mask<F> yes, Mask<F> no) {
        return (which & yes) | (no & !which);
    }

    ShellCells<F> cells_;
    vec3<F> P_, L_;
    Int<F> entered_ = Int<F>(-1);
};

}  // namespace quadrel
