// Transcription of PlayCanvas' parallax mapping, for one fragment.
#pragma once

#include "relief/listing_runs.hpp"

namespace quadrel::listings {

/// The view vector as the shader chunk has it, but for the sign of y: the engine's bitangent runs
/// against v, and y is negated.
inline Vec2 playcanvas_view_uv(const Vec3& viewDirT) { return {viewDirT.x, viewDirT.y}; }

/// PlayCanvas, parallax.js, parallaxMode offset. `height_map` reads with implicit gradients.
inline End playcanvas_offset(const Vec2& uv, const Vec3& view, float factor, float base,
                             const Sampler& height_map) {
    End end;
    // The uniform: a tenth of the factor, computed in double.
    const float parallaxScale = static_cast<float>(0.1 * static_cast<double>(factor));
    // The view vector in tangent space, normalised.
    const Vec2 viewDirUv = playcanvas_view_uv(normalize(view));
    // The height over the base, times the scale.
    float height = height_map(uv);
    end.map = height;
    end.fetches = 1;
    end.s = 1.0f - height;
    height = (height - base) * parallaxScale;
    // The offset: that times the view vector.
    end.uv = {uv.x + height * viewDirUv.x, uv.y + height * viewDirUv.y};
    return end;
}

/// What the shader's occlusion mode takes from the texture and the quad.
struct PlayCanvasMap {
    Vec2 size;                             ///< texels of level 0
    Vec2 texelsDx, texelsDy;               ///< derivatives of the coordinate in texels
    std::function<Sampler(float lod)> of;  ///< look-ups of a level
};

/// PlayCanvas, parallax.js, parallaxMode occlusion. Without a look-up the depth is `unmoved`.
inline End playcanvas_occlusion(const Vec2& uv, const Vec3& view, float factor, float base,
                                float parallaxSamples, const PlayCanvasMap& map, float unmoved) {
    End end;
    const float parallaxScale = static_cast<float>(0.1 * static_cast<double>(factor));
    const Vec3 viewDirT = normalize(view);
    const Vec2 viewDirUv = playcanvas_view_uv(viewDirT);
    // The way in UV through the whole range: -scale * view / max(z, 0.0001).
    const float z = max(viewDirT.z, 0.0001f);
    const Vec2 march(-parallaxScale * viewDirUv.x / z, -parallaxScale * viewDirUv.y / z);
    // Longer than 5 times the scale: made that long.
    const float marchLength = length(march);
    const float maxMarchLength = parallaxScale * 5.0f;
    Vec2 uvSpan = march;
    if (marchLength > maxMarchLength) {
        const float share = maxMarchLength / marchLength;
        uvSpan = {march.x * share, march.y * share};
    }
    // The depth of the geometry is 1 - base; the ray enters that part of the way before it.
    const float geomDepth = 1.0f - base;
    const Vec2 entryUv(uv.x - uvSpan.x * geomDepth, uv.y - uvSpan.y * geomDepth);
    // Half the log2 of the larger squared derivative, at least 0.
    const float lod = max(
        0.0f, 0.5f * log2(max(dot(map.texelsDx, map.texelsDx), dot(map.texelsDy, map.texelsDy))));
    // Texels of that level on the way.
    const float marchTexels =
        length(Vec2(uvSpan.x * map.size.x, uvSpan.y * map.size.y)) / exp2(lod);
    // Nothing at 1 texel, all at 3.
    const float fade = clamp((marchTexels - 1.0f) / (3.0f - 1.0f), 0.0f, 1.0f);
    end.uv = uv;
    end.s = unmoved;
    if (fade > 0.0f) {
        const Sampler level = map.of(lod);
        const auto depth = [&](float d) {
            ++end.fetches;
            end.map = level({entryUv.x + uvSpan.x * d, entryUv.y + uvSpan.y * d});
            return 1.0f - end.map;
        };
        // A step for two texels, from 1 to the number of samples; real.
        const float steps = clamp(marchTexels / 2.0f, 1.0f, parallaxSamples);
        const float stepSize = 1.0f / steps;
        float rayDepth = 0.0f;
        // The first look-up is at the entry itself.
        end.map = level(entryUv);
        end.fetches = 1;
        float surfaceDepth = 1.0f - end.map;
        float prevRayDepth = rayDepth;
        // The loop variable is a float; out where the ray is at or below the surface.
        for (float i = 0.0f; i < steps; i += 1.0f) {
            if (rayDepth >= surfaceDepth) break;
            prevRayDepth = rayDepth;
            rayDepth += stepSize;
            surfaceDepth = depth(rayDepth);
        }
        float hitDepth = rayDepth;
        // With a crossing: back to the middle of the last step, then 5 halves of the half.
        if (rayDepth >= surfaceDepth) {
            float interval = (rayDepth - prevRayDepth) * 0.5f;
            hitDepth = rayDepth - interval;
            for (int i = 0; i < 5; i++) {
                interval *= 0.5f;
                const float refineDepth = depth(hitDepth);
                hitDepth += hitDepth >= refineDepth ? -interval : interval;
            }
        }
        // The depth within the range; the offset is the way from the geometry to it, faded.
        const float hitBelowTop = clamp(hitDepth, 0.0f, 1.0f);
        const float share = (hitBelowTop - geomDepth) * fade;
        end.uv = {uv.x + uvSpan.x * share, uv.y + uvSpan.y * share};
        end.s = hitBelowTop;
    }
    return end;
}

}  // namespace quadrel::listings

namespace quadrel::test {

inline Listing playcanvas_offset(float factor, float base) {
    const auto run = [=](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            return listings::playcanvas_offset(b.vector2(Value::uv, lane), tangent_view(b, lane),
                                               factor, base, undisplaced_level(b, lane));
        });
    };
    return {"playcanvas",
            run,
            {{"mode", 0}, {"height_map_factor", factor}, {"base", base}},
            "offset-limit"};
}

inline listings::PlayCanvasMap playcanvas_map(Batch<float>& b, int lane) {
    const TexelDerivatives texels(b, lane);
    return {texels.size, texels.dx, texels.dy, [&b](float lod) { return of_level(b, lod); }};
}

inline Listing playcanvas_occlusion(float factor, float base, int samples) {
    const auto run = [=](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            return listings::playcanvas_occlusion(b.vector2(Value::uv, lane), tangent_view(b, lane),
                                                  factor, base, static_cast<float>(samples),
                                                  playcanvas_map(b, lane), 1 - b.material.seat);
        });
    };
    return {"playcanvas",
            run,
            {{"mode", 1}, {"height_map_factor", factor}, {"base", base}, {"samples", samples}},
            "relief-binary"};
}

inline std::vector<Listing> playcanvas_listings() {
    return {playcanvas_offset(1, 0.5f),         playcanvas_offset(-3.7f, 0.2f),
            playcanvas_occlusion(1, 0.5f, 16),  playcanvas_occlusion(4, 1, 64),
            playcanvas_occlusion(2.3f, 0, 200), playcanvas_occlusion(-2, 0.3f, 7),
            playcanvas_occlusion(10, 0.7f, 1)};
}

}  // namespace quadrel::test
