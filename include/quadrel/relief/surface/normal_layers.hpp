// normal-layers: the normal that two maps hold of the depth layer that a ray has met.
//
// Source: F. Policarpo, M. M. Oliveira, "Relief Mapping of Non-Height-Field Surface Details", I3D
// 2006: x of the normals of four layers in one texture, y in another, a channel a layer; z is what
// a unit normal has left, and is turned round for backs, the second and the fourth. The layer is
// the one whose depth is next to the hit's; the first of equal ones. Corrects
// normal-layers@published: conventions of green and density as in tangent_normal.hpp, maps with the
// footprint of the undisplaced UV, and a normal of unit length. Without one of the maps: the
// frame's normal.
#pragma once

#include "quadrel/relief/surface/tangent_normal.hpp"
#include "quadrel/relief/trace/layer/layers.hpp"

namespace quadrel {

/// x and y of the met layer's normal as its texels have them, and whether that is a back.
template <Number F>
struct LayerNormal {
    vec2<F> texel;
    Mask<F> is_back;
};

/// Of the layer whose depth is next to s.
template <Number F>
LayerNormal<F> layer_normal(const vec4<F>& depths, F s, const vec4<F>& x, const vec4<F>& y) {
    LayerNormal<F> met{{x.x, y.x}, Mask<F>(false)};
    F nearest = abs(s - depths.x);
    for (int layer = 1; layer < 4; ++layer) {
        const F distance = abs(s - depths[layer]);
        const Mask<F> nearer = distance < nearest;
        nearest = select(nearer, distance, nearest);
        met.texel = select(nearer, vec2<F>(x[layer], y[layer]), met.texel);
        met.is_back = layer % 2 == 0 ? met.is_back & !nearer : met.is_back | nearer;
    }
    return met;
}

/// z of a unit normal, turned round for backs.
template <Number F>
F layer_normal_z(F x, F y, Mask<F> is_back) {
    const F z = sqrt(max(F(0), F(1) - (x * x + y * y)));
    return select(is_back, -z, z);
}

/// A normal of the maps of layers.
struct NormalOfLayers : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr auto outputs = surface_outputs;
    static constexpr auto textures =
        slots(TextureSlot::layers, TextureSlot::layer_normals_x, TextureSlot::layer_normals_y);

  protected:
    /// Both maps of normals, or null.
    template <class Io>
    static bool has_maps(const Io& io) {
        return io.template texture<TextureSlot::layer_normals_x>() != nullptr &&
               io.template texture<TextureSlot::layer_normals_y>() != nullptr;
    }
};

struct NormalLayers : NormalOfLayers {
    static constexpr StageText text{"normal-layers", "surface",
                                    "normal that maps hold of the layer that is met",
                                    "Policarpo and Oliveira 2006"};
    static constexpr auto inputs = values_and(tangent_normal_inputs, Value::hit_s);
    struct Params {
        std::int32_t green = 1;
    };
    static constexpr std::array parameters{green_parameter<&Params::green>()};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        if (!has_maps(io))
            return io.template store<Value::N>(io.template load<Value::frame_normal>());
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const SampledTexture& layers = layer_map(io);
        const vec4<F> depths =
            layer_depths(layers, texel_at<TextureSlot::layers>(io, layers, uv, 0));
        const LayerNormal<F> met =
            layer_normal(depths, io.template load<Value::hit_s>(),
                         texel_at<TextureSlot::layer_normals_x>(
                             io, *io.template texture<TextureSlot::layer_normals_x>(), uv, 0),
                         texel_at<TextureSlot::layer_normals_y>(
                             io, *io.template texture<TextureSlot::layer_normals_y>(), uv, 0));
        const vec2<F> t = met.texel * F(2) - vec2<F>(F(1));
        const F y = t.y * F(static_cast<float>(params.green < 0 ? -1 : 1));
        const EyeNormal<F> eye =
            tangent_to_eye(io, vec3<F>(t.x, y, layer_normal_z(t.x, y, met.is_back)));
        store_normal(io, eye.n, eye.valid);
    }
};

}  // namespace quadrel
