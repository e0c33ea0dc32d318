// Batches of rays over a stress map with every map that cone and sphere searches read of it.
#pragma once

#include "quadrel/bake/bake.hpp"
#include "relief/exact/exact_search.hpp"
#include "relief/surface_rays.hpp"

namespace quadrel::test {

template <PlainFloat T>
class ConeBatch {
  public:
    Batch<T> batch;

    explicit ConeBatch(int seed) : maps_(maps_of(seed)) {
        for (int slot = 0; slot < texture_slot_count; ++slot)
            if (maps_[static_cast<std::size_t>(slot)].texture)
                batch.bind(static_cast<TextureSlot>(slot),
                           maps_[static_cast<std::size_t>(slot)].sampled);
        Random random(static_cast<std::uint64_t>(seed) * 104729 + 3);
        fill_surface(batch, random, {.least_r = 0.15, .depth = 0.2});
    }
    ConeBatch(const ConeBatch&) = delete;

    oracle::Ray ray(int lane) { return oracle_ray(batch, lane); }

    /// The bilinear field over a lane's ray at s.
    double height_at(int lane, double s) {
        const oracle::Field field(maps_[0].sampled);
        const oracle::Ray r = ray(lane);
        const oracle::Real along = static_cast<oracle::Real>(s) - r.s_polygon;
        const oracle::Real x = (r.u + along * r.Ku) * field.width - 0.5L;
        const oracle::Real y = (r.v + along * r.Kv) * field.height - 0.5L;
        return static_cast<double>(field.bilinear(x, y));
    }

    /// How far behind the first hit a lane's result is, in texels along the ray.
    double texels_behind_the_oracle(int lane) {
        const oracle::Field field(maps_[0].sampled);
        const oracle::Ray r = ray(lane);
        const oracle::Hit hit = oracle::meet_bilinear(field, r);
        const double ds = batch.real(Value::hit_s, lane) - static_cast<double>(hit.s);
        const oracle::GridRay grid(field, r, 0.5L);
        return ds * std::max<double>(
                        std::sqrt(static_cast<double>(grid.dx * grid.dx + grid.dy * grid.dy)), 1.0);
    }

  private:
    using Maps = std::array<Map, texture_slot_count>;

    /// Baked once for all tests.
    static const Maps& maps_of(int seed) {
        static std::map<int, Maps> made;
        const auto [place, fresh] = made.try_emplace(seed);
        Maps& maps = place->second;
        if (!fresh) return maps;
        Random random(static_cast<std::uint64_t>(seed) * 7919 + 5);
        const auto& kinds = stress_maps();
        Map& height = maps[static_cast<std::size_t>(TextureSlot::height)];
        height = make_stress_map(kinds[static_cast<std::size_t>(seed) % kinds.size()], 32, 24,
                                 plain_sampler(), random);
        for (const TextureSlot slot :
             {TextureSlot::cone, TextureSlot::cone_robust, TextureSlot::cone_rabbid,
              TextureSlot::relaxed_cone, TextureSlot::relaxed_cone_exact, TextureSlot::quad_cone,
              TextureSlot::aniso_cone, TextureSlot::distance, TextureSlot::distance_exact}) {
            Map& map = maps[static_cast<std::size_t>(slot)];
            map.texture =
                bake(*height.texture, bake_kind_from_name(slot_name(slot)), height.sampled.sampler);
            map.sampled = {map.texture->view(), height.sampled.sampler};
        }
        return maps;
    }

    const Maps& maps_;
};

}  // namespace quadrel::test
