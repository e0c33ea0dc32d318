// Transcription of Unity's parallax occlusion mapping, for one fragment.
#pragma once

#include "relief/listing_runs.hpp"

namespace quadrel::listings {

/// What the shader graph's node and LitDataDisplacement.hlsl hand to the function below: x and y of
/// the unit view vector in tangent space times the range in UV, then normalised.
inline Vec3 unity_view(const Vec3& view, float range) {
    return normalize(Vec3(view.x * range, view.y * range, view.z));
}

/// LitDataDisplacement.hlsl, ApplyPerPixelDisplacement: the number of steps.
inline int hdrp_steps(const Vec3& viewDirUV, float _PPDMinSamples, float _PPDMaxSamples) {
    // Common.hlsl, FastACosPos: a polynomial in |x| times the root of 1 - |x|.
    const float x = std::fabs(viewDirUV.z);
    float res = (0.0468878f * x + -0.203471f) * x + 1.570796f;
    res *= std::sqrt(1.0f - x);
    // Times 2 / pi, saturated; lerp (a + t (b - a)) and cast to int.
    const float unitAngle = clamp(res * 0.636619772367f, 0.0f, 1.0f);
    return static_cast<int>(_PPDMinSamples + unitAngle * (_PPDMaxSamples - _PPDMinSamples));
}

/// Common.hlsl, ComputeTextureLOD: derivatives of the coordinate in texels.
inline float hdrp_lod(const Vec2& ddx_, const Vec2& ddy_) {
    const float d = max(dot(ddx_, ddx_), dot(ddy_, ddy_));
    return max(0.5f * log2(d), 0.0f);
}

/// Unity Technologies, PerPixelDisplacement.hlsl, ParallaxOcclusionMapping. `height` reads level
/// `lod`.
inline End unity_pom(const Vec2& uv, const Vec3& viewDirTS, float lod, float lodThreshold,
                     int numSteps, const Sampler& height) {
    End end;
    // The height displacement: the height at the coordinate plus an offset.
    const auto ComputeHeight = [&](const Vec2& offset) {
        ++end.fetches;
        return end.map = height({uv.x + offset.x, uv.y + offset.y});
    };
    // A step of the ray's height: 1 over the number of steps.
    const float stepSize = 1.0f / static_cast<float>(numSteps);
    // The greatest offset: x and y over the negative of z.
    const Vec2 parallaxMaxOffsetTS(viewDirTS.x / -viewDirTS.z, viewDirTS.y / -viewDirTS.z);
    // The offset a step: step size times greatest offset.
    const Vec2 texOffsetPerStep(stepSize * parallaxMaxOffsetTS.x, stepSize * parallaxMaxOffsetTS.y);
    // The first step before the loop: the height at no offset, then the one a step on.
    Vec2 texOffsetCurrent(0.0f, 0.0f);
    float prevHeight = ComputeHeight(texOffsetCurrent);
    texOffsetCurrent += texOffsetPerStep;
    float currHeight = ComputeHeight(texOffsetCurrent);
    // The ray's height: the top less one step.
    float rayHeight = 1.0f - stepSize;
    // As many steps as asked for:
    for (int stepIndex = 0; stepIndex < numSteps; ++stepIndex) {
        // out where the height is above the ray's,
        if (currHeight > rayHeight) break;
        // else the height is kept, ray and offset go a step on, and the height there is read.
        prevHeight = currHeight;
        rayHeight -= stepSize;
        texOffsetCurrent += texOffsetPerStep;
        currHeight = ComputeHeight(texOffsetCurrent);
    }
    // Both ends of the last step, and how far the ray is above the height there.
    float pt0 = rayHeight + stepSize;
    float pt1 = rayHeight;
    float delta0 = pt0 - prevHeight;
    float delta1 = pt1 - currHeight;
    Vec2 offset;
    for (int i = 0; i < 3; ++i) {
        // The height at which the ray meets the line between both.
        const float intersectionHeight = (pt0 * delta1 - pt1 * delta0) / (delta1 - delta0);
        end.s = 1.0f - intersectionHeight;
        // Its offset: (1 - height) times offset a step times number of steps.
        offset.x = (1.0f - intersectionHeight) * texOffsetPerStep.x * static_cast<float>(numSteps);
        offset.y = (1.0f - intersectionHeight) * texOffsetPerStep.y * static_cast<float>(numSteps);
        // The map's height there, and out where it is within 0.01.
        currHeight = ComputeHeight(offset);
        const float delta = intersectionHeight - currHeight;
        if (std::fabs(delta) <= 0.01f) break;
        // Below the map: the lower end, else the upper one.
        if (delta < 0.0f) {
            delta1 = delta;
            pt1 = intersectionHeight;
        } else {
            delta0 = delta;
            pt0 = intersectionHeight;
        }
    }
    // The offset times 1 - saturate(lod - threshold).
    const float kept = 1.0f - clamp(lod - lodThreshold, 0.0f, 1.0f);
    offset.x *= kept;
    offset.y *= kept;
    // The node adds it to the coordinate.
    end.uv = {uv.x + offset.x, uv.y + offset.y};
    return end;
}

}  // namespace quadrel::listings

namespace quadrel::test {

inline Listing unity_pom(int steps, float scale, float lod, float lod_threshold) {
    const auto run = [=](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            const Vec3 view = listings::unity_view(tangent_view(b, lane), scale);
            return listings::unity_pom(b.vector2(Value::uv, lane), view, lod, lod_threshold, steps,
                                       of_level(b, lod));
        });
    };
    return {"unity-pom",
            run,
            {{"steps", steps}, {"scale", scale}, {"lod", lod}, {"lod_threshold", lod_threshold}},
            "interval"};
}

inline Listing hdrp_pom(int steps, int max_steps, float scale, float lod_threshold) {
    const auto run = [=](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            const Vec3 view = listings::unity_view(tangent_view(b, lane), scale);
            const TexelDerivatives texels(b, lane);
            const float lod = listings::hdrp_lod(texels.dx, texels.dy);
            return listings::unity_pom(b.vector2(Value::uv, lane), view, lod, lod_threshold,
                                       listings::hdrp_steps(view, static_cast<float>(steps),
                                                            static_cast<float>(max_steps)),
                                       of_level(b, lod));
        });
    };
    return {"unity-pom",
            run,
            {{"mode", 1},
             {"steps", steps},
             {"max_steps", max_steps},
             {"scale", scale},
             {"lod_threshold", lod_threshold}},
            "interval"};
}

inline std::vector<Listing> unity_listings() {
    return {unity_pom(5, 0.01f, 0, 0),     unity_pom(5, 0.2f, 0, 0),   unity_pom(1, -0.1f, 0.5f, 2),
            unity_pom(40, 0.3f, 1.25f, 1), unity_pom(100, 0.1f, 3, 2), hdrp_pom(5, 15, 0.02f, 5),
            hdrp_pom(40, 1, 0.3f, 1.5f)};
}

}  // namespace quadrel::test
