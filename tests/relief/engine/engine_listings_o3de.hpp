// Open 3D Engine's parallax for one fragment; see engine_listings.hpp.
#pragma once

#include "relief/listing_runs.hpp"

namespace quadrel::listings {

/// The options and the material's numbers.
struct O3de {
    int algorithm = 2;  ///< Basic, Steep, POM, Relief, Contact
    int num_steps = 16;
    float factor = 0.05f, offset = 0;
};

/// GetNormalizedDepth of a height map's depth.
inline float o3de_normalized_depth(float start_depth, float stop_depth, float inverse_range,
                                   const Vec2& uv, End& end, const Sampler& map) {
    // The depth is 1 minus the height.
    end.map = map(uv);
    ++end.fetches;
    const float depth = 1.0f - end.map;
    // A range of 0.0001 or less is flat.
    if (!(stop_depth - start_depth > 0.0001f)) return 0.0f;
    // At least the depth at which the polygon lies.
    const float least = -start_depth * inverse_range;
    return max(depth, least);
}

/// BasicParallaxMapping; `view` is the eye's direction in tangent space.
inline End o3de_basic(const Vec2& uv, const Vec3& view, const O3de& options, const Sampler& map) {
    End end;
    // From 0 to the factor, the inverse of the range taken as 1 / (stop - start).
    const float inverse_range = 1.0f / (options.factor - 0.0f);
    const float depth = o3de_normalized_depth(0.0f, options.factor, inverse_range, uv, end, map);
    // The shift: view.xy times depth times factor.
    const Vec2 delta(view.x * depth * options.factor, view.y * depth * options.factor);
    // The offset starts as 0, and the shift is subtracted.
    const Vec2 offset(0.0f - delta.x, 0.0f - delta.y);
    end.s = 1.0f - end.map;
    end.uv = {uv.x + offset.x, uv.y + offset.y};
    return end;
}

/// AdvancedParallaxMapping.
inline End o3de_advanced(const Vec2& uv, const Vec3& view, const O3de& options,
                         const Sampler& map) {
    End end;
    const float z_inverse = 1.0f / view.z;
    const float step = 1.0f / static_cast<float>(options.num_steps);
    float current_step = 0.0f;
    // A step: the negated view vector times factor, 1 / z and step, from left to right.
    const auto along_ray = [&](float component) {
        return -component * options.factor * z_inverse * step;
    };
    const Vec3 delta(along_ray(view.x), along_ray(view.y), along_ray(view.z));
    // The range starts at minus the material's offset, and is the factor deep.
    const float start = -options.offset, stop = start + options.factor;
    const float inverse_factor = 1.0f / options.factor;
    // The start of the ray: the negated view vector times 1 / z, then times the range's start.
    Vec3 offset(-view.x * z_inverse * start, -view.y * z_inverse * start,
                -view.z * z_inverse * start);
    const auto sample_here = [&] {
        return o3de_normalized_depth(start, stop, inverse_factor,
                                     {uv.x + offset.x, uv.y + offset.y}, end, map);
    };
    float current_sample = sample_here();
    float prev_sample = 0;
    // While the sample is deeper than the ray: one step on, then the fetch.
    while (current_sample > current_step) {
        current_step += step;
        offset += delta;
        prev_sample = current_sample;
        current_sample = sample_here();
    }
    end.s = current_step;
    if (options.algorithm == 2 && current_step > 0.0f) {
        // POM: the offset between the last two samples, by the ratio of their differences.
        const float prev_step = current_step - step;
        const float current_diff = current_step - current_sample;
        const float prev_diff = prev_sample - prev_step;
        const float ratio = prev_diff / (prev_diff + current_diff);
        offset = {lerp(offset.x - delta.x, offset.x, ratio),
                  lerp(offset.y - delta.y, offset.y, ratio),
                  lerp(offset.z - delta.z, offset.z, ratio)};
        // (Not in the shader: its depth, which goes the same way as the offset's z.)
        end.s = lerp(prev_step, current_step, ratio);
    }
    if (options.algorithm == 3 && current_step > 0.0f) {
        // Relief: as many times as there are steps, half a step by the sign of the difference.
        Vec3 relief_delta = delta;
        float relief_step = step;
        for (int i = 0; i < options.num_steps; i++) {
            relief_delta *= 0.5f;
            relief_step *= 0.5f;
            const float depth_sign = sign(current_sample - current_step);
            offset += relief_delta * depth_sign;
            current_step += relief_step * depth_sign;
            current_sample = sample_here();
        }
        end.s = current_step;
    }
    if (options.algorithm == 4 && current_step > 0.0f) {
        // Contact: a step back, then on in steps that are shorter by the factor `step`.
        offset -= delta;
        current_step -= step;
        current_sample = prev_sample;
        const Vec3 adjusted_delta = delta * step;
        const float adjusted_step = step * step;
        while (current_sample > current_step) {
            current_step += adjusted_step;
            offset += adjusted_delta;
            prev_sample = current_sample;
            current_sample = sample_here();
        }
        end.s = current_step;
    }
    // Above the polygon: no offset.
    if (offset.z > 0.0f) offset = Vec3(0.0f);
    end.uv = {uv.x + offset.x, uv.y + offset.y};
    return end;
}

/// GetParallaxOffset and CalculateParallaxOffset; `eye` is the vector to the camera in tangent
/// space, not normalised.
inline End o3de(const Vec2& uv, const Vec3& eye, const O3de& options, const Sampler& map) {
    // Normalised in tangent space, transformed by the UV matrix (here the identity), normalised.
    const Vec3 view = normalize(normalize(eye));
    return options.algorithm == 0 ? o3de_basic(uv, view, options, map)
                                  : o3de_advanced(uv, view, options, map);
}

}  // namespace quadrel::listings

namespace quadrel::test {

inline Listing o3de(int algorithm, int quality, float scale, float offset) {
    const auto run = [=](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            return listings::o3de(b.vector2(Value::uv, lane), tangent_eye(b, lane),
                                  {algorithm, 16 << quality, scale, offset},
                                  undisplaced_level(b, lane));
        });
    };
    const char* const corrected[] = {"offset-limit", "steep", "pom", "relief-binary", "contact"};
    return {"o3de",
            run,
            {{"algorithm", algorithm}, {"quality", quality}, {"scale", scale}, {"offset", offset}},
            corrected[algorithm]};
}

/// Every algorithm, every quality; ranges below, across and above the polygon.
inline std::vector<Listing> o3de_listings() {
    std::vector<Listing> all = {o3de(0, 0, 0.3f, 0.1f), o3de(1, 3, 0.1f, -0.03f),
                                o3de(4, 2, 0.1f, -0.1f)};
    for (int algorithm = 0; algorithm < 5; ++algorithm) {
        all.push_back(o3de(algorithm, 0, 0.05f, 0));
        all.push_back(o3de(algorithm, 1, 0.2f, 0.07f));
    }
    return all;
}

}  // namespace quadrel::test
