// The depth layer that a ray has met: of the solid one of whose depths at the hit, bilinear at
// level 0, is next to the hit's, the first of equal ones, the nearer side; the other where it alone
// faces the ray and is not much further, since a search may have read another level, by which thin
// solids lie elsewhere. Fronts, the odd layers, face out of the relief, backs into it: their normal
// is turned around.
#pragma once

#include "quadrel/relief/surface/relief_normal.hpp"
#include "quadrel/relief/trace/layer/layers.hpp"

namespace quadrel {

/// A layer at the hit: how far it is, in s, and how its depth changes along u and v.
template <Number F>
struct LayerAt {
    F distance;
    vec2<F> slope;
};

/// Takes a front or the back behind it, if one of them is nearer than what was met.
template <class Met, Number F>
void take_solid(Met& met, int front, const LayerAt<F>& before, const LayerAt<F>& behind,
                const vec2<F>& K, F down) {
    const Mask<F> front_faces = dot(K, before.slope) < down,
                  back_faces = down < dot(K, behind.slope);
    const Mask<F> nearer = min(before.distance, behind.distance) < met.distance;
    // Of a hit at level 0 the layer that was met is much nearer than the other.
    constexpr float as_near = 16;
    const Mask<F> front_alone = front_faces & !back_faces, back_alone = back_faces & !front_faces;
    const Mask<F> is_back = (back_alone & (behind.distance <= before.distance * F(as_near))) |
                            ((behind.distance < before.distance) &
                             !(front_alone & (before.distance <= behind.distance * F(as_near))));
    met.distance = select(nearer, min(before.distance, behind.distance), met.distance);
    met.slope = select(nearer, select(is_back, behind.slope, before.slope), met.slope);
    met.is_back = (nearer & is_back) | (met.is_back & !nearer);
    met.index = select(nearer, select(is_back, Int<F>(front + 1), Int<F>(front)), met.index);
}

template <Number F>
struct MetLayer {
    F distance = F(std::numeric_limits<Scalar<F>>::infinity());  ///< from its depth to the hit's
    vec2<F> slope = vec2<F>(F(0));                               ///< of depths, along u and v
    Mask<F> is_back = Mask<F>(false);
    Int<F> index = Int<F>(0);  ///< from 0, in its map

    /// Takes what is nearer of a map's solids. The ray goes K in UV while it goes `down` in s.
    void look_at(const SampledTexture& map, const SampleContext<F>& context, const vec2<F>& uv, F s,
                 const vec2<F>& K, F down) {
        const Footprint<F> at = address(map, level_geometry<F>(map.view, 0), uv, Filter::linear);
        const F f = at.x.weight, g = at.y.weight;
        const vec2<F> texels = TexelSize<F>(map).texels;
        const auto layer_at = [&](int layer) {
            const vec4<F> d = corners(map, context, uv, layer);
            const F d01 = d.x, d11 = d.y, d10 = d.z, d00 = d.w;
            const vec2<F> steps(lerp(d10 - d00, d11 - d01, g), lerp(d01 - d00, d11 - d10, f));
            return LayerAt<F>{abs(lerp(lerp(d00, d10, f), lerp(d01, d11, f), g) - s),
                              steps * texels};
        };
        for (int front = 0; front < 4; front += 2)
            take_solid(*this, front, layer_at(front), layer_at(front + 1), K, down);
    }

  private:
    /// In the order of textureGather; of a map of two channels, no second pair.
    static vec4<F> corners(const SampledTexture& map, const SampleContext<F>& context,
                           const vec2<F>& uv, int layer) {
        return layer < map.view.channels ? texture_gather(map, context, uv, layer) : vec4<F>(F(1));
    }
};

/// What the normal of a met layer is made of.
inline constexpr auto met_layer_inputs =
    values_and(relief_normal_inputs, Value::hit_s, Value::K, Value::P, Value::r);

/// How far the view ray goes down in s while it goes K in UV: 1 in frames that look at a surface,
/// whose K is the shift over the whole depth; in a volume (frame-impostor) it may go up.
template <class Io, class F = typename Io::Number>
F way_down(const Io& io) {
    const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
    return dot(io.template load<Value::frame_normal>(), V) / io.template load<Value::r>();
}

/// Takes what is nearer of a slot's map, if there is one.
template <TextureSlot slot, class Io, class F>
void look_at_slot(const Io& io, MetLayer<F>& met, F down) {
    const SampledTexture* const map = io.template texture<slot>();
    if (map == nullptr) return;
    met.look_at(*map, io.template context<slot>(), io.template load<Value::hit_uv>(),
                io.template load<Value::hit_s>(), io.template load<Value::K>(), down);
}

/// Stores the normal of the nearest layer of the maps in these slots; one without a map has none.
template <TextureSlot... layers, class Io>
void store_met_normal(Io& io) {
    using F = typename Io::Number;
    const F depth = io.template load<Value::relief_depth>();
    const Mask<F> deep = depth != F(0);
    vec3<F> n(F(0));
    if (when(deep)) {
        MetLayer<F> met;
        const F down = way_down(io);
        (look_at_slot<layers>(io, met, down), ...);
        const vec3<F> up = relief_normal<Io, F>(io, -met.slope, depth);
        n = select(deep, select(met.is_back, -up, up), n);
    }
    store_normal(io, n, deep);
}

}  // namespace quadrel
