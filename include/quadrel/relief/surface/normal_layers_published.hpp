// normal-layers@published: the normal of the met layer as the listing of multilayer@published has
// it.
//
// Source: the shader quad_depth_relief_mapping of F. Policarpo's relief mapping examples, of
// "Relief Mapping of Non-Height-Field Surface Details", I3D 2006: n.y is 1 minus the texel, n is 2
// n - 1, z its rest, below 0 at the second and the fourth layer; not normalised where x and y are
// too long. It stays in tangent space there; here it is handed on along the frame's T, B and normal
// as they are. Look-ups take the implicit derivatives of the displaced coordinate. Without one of
// the maps: the frame's normal.
#pragma once

#include "quadrel/relief/surface/normal_layers.hpp"
#include "quadrel/relief/surface/normal_welsh_published.hpp"

namespace quadrel {

struct NormalLayersPublished : NormalOfLayers {
    static constexpr StageText text{"normal-layers@published", "surface",
                                    "normal that maps hold of the layer that is met, as listed",
                                    "Policarpo and Oliveira 2006, quad_depth_relief_mapping"};
    static constexpr auto inputs = values_and(listed_normal_inputs, Value::hit_s);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        if (!has_maps(io))
            return io.template store<Value::N>(io.template load<Value::frame_normal>());
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const SampledTexture& layers = layer_map(io);
        const vec4<F> depths =
            layer_depths(layers, implicit_texel<TextureSlot::layers>(io, layers, uv));
        const LayerNormal<F> met =
            layer_normal(depths, io.template load<Value::hit_s>(),
                         implicit_texel<TextureSlot::layer_normals_x>(
                             io, *io.template texture<TextureSlot::layer_normals_x>(), uv),
                         implicit_texel<TextureSlot::layer_normals_y>(
                             io, *io.template texture<TextureSlot::layer_normals_y>(), uv));
        const F x = met.texel.x * F(2) - F(1), y = (F(1) - met.texel.y) * F(2) - F(1);
        store_along_frame(io, vec3<F>(x, y, layer_normal_z(x, y, met.is_back)));
    }
};

}  // namespace quadrel
