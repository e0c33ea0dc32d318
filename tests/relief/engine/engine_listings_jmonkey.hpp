// jMonkeyEngine's parallax for one fragment; see engine_listings.hpp.
#pragma once

#include "relief/listing_runs.hpp"

namespace quadrel::listings {

/// classicParallaxOffset; `vViewDir` is the vector to the eye in tangent space.
inline End jmonkey_classic(const Vec2& texCoord, const Vec3& vViewDir, float parallaxScale,
                           const Sampler& parallaxMap) {
    End end;
    // The height at the undisplaced coordinate.
    end.map = parallaxMap(texCoord);
    end.fetches = 1;
    end.s = 1.0f - end.map;
    // The bias is the scale times -0.6.
    const float heightBias = parallaxScale * -0.6f;
    // The vector, normalised.
    const Vec3 view = normalize(vViewDir);
    // The height, scaled and biased, times the vector's z.
    const float h = (end.map * parallaxScale + heightBias) * view.z;
    // That times the vector's xy is added.
    end.uv = {texCoord.x + h * view.x, texCoord.y + h * view.y};
    return end;
}

/// steepParallaxOffset.
inline End jmonkey_steep(const Vec2& texCoord, const Vec3& vViewDir, float parallaxScale,
                         const Sampler& parallaxMap) {
    End end;
    // The direction of the offset: the vector's xy, normalised.
    const Vec2 direction = normalize(Vec2(vViewDir.x, vViewDir.y));
    // Its length: the root of the squared length less the squared z, over z.
    const float fLength = length(vViewDir);
    const float parallax_length =
        std::sqrt(fLength * fLength - vViewDir.z * vViewDir.z) / vViewDir.z;
    // Both multiplied, then by the scale, of which 0.3 is left.
    parallaxScale *= 0.3f;
    const Vec2 offset_ts(direction.x * parallax_length * parallaxScale,
                         direction.y * parallax_length * parallaxScale);
    // Samples: a mix of 6 and 1000 times that scale by 1 - z of the normalised vector; real.
    const Vec3 eye_dir = normalize(vViewDir);
    const float num_samples = mix(6.0f, 1000.0f * parallaxScale, 1.0f - eye_dir.z);
    const float step_size = 1.0f / num_samples;
    const Vec2 offset_a_step(step_size * offset_ts.x, step_size * offset_ts.y);
    // The height starts as 0, the bound as 1.
    float curr_height = 0.0f, prev_height = 1.0f, bound = 1.0f, step_index = 0.0f;
    Vec2 current = texCoord;
    // While samples are left and the height is at most the bound: a step back, the height there,
    // and the bound a step down.
    while (step_index < num_samples && curr_height <= bound) {
        current -= offset_a_step;
        prev_height = curr_height;
        curr_height = parallaxMap(current);
        ++end.fetches;
        bound -= step_size;
        step_index += 1.0f;
    }
    // The lines of bounds and of heights through the last two samples, and where they meet.
    const Vec2 pt1(bound, curr_height), pt2(bound + step_size, prev_height);
    const float delta2 = pt2.x - pt2.y, delta1 = pt1.x - pt1.y;
    const float denominator = delta2 - delta1;
    const float amount = (pt1.x * delta2 - pt2.x * delta1) / denominator;
    // (Not in the shader: the depth of that bound.)
    end.s = 1.0f - amount;
    end.map = curr_height;
    // 1 minus that share of the whole offset is subtracted.
    end.uv = {texCoord.x - offset_ts.x * (1.0f - amount),
              texCoord.y - offset_ts.y * (1.0f - amount)};
    return end;
}

}  // namespace quadrel::listings

namespace quadrel::test {

/// With the vector of PBRLighting: normalised before it is taken to tangent space, not there.
inline Listing jmonkey(bool steep, float scale) {
    const auto run = [=](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& map) {
            const int lane = 4 * quad + i;
            const Vec2 uv = b.vector2(Value::uv, lane);
            const Vec3 view = tangent_view(b, lane);
            return steep ? listings::jmonkey_steep(uv, view, scale, map)
                         : listings::jmonkey_classic(uv, view, scale, map);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    return {
        "jmonkey", run, {{"steep", steep}, {"scale", scale}}, steep ? "pom-dxsdk" : "offset-limit"};
}

/// Fewer samples along the surface than seen from above, as many, and more.
inline std::vector<Listing> jmonkey_listings() {
    return {jmonkey(false, 0.05f), jmonkey(false, 0.4f), jmonkey(true, 0.005f),
            jmonkey(true, 0.02f),  jmonkey(true, 0.05f), jmonkey(true, 0.4f)};
}

}  // namespace quadrel::test
