// sphere-3d@published: 16 steps through an 8-bit distance volume.
//
// Source: W. Donnelly, "Per-Pixel Displacement Mapping with Distance Functions", GPU Gems 2, 2005,
// chapter 8, program on the disc: o = normalize(direction), o.xy scaled by layers / width for both
// axes, then 16 times p = distance(p) * o + p from p = (uv, 1). The source measures the relief's
// depth in layers as high as texels are wide; its direction is here (K width / layers, -1), of the
// frame's K, where its vertex program has the vector to the eye along the vertices' tangents, z
// over the bump depth, and interpolates that. Kept:
// one scale for both axes, whatever the map's height; 8-bit distances, not quite Euclidean, which
// may be too long between their centres; 16 steps, whose end is never tested; p.z is not clamped.
#pragma once

#include "quadrel/relief/trace/cone/distance_volume.hpp"

namespace quadrel {

struct Sphere3dPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"sphere-3d@published", "trace",
                                    "16 steps through a distance volume as listed",
                                    "Donnelly 2005, GPU Gems 2, chapter 8, disc"};
    static constexpr const char* not_reproduced =
        "tanEyeVec, made by the vertex program: here K of the frame";
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::distance);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const DistanceVolume<TextureSlot::distance, Io> volume(io);
        const F per_layer = volume.size().x / volume.layers();
        vec3<F> o = normalize(vec3<F>(ray.K * per_layer, F(-1)));
        const F scale = volume.layers() / volume.size().x;
        o = vec3<F>(o.x * scale, o.y * scale, o.z);
        vec3<F> p(ray.uv, F(1));
        F distance(0);
        for (const auto k : steps<F>(1, 16)) {
            distance = volume(ray.active, vec2<F>(p), p.z);
            io.march_step(ray.active, F(1) - p.z, vec2<F>(p), p.z, p.z - distance);
            p = o * distance + p;
        }
        SearchResult<F> result;
        result.s = F(1) - p.z;
        result.h = p.z;
        result.status =
            select(is_nan(distance), status_packet<F>(Status::nan), status_packet<F>(Status::hit));
        result.steps = select(ray.active, Int<F>(16), Int<F>(0));
        result.fetches = select(ray.active, Int<F>(32), Int<F>(0));
        store_search(io, ray, result, vec2<F>(p));
    }
};

}  // namespace quadrel
