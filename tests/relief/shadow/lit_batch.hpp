// Hits with a light above them: what tests of self-shadows run on.
#pragma once

#include "quadrel/bake/bake.hpp"
#include "relief/exact/exact_search.hpp"
#include "relief/planted.hpp"
#include "relief/surface_rays.hpp"

namespace quadrel::test {

/// Hits of an exact search over a map, a plane a quad, and a directional light on their side.
class LitBatch {
  public:
    Batch<float> batch;

    LitBatch(const Map& height, int seed, double least_elevation = 0.2) : height_(height) {
        Random random(static_cast<std::uint64_t>(seed) * 31 + 7);
        batch.bind(TextureSlot::height, height.sampled);
        for (const TextureSlot slot :
             {TextureSlot::cone_robust, TextureSlot::horizon, TextureSlot::max_mip}) {
            Map& map = baked_[static_cast<std::size_t>(slot)];
            map.texture =
                bake(*height.texture, bake_kind_from_name(slot_name(slot)), height.sampled.sampler);
            map.sampled = {map.texture->view(), height.sampled.sampler};
            batch.bind(slot, map.sampled);
        }
        // One plane for the whole batch, so that one light stands at one elevation.
        fill_surface(batch, random, {.least_r = 0.5, .depth = 0.1});
        for (int lane = 0; lane < batch.lanes; ++lane) {
            for (const Value v : {Value::T, Value::B, Value::frame_normal, Value::Ng})
                batch.set(v, lane, batch.vector3(v, 0));
            batch.set(Value::N, lane, batch.vector3(Value::frame_normal, 0));
            for (int c = 0; c < 6; ++c) batch.real(Value::J, lane, c) = batch.real(Value::J, 0, c);
        }
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            const auto axis = [&](Value v) { return dvec3(batch.vector3(v, 0)); };
            set_quad_vertices(
                batch, quad, dvec3(batch.vector3(Value::P, 4 * quad)),
                VertexAxes{axis(Value::T), axis(Value::B), axis(Value::frame_normal)});
        }
        batch.run("texel-exact");
        for (int lane = 0; lane < batch.lanes; ++lane)
            batch.set(Value::hit_P, lane, batch.vector3(Value::P, lane));
        light(random.uniform(0, 6.28), random.uniform(least_elevation, 1.5));
    }
    LitBatch(const LitBatch&) = delete;

    /// A directional light at an azimuth from T towards B and an elevation over the plane, radians.
    void light(double azimuth, double elevation) {
        const dvec3 T(batch.vector3(Value::T, 0)), B(batch.vector3(Value::B, 0));
        const dvec3 N(batch.vector3(Value::frame_normal, 0));
        const dvec3 L =
            (T * quadrel::cos(azimuth) + B * quadrel::sin(azimuth)) * quadrel::cos(elevation) +
            N * quadrel::sin(elevation);
        batch.frame.lights[0].directional = 1;
        for (int c = 0; c < 3; ++c) batch.frame.lights[0].position[c] = static_cast<float>(L[c]);
    }

    /// K of the light ray of a lane.
    dvec2 light_shift(int lane) {
        const LightUniforms& light = batch.frame.lights[0];
        const dvec3 L = normalize(dvec3(light.position[0], light.position[1], light.position[2]));
        const double r = dot(L, dvec3(batch.vector3(Value::frame_normal, lane)));
        return dvec2(dot(dvec3(batch.vector3(Value::J, lane, 0)), L),
                     dot(dvec3(batch.vector3(Value::J, lane, 3)), L)) *
               (batch.material.depth / r);
    }

    /// How far the field rises over the light ray, at most, from `from` of its way on: above 0 is
    /// shadow.
    double most_excess(int lane, double from) {
        const oracle::Field field(height_.sampled);
        const dvec2 K = light_shift(lane), uv(batch.vector2(Value::hit_uv, lane));
        const double z =
            std::max<double>(1 - batch.real(Value::hit_s, lane), batch.real(Value::hit_h, lane));
        double most = -1;
        const int samples = 4000;
        for (int k = 0; k <= samples; ++k) {
            const double t = (1 - z) * (from + (1 - from) * k / samples);
            const dvec2 at = uv + K * t;
            const auto h = field.bilinear(at.x * field.width - 0.5, at.y * field.height - 0.5);
            most = std::max(most, static_cast<double>(h) - (z + t));
        }
        return most;
    }

    float visibility(int lane) { return batch.real(Value::shadow_visibility, lane); }

  private:
    const Map& height_;
    std::array<Map, texture_slot_count> baked_;
};

/// The map of that name, 32 x 32 texels.
inline Map stress(const char* name, int seed) {
    Random random(static_cast<std::uint64_t>(seed));
    for (const StressMap& kind : stress_maps())
        if (std::string(kind.name) == name)
            return make_stress_map(kind, 32, 32, plain_sampler(), random);
    QUADREL_CHECK(!"a stress map of that name", name);
    return {};
}

}  // namespace quadrel::test
