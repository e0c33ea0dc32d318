// Learn OpenGL's parallax occlusion mapping, for one fragment: its steps in its order, in words of
// this project; the names are the shader's.
#pragma once

#include "quadrel/raster/interpolation.hpp"
#include "relief/listing_runs.hpp"

namespace quadrel::listings {

/// 5.3.parallax_mapping.fs, function ParallaxMapping. `depthMap` reads the red channel, in which 1
/// is deep, and so does `behind`, the look-up after the loop, which the fragments of a quad make
/// together. `end.map` is the depth of the last look-up before it.
inline End learnopengl(const Vec2& texCoords, const Vec3& viewDir, float heightScale,
                       float minLayers, float maxLayers, const Sampler& depthMap,
                       const Sampler& behind) {
    End end;
    // Number of layers: mix of most and least by |(0, 0, 1) . view|.
    const float numLayers =
        mix(maxLayers, minLayers, std::fabs(dot(Vec3(0.0f, 0.0f, 1.0f), viewDir)));
    // A layer's depth; the ray's, at the top.
    const float layerDepth = 1.0f / numLayers;
    float currentLayerDepth = 0.0f;
    // The whole shift, (view.xy / view.z) times scale, and that of a layer.
    const Vec2 P(viewDir.x / viewDir.z * heightScale, viewDir.y / viewDir.z * heightScale);
    const Vec2 deltaTexCoords(P.x / numLayers, P.y / numLayers);
    // Coordinate and depth at the start.
    Vec2 currentTexCoords = texCoords;
    float currentDepthMapValue = depthMap(currentTexCoords);
    ++end.fetches;
    // While the ray is above: one shift back, the look-up, one layer down.
    while (currentLayerDepth < currentDepthMapValue) {
        currentTexCoords -= deltaTexCoords;
        currentDepthMapValue = depthMap(currentTexCoords);
        ++end.fetches;
        currentLayerDepth += layerDepth;
    }
    end.s = currentLayerDepth;
    end.map = currentDepthMapValue;
    // The coordinate before; differences of depth after and before.
    const Vec2 prevTexCoords = currentTexCoords + deltaTexCoords;
    const float afterDepth = currentDepthMapValue - currentLayerDepth;
    const float beforeDepth = behind(prevTexCoords) - currentLayerDepth + layerDepth;
    ++end.fetches;
    // The share of the coordinate before, and the sum of both by their shares, that one first.
    const float weight = afterDepth / (afterDepth - beforeDepth);
    end.uv = {prevTexCoords.x * weight + currentTexCoords.x * (1.0f - weight),
              prevTexCoords.y * weight + currentTexCoords.y * (1.0f - weight)};
    return end;
}

}  // namespace quadrel::listings

namespace quadrel::test {

/// TangentFragPos of 5.3.parallax_mapping.vs in eye space, interpolated to a lane.
inline Vec3 tangent_frag_pos(const Batch<float>& batch, int lane) {
    const auto primitive = static_cast<std::size_t>(batch.primitive[lane]);
    const PrimitiveVertices& row = batch.vertices[primitive];
    const auto& w = batch.primitives[primitive].w;
    const auto vector = [](const float(&v)[3]) { return Vec3(v[0], v[1], v[2]); };
    const auto vertex = [&](int v) {
        // vec3 T = normalize(mat3(model) * aTangent);
        const Vec3 T = normalize(vector(row.tangent[v]));
        // vec3 B = normalize(mat3(model) * aBitangent);
        const Vec3 B = normalize(vector(row.binormal[v]));
        // vec3 N = normalize(mat3(model) * aNormal);
        const Vec3 N = normalize(vector(row.normal[v]));
        // mat3 TBN = transpose(mat3(T, B, N)); vs_out.TangentFragPos = TBN * vs_out.FragPos;
        const Vec3 FragPos = vector(row.position[v]);
        return Vec3(dot(T, FragPos), dot(B, FragPos), dot(N, FragPos));
    };
    const auto b = perspective_barycentrics(
        EdgeValues<float>{batch.edges[0][lane], batch.edges[1][lane], batch.edges[2][lane]},
        PerVertex<float>{w[0], w[1], w[2]});
    return interpolate(b, PerVertex<Vec3>{vertex(0), vertex(1), vertex(2)});
}

inline Listing learnopengl(float scale, int min_layers, int max_layers) {
    const auto run = [=](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& inside, const Sampler& behind) {
            const int lane = 4 * quad + i;
            // The eye, which is the origin, minus the fragment in tangent space, normalised.
            const Vec3 viewDir = normalize(Vec3(0.0f) - tangent_frag_pos(b, lane));
            return listings::learnopengl(
                b.vector2(Value::uv, lane), viewDir, scale, static_cast<float>(min_layers),
                static_cast<float>(max_layers), [&](const Vec2& uv) { return 1.0f - inside(uv); },
                [&](const Vec2& uv) { return 1.0f - behind(uv); });
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    const Parameters parameters = {
        {"scale", scale}, {"min_layers", min_layers}, {"max_layers", max_layers}};
    return {"learnopengl", run, parameters, "pom", true};
}

inline std::vector<Listing> learnopengl_listings() {
    return {learnopengl(0.1f, 8, 32), learnopengl(-0.03f, 1, 100), learnopengl(0.3f, 20, 5)};
}

}  // namespace quadrel::test
