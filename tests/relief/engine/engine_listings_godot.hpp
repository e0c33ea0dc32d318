// Godot Engine's height map, for one fragment: its steps in its order, in words of this project;
// the names are the shader's.
#pragma once

#include "relief/listing_runs.hpp"

namespace quadrel::listings {

/// What the two modes share: the view vector in tangent space. T and B run along growing u and v,
/// which is where the engine's tangent and negated bitangent point.
inline Vec3 godot_view_dir(const Vec3& vertex, const Vec3& T, const Vec3& B, const Vec3& normal) {
    // The unit vector to the eye,
    const Vec3 eye = normalize(-vertex);
    // times the matrix with the columns tangent, bitangent, normal: their dot products;
    const Vec3 product(dot(eye, T), dot(eye, B), dot(eye, normal));
    // normalised once more.
    return normalize(product);
}

/// scene/resources/material.cpp, BaseMaterial3D::_update_shader, height block without deep
/// parallax. `heightmap` reads the red channel.
inline End godot_simple(const Vec2& base_uv, const Vec3& view_dir, float heightmap_scale,
                        const Sampler& heightmap) {
    End end;
    // The depth: 1 minus the map at the coordinate.
    end.map = heightmap(base_uv);
    end.fetches = 1;
    const float depth = 1.0f - end.map;
    // The coordinate minus (((view.xy times depth) times scale) times 0.01).
    end.uv = {base_uv.x - view_dir.x * depth * heightmap_scale * 0.01f,
              base_uv.y - view_dir.y * depth * heightmap_scale * 0.01f};
    end.s = depth;
    return end;
}

/// The height block with deep parallax. `behind` is the look-up after the loop, which the fragments
/// of a quad make together.
inline End godot_deep(const Vec2& base_uv, const Vec3& view_dir, float heightmap_scale,
                      int heightmap_min_layers, int heightmap_max_layers, const Sampler& heightmap,
                      const Sampler& behind) {
    End end;
    // Number of layers: mix of most and least by |(0, 0, 1) . view|.
    const float num_layers =
        mix(static_cast<float>(heightmap_max_layers), static_cast<float>(heightmap_min_layers),
            std::fabs(dot(Vec3(0.0f, 0.0f, 1.0f), view_dir)));
    // A layer's depth, 1 / layers, and the current one, 0.
    const float layer_depth = 1.0f / num_layers;
    float current_depth = 0.0f;
    // The whole shift: (view.xy times scale) times 0.01; the shift a layer: that by the layers.
    const Vec2 p(view_dir.x * heightmap_scale * 0.01f, view_dir.y * heightmap_scale * 0.01f);
    const Vec2 delta(p.x / num_layers, p.y / num_layers);
    // From the fragment's coordinate, its depth: 1 minus the map there.
    Vec2 ofs = base_uv;
    end.map = heightmap(ofs);
    ++end.fetches;
    float depth = 1.0f - end.map;
    // While the current depth is less than the map's:
    while (current_depth < depth) {
        // one shift back against the view vector,
        ofs -= delta;
        // the depth there,
        end.map = heightmap(ofs);
        ++end.fetches;
        depth = 1.0f - end.map;
        // one layer down.
        current_depth += layer_depth;
    }
    end.s = current_depth;
    // The coordinate before.
    const Vec2 prev_ofs = ofs + delta;
    // Map's depth minus ray's depth, here and there (the ray's as current minus, plus layer).
    const float after_depth = depth - current_depth;
    const float before_depth = (1.0f - behind(prev_ofs)) - current_depth + layer_depth;
    ++end.fetches;
    // The share of the coordinate before: after / (after - before); mix.
    const float weight = after_depth / (after_depth - before_depth);
    end.uv = {mix(ofs.x, prev_ofs.x, weight), mix(ofs.y, prev_ofs.y, weight)};
    return end;
}

}  // namespace quadrel::listings

namespace quadrel::test {

inline Listing godot(bool deep, float scale, int min_layers, int max_layers) {
    const auto run = [=](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& inside, const Sampler& behind) {
            const int lane = 4 * quad + i;
            const Vec3 view_dir = listings::godot_view_dir(
                b.vector3(Value::P, lane), b.vector3(Value::T, lane), b.vector3(Value::B, lane),
                b.vector3(Value::frame_normal, lane));
            const Vec2 uv = b.vector2(Value::uv, lane);
            return deep ? listings::godot_deep(uv, view_dir, scale, min_layers, max_layers, inside,
                                               behind)
                        : listings::godot_simple(uv, view_dir, scale, inside);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    const Parameters parameters = {
        {"deep", deep}, {"scale", scale}, {"min_layers", min_layers}, {"max_layers", max_layers}};
    return {"godot", run, parameters, deep ? "pom" : "offset-limit"};
}

inline std::vector<Listing> godot_listings() {
    return {godot(false, 5, 8, 32), godot(false, -16, 8, 32), godot(true, 5, 8, 32),
            godot(true, -8, 1, 64), godot(true, 16, 40, 3),   godot(true, 10, 1, 1)};
}

}  // namespace quadrel::test
