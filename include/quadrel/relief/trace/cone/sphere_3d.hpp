// sphere-3d: sphere tracing through a volume of distances to the relief.
//
// Source: J. C. Hart, "Sphere Tracing", The Visual Computer 12, 1996; W. Donnelly, "Per-Pixel
// Displacement Mapping with Distance Functions", GPU Gems 2, 2005, chapter 8. Corrects
// sphere-3d@published: distances are Euclidean, never above the true ones where they are
// interpolated, and in texels on maps that are not square; the number of steps is a parameter. A
// search that still moves after them says CAP. Early, never late: the volume has few layers, and
// its distances are cut so far down that no look-up passes the surface.
#pragma once

#include "quadrel/relief/trace/cone/distance_volume.hpp"

namespace quadrel {

struct Sphere3d : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"sphere-3d", "trace", "sphere tracing of a distance volume",
                                    "Donnelly 2005, GPU Gems 2, chapter 8; Hart 1996"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::distance_exact);
    struct Params {
        std::int32_t steps = 128;
        float tolerance = 1.0f / 4096;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "look-ups at most", 1, 65536, 128),
        parameter<&Params::tolerance>("tolerance", "depth", "a step this short counts as a hit", 0,
                                      1, 1.0 / 4096)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const DistanceVolume<TextureSlot::distance_exact, Io> volume(io);
        // The ray from top to bottom is this long, in voxels.
        const F voxels = length(vec3<F>(ray.K * volume.size(), volume.layers()));
        const F reach = volume.layers() / voxels;
        SearchResult<F> result;
        Mask<F> active = ray.active, found(false), met_nan(false), at_bottom(false);
        F s(0);
        for (const auto k : steps<F>(1, params.steps)) {
            const vec2<F> uv = ray.at(s);
            const F distance = volume(active, uv, F(1) - s);
            io.march_step(active, s, uv, F(1) - s, (F(1) - s) - distance);
            count_in<F>(result.steps, active);
            met_nan = met_nan | (active & is_nan(distance));
            const F step = max(distance, F(0)) * reach;
            const Mask<F> near = active & (step <= F(params.tolerance));
            found = found | near;
            active = active & !near & !is_nan(distance);
            s = select(active, s + step, s);
            at_bottom = at_bottom | (active & (s >= F(1)));
            active = active & !at_bottom;
            if (none(active)) break;
        }
        result.s = min(s, F(1));
        result.h = F(1) - result.s;
        result.status = select(at_bottom, status_packet<F>(Status::floor),
                               search_status<F>(found, met_nan, Status::cap));
        result.fetches = result.steps + result.steps;
        store_search(io, ray, result);
    }
};

}  // namespace quadrel
