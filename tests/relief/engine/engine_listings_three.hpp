// Transcriptions of what three.js has for parallax, for one fragment.
#pragma once

#include "relief/listing_runs.hpp"

namespace quadrel::listings {

enum class ThreeMode { basic, steep, occlusion, relief };

/// three.js, ParallaxShader.js, parallaxMap. `V` holds the view vector in texture coordinates a
/// world length and along the normal (vProjVtex). The map has 1 - height.
inline End three_parallax(const Vec2& vUv, const Vec3& V, ThreeMode mode, float parallaxScale,
                          float parallaxMinLayers, float parallaxMaxLayers, const Sampler& in_loop,
                          const Sampler& behind_loop) {
    End end;
    const auto texture2D = [&](const Sampler& height, const Vec2& uv) {
        ++end.fetches;
        end.map = height(uv);
        return 1.0f - end.map;
    };
    if (mode == ThreeMode::basic) {
        // The depth at the coordinate; the offset is scale * V.xy * depth.
        const float initialHeight = texture2D(in_loop, vUv);
        end.s = initialHeight;
        end.uv = {vUv.x - parallaxScale * V.x * initialHeight,
                  vUv.y - parallaxScale * V.y * initialHeight};
        return end;
    }
    // The number of layers: mix(max, min, |(0, 0, 1) . V|).
    const float numLayers =
        mix(parallaxMaxLayers, parallaxMinLayers, std::fabs(dot(Vec3(0.0f, 0.0f, 1.0f), V)));
    const float layerHeight = 1.0f / numLayers;
    float currentLayerHeight = 0.0f;
    // A layer's shift: scale * V.xy / V.z / layers.
    const Vec2 dtex(parallaxScale * V.x / V.z / numLayers, parallaxScale * V.y / V.z / numLayers);
    Vec2 currentTextureCoords = vUv;
    float heightFromTexture = texture2D(in_loop, currentTextureCoords);
    for (int i = 0; i < 30; i += 1) {
        // Out where the depth is at most the layer's; else down a layer, on by its shift, and
        // the look-up there.
        if (heightFromTexture <= currentLayerHeight) break;
        currentLayerHeight += layerHeight;
        currentTextureCoords -= dtex;
        heightFromTexture = texture2D(in_loop, currentTextureCoords);
    }
    end.s = currentLayerHeight;
    end.uv = currentTextureCoords;
    if (mode == ThreeMode::relief) {
        // Half a layer back and up.
        Vec2 deltaTexCoord = dtex / 2.0f;
        float deltaHeight = layerHeight / 2.0f;
        currentTextureCoords += deltaTexCoord;
        currentLayerHeight -= deltaHeight;
        for (int i = 0; i < 5; i += 1) {
            // Halves; the look-up; on and down where the depth is more than the ray's, else back.
            deltaTexCoord /= 2.0f;
            deltaHeight /= 2.0f;
            heightFromTexture = texture2D(behind_loop, currentTextureCoords);
            if (heightFromTexture > currentLayerHeight) {
                currentTextureCoords -= deltaTexCoord;
                currentLayerHeight += deltaHeight;
            } else {
                currentTextureCoords += deltaTexCoord;
                currentLayerHeight -= deltaHeight;
            }
        }
        end.s = currentLayerHeight;
        end.uv = currentTextureCoords;
    } else if (mode == ThreeMode::occlusion) {
        // The layer before; the depths over the ray's at both.
        const float last = end.map;
        const Vec2 prevTCoords(currentTextureCoords.x + dtex.x, currentTextureCoords.y + dtex.y);
        const float nextH = heightFromTexture - currentLayerHeight;
        const float prevH = texture2D(behind_loop, prevTCoords) - currentLayerHeight + layerHeight;
        // The height reported is that of the layer, not of the one before.
        end.map = last;
        // Weight of the layer before: next / (next - prev); weighted sum, the layer before first.
        const float weight = nextH / (nextH - prevH);
        end.uv = {prevTCoords.x * weight + currentTextureCoords.x * (1.0f - weight),
                  prevTCoords.y * weight + currentTextureCoords.y * (1.0f - weight)};
    }
    return end;
}

/// three.js, AccessorsUtils.js, parallaxUV, its scale a factor times 1 - height. `direction` is the
/// unit view vector in tangent space.
inline End three_parallax_uv(const Vec2& uv, const Vec3& direction, float factor,
                             const Sampler& height) {
    End end;
    end.map = height(uv);
    end.fetches = 1;
    end.s = 1.0f - end.map;
    // uv.sub(parallaxDirection.mul(scale))
    const float scale = factor * (1.0f - end.map);
    end.uv = {uv.x - direction.x * scale, uv.y - direction.y * scale};
    return end;
}

}  // namespace quadrel::listings

namespace quadrel::test {

inline Listing three_parallax(listings::ThreeMode mode, float scale, int min_layers,
                              int max_layers) {
    const auto run = [=](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& in_loop, const Sampler& behind_loop) {
            const int lane = 4 * quad + i;
            const Vec3 V = normalize(Vec3(0.0f) - b.vector3(Value::P, lane));
            const auto J = [&](int row) {
                return Vec3(b.real(Value::J, lane, 3 * row), b.real(Value::J, lane, 3 * row + 1),
                            b.real(Value::J, lane, 3 * row + 2));
            };
            const Vec3 in_texture(dot(J(0), V), dot(J(1), V),
                                  dot(b.vector3(Value::frame_normal, lane), V));
            return listings::three_parallax(b.vector2(Value::uv, lane), in_texture, mode, scale,
                                            static_cast<float>(min_layers),
                                            static_cast<float>(max_layers), in_loop, behind_loop);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    return {"three-parallax",
            run,
            {{"mode", static_cast<int>(mode)},
             {"scale", scale},
             {"min_layers", min_layers},
             {"max_layers", max_layers}},
            "relief-binary"};
}

inline Listing three_parallax_uv(float scale) {
    const auto run = [=](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            return listings::three_parallax_uv(b.vector2(Value::uv, lane), tangent_view(b, lane),
                                               scale, undisplaced_level(b, lane));
        });
    };
    return {"three-parallax-uv", run, {{"scale", scale}}, "offset-limit"};
}

inline std::vector<Listing> three_listings() {
    std::vector<Listing> all = {three_parallax_uv(0.3f), three_parallax_uv(-0.05f)};
    using enum listings::ThreeMode;
    for (const auto mode : {basic, steep, occlusion, relief}) {
        all.push_back(three_parallax(mode, 0.3f, 8, 60));
        all.push_back(three_parallax(mode, -0.1f, 5, 1));
    }
    all.push_back(three_parallax(relief, 0.005f, 20, 25));
    return all;
}

}  // namespace quadrel::test
