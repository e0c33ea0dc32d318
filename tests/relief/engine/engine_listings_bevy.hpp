// Bevy's depth map, for one fragment: its steps in its order, in words of this project; the names
// are the shader's.
#pragma once

#include "relief/listing_runs.hpp"

namespace quadrel::listings {

/// The view vector that the fragment shader hands to parallaxed_uv: from the eye to the surface,
/// along tangent, bitangent and normal. T and B run along growing u and v; the engine's bitangent
/// runs against v.
inline Vec3 bevy_Vt(const Vec3& position, const Vec3& T, const Vec3& B, const Vec3& N) {
    // V: the unit vector from the surface to the eye.
    const Vec3 V = normalize(-position);
    const Vec3 engines_B = -B;
    // Its dot products with T, B, N, not normalised again.
    const Vec3 Vt(dot(V, T), dot(V, engines_B), dot(V, N));
    // Negated for the call.
    return -Vt;
}

/// crates/bevy_pbr/src/render/parallax_mapping.wesl, parallaxed_uv; `relief` is its definition
/// RELIEF_MAPPING. `depth_map` reads level 0 of the red channel, in which 1 is deep; `end.map` is
/// this depth.
inline End bevy(float depth_scale, float max_layer_count, int max_steps, const Vec2& original_uv,
                const Vec3& Vt, bool relief, const Sampler& depth_map) {
    End end;
    const auto sample_depth_map = [&](const Vec2& uv) {
        ++end.fetches;
        return depth_map(uv);
    };
    // Without a single layer the coordinate is returned as it is.
    end.uv = original_uv;
    if (max_layer_count < 1.0f) return end;
    Vec2 uv = original_uv;
    // Layers: WGSL's mix of most and 1 by |z|; a layer's depth is 1 / layers.
    const float view_steepness = std::fabs(Vt.z);
    const float layer_count = mix(max_layer_count, 1.0f, view_steepness);
    const float layer_depth = 1.0f / layer_count;
    // Shift a layer: scale times layer times Vt.xy times (1, -1), by |z|, from left to right.
    Vec2 delta_uv(depth_scale * layer_depth * Vt.x * 1.0f / view_steepness,
                  depth_scale * layer_depth * Vt.y * -1.0f / view_steepness);
    // Depths of ray and map at the start.
    float current_layer_depth = 0.0f;
    float texture_depth = sample_depth_map(uv);
    // While the map is strictly deeper than the ray, for i from 0 to the integer part of layers:
    for (int i = 0; texture_depth > current_layer_depth && i <= to_int(layer_count); i++) {
        // the ray's depth, its coordinate, then the look-up.
        current_layer_depth += layer_depth;
        uv += delta_uv;
        texture_depth = sample_depth_map(uv);
    }
    end.map = texture_depth;
    if (relief) {
        // Half a step back.
        delta_uv *= 0.5f;
        float delta_depth = 0.5f * layer_depth;
        uv -= delta_uv;
        current_layer_depth -= delta_depth;
        for (int i = 0; i < max_steps; i++) {
            // The look-up, then both steps halved,
            texture_depth = sample_depth_map(uv);
            end.map = texture_depth;
            delta_uv *= 0.5f;
            delta_depth *= 0.5f;
            // then on where the map is strictly deeper, else back.
            if (texture_depth > current_layer_depth) {
                uv += delta_uv;
                current_layer_depth += delta_depth;
            } else {
                uv -= delta_uv;
                current_layer_depth -= delta_depth;
            }
        }
    } else {
        // The coordinate before; map's depth minus ray's, here and there (minus current, plus
        // layer).
        const Vec2 previous_uv = uv - delta_uv;
        const float next_depth = texture_depth - current_layer_depth;
        const float previous_depth =
            sample_depth_map(previous_uv) - current_layer_depth + layer_depth;
        // Share of the coordinate before; mix of the coordinates;
        const float weight = next_depth / (next_depth - previous_depth);
        uv = {mix(uv.x, previous_uv.x, weight), mix(uv.y, previous_uv.y, weight)};
        // the mix of the differences is added to the ray's depth.
        current_layer_depth += mix(next_depth, previous_depth, weight);
    }
    // The coordinate is returned, the depth is not.
    end.uv = uv;
    end.s = current_layer_depth;
    return end;
}

}  // namespace quadrel::listings

namespace quadrel::test {

inline Listing bevy(bool relief, int relief_steps, float max_layers, float scale) {
    const auto run = [=](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            const Vec3 Vt =
                listings::bevy_Vt(b.vector3(Value::P, lane), b.vector3(Value::T, lane),
                                  b.vector3(Value::B, lane), b.vector3(Value::frame_normal, lane));
            const Sampler height = own_level(b, lane, true);
            return listings::bevy(scale, max_layers, relief_steps, b.vector2(Value::uv, lane), Vt,
                                  relief, [&](const Vec2& uv) { return 1.0f - height(uv); });
        });
    };
    const Parameters parameters = {{"relief", relief},
                                   {"relief_steps", relief_steps},
                                   {"max_layers", max_layers},
                                   {"scale", scale}};
    return {"bevy", run, parameters, relief ? "relief-binary" : "pom", true};
}

inline std::vector<Listing> bevy_listings() {
    return {bevy(false, 5, 16, 0.1f), bevy(false, 5, 100.5f, -0.3f), bevy(false, 5, 1, 0.05f),
            bevy(true, 5, 16, 0.1f),  bevy(true, 12, 33.3f, -0.2f),  bevy(true, 0, 4, 0.5f)};
}

}  // namespace quadrel::test
