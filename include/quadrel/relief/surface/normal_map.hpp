// normal-map: the normal of a texture, in one of five encodings. No search, no heights.
//
// Sources: R. Cook, "Shade Trees", 1984; J. Cohen et al., "Appearance-Preserving Simplification",
// SIGGRAPH 1998; GPU Gems 3, chapter 18 (two channels); M. Mikkelsen, "Derivative Maps", 2011.
// Texels c are read as 2 c - 1:
//   xyz           three channels: x, y, z
//   xy-unit       two channels: z = sqrt(max(0, 1 - x^2 - y^2)), a unit normal
//   xy-quadratic  two channels: z = 1 - x^2 - y^2, before normalisation: finer near the flat, less
//                 steep
//   slopes        two channels: slopes, (-dh/du, -dh/dv) = `range` (x, y), heights as in a height
//                 map; the relief's depth scales them
//   object-xyz    three channels: a normal in the object's own axes
// Conventions of green and density: tangent_normal.hpp; of `gradients`: map_gradients.hpp. Without
// a map: the frame's normal.
#pragma once

#include "quadrel/relief/surface/tangent_normal.hpp"

namespace quadrel {

struct NormalMap : NormalFromMap {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"normal-map", "surface", "normal from a texture",
                                    "Cook 1984; Cohen et al. 1998; GPU Gems 3, chapter 18"};
    static constexpr auto inputs =
        values(Value::frame_normal, Value::J, Value::frame_status, Value::dUVdx, Value::dUVdy,
               Value::hit_uv, Value::relief_depth, Value::object_x, Value::object_y,
               Value::object_z, Value::P, Value::Ng);
    struct Params {
        std::int32_t encoding = 0, green = 1;
        float range = 1;
        std::int32_t gradients = 0;
    };
    static constexpr ValueName encoding_names[] = {
        {0, "xyz"}, {1, "xy-unit"}, {2, "xy-quadratic"}, {3, "slopes"}, {4, "object-xyz"}};
    static constexpr std::array parameters{
        choice<&Params::encoding>("encoding", "what texels hold", encoding_names, 0),
        green_parameter<&Params::green>(),
        parameter<&Params::range>("range", "1/tile", "encoding slopes: slope of a texel of 1", 0,
                                  1e6, 1),
        gradients_parameter<&Params::gradients>()};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec3<F> N = io.template load<Value::frame_normal>();
        const SampledTexture* map = io.template texture<TextureSlot::normal>();
        if (!map) return io.template store<Value::N>(N);
        vec3<F> t = signed_texel(io, *map, io.template load<Value::hit_uv>(), params.gradients);
        if (params.encoding == 4) return store_normal(io, object_to_eye<F>(io, t), Mask<F>(true));
        t.y = t.y * F(static_cast<float>(params.green < 0 ? -1 : 1));
        if (params.encoding == 3) {
            const F depth = io.template load<Value::relief_depth>();
            const vec2<F> slope = vec2<F>(t.x, t.y) * F(-params.range);
            return store_normal(io, relief_normal<Io, F>(io, slope, depth), depth != F(0));
        }
        const F rest = F(1) - t.x * t.x - t.y * t.y;
        if (params.encoding == 1) t.z = sqrt(max(F(0), rest));
        if (params.encoding == 2) t.z = rest;
        const EyeNormal<F> eye = tangent_to_eye(io, t);
        store_normal(io, eye.n, eye.valid);
    }

  private:
    /// By the columns of the normal matrix; towards the viewer's side of the face.
    template <class F, class Io>
    static vec3<F> object_to_eye(Io& io, const vec3<F>& t) {
        const vec3<F> n = normalize(io.template load<Value::object_x>() * t.x +
                                    io.template load<Value::object_y>() * t.y +
                                    io.template load<Value::object_z>() * t.z);
        const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
        return select(dot(io.template load<Value::Ng>(), V) < F(0), -n, n);
    }
};

}  // namespace quadrel
