// Babylon.js' parallax for one fragment; see engine_listings.hpp.
#pragma once

#include "relief/listing_runs.hpp"

namespace quadrel::listings {

/// The axes of the fragment's frame as the engine has them, and the material's numbers.
struct Babylon {
    Vec3 T, B, normal_w;
    float scale = 0.05f;
    bool right_handed = false;  ///< PARALLAX_RHS
};

/// The transposed frame times a vector.
inline Vec3 babylon_into_frame(const Babylon& frame, const Vec3& v) {
    return {dot(frame.T, v), dot(frame.B, v), dot(frame.normal_w, v)};
}

/// parallaxOffset; `view_w` is the unit vector from the surface to the eye.
inline End babylon_offset(const Vec2& uv, const Vec3& view_w, const Babylon& given,
                          const Sampler& bump_alpha) {
    End end;
    const Vec3 view_dir = babylon_into_frame(given, view_w);
    // The height at the bump map's own coordinate.
    end.map = bump_alpha(uv);
    end.fetches = 1;
    end.s = 1.0f - end.map;
    // Scale times view.xy times height.
    const Vec2 offset(given.scale * view_dir.x * end.map, given.scale * view_dir.y * end.map);
    // As it is in right-handed systems, else negated.
    end.uv = given.right_handed ? Vec2(uv.x + offset.x, uv.y + offset.y)
                                : Vec2(uv.x + -offset.x, uv.y + -offset.y);
    return end;
}

/// parallaxOcclusion.
inline End babylon_occlusion(const Vec2& uv, const Vec3& view_w, const Babylon& given,
                             const Sampler& bump_alpha) {
    End end;
    // It is called with the vector from the eye, and with the normal, both in the frame.
    const Vec3 view = babylon_into_frame(given, -view_w);
    const Vec3 normal = babylon_into_frame(given, given.normal_w);
    // The limit: the length in the plane over z, times the scale.
    float limit = length(Vec2(view.x, view.y)) / view.z;
    limit *= given.scale;
    // The largest offset: the direction in the plane times the limit.
    const Vec2 direction = normalize(Vec2(view.x, view.y));
    const Vec2 max_offset(direction.x * limit, direction.y * limit);
    // Samples: 15 + dot(view, normal) * (4 - 15); their distance.
    const float num_samples = 15.0f + (dot(view, normal) * (4.0f - 15.0f));
    const float step_size = 1.0f / num_samples;
    float ray_height = 1.0f;
    Vec2 offset(0.0f, 0.0f), last_offset(0.0f, 0.0f);
    float last_height = 1.0f;
    bool keep_working = true;
    for (int i = 0; i < 15; i++) {
        const float height = bump_alpha({uv.x + offset.x, uv.y + offset.y});
        ++end.fetches;
        if (!keep_working) continue;
        end.map = height;
        if (height > ray_height) {
            // Strictly above the ray: between the last two offsets, by the ratio of the gaps.
            const float delta1 = height - ray_height;
            const float delta2 = (ray_height + step_size) - last_height;
            const float ratio = delta1 / (delta1 + delta2);
            offset = {ratio * last_offset.x + (1.0f - ratio) * offset.x,
                      ratio * last_offset.y + (1.0f - ratio) * offset.y};
            keep_working = false;
        } else {
            ray_height -= step_size;
            last_offset = offset;
            // On by a step of the largest offset: subtracted in right-handed systems, else added.
            const Vec2 a_step(step_size * max_offset.x, step_size * max_offset.y);
            if (given.right_handed) {
                offset -= a_step;
            } else {
                offset += a_step;
            }
            last_height = height;
        }
    }
    end.s = 1.0f - ray_height;
    end.uv = {uv.x + offset.x, uv.y + offset.y};
    return end;
}

}  // namespace quadrel::listings

namespace quadrel::test {

inline Listing babylon(bool occlusion, float scale, bool right_handed, bool own_tangents) {
    const auto run = [=](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& bump_alpha) {
            const int lane = 4 * quad + i;
            // The engine's own frame points to decreasing u and v in left-handed systems.
            const float growing = right_handed || own_tangents ? 1.0f : -1.0f;
            const listings::Babylon given{
                b.vector3(Value::T, lane) * growing, b.vector3(Value::B, lane) * growing,
                b.vector3(Value::frame_normal, lane), scale, right_handed};
            const Vec3 view_w = normalize(Vec3(0.0f) - b.vector3(Value::P, lane));
            const Vec2 uv = b.vector2(Value::uv, lane);
            return occlusion ? listings::babylon_occlusion(uv, view_w, given, bump_alpha)
                             : listings::babylon_offset(uv, view_w, given, bump_alpha);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    const Parameters parameters = {{"parallax_occlusion", occlusion},
                                   {"scale", scale},
                                   {"right_handed", right_handed},
                                   {"own_tangents", own_tangents}};
    return {"babylon", run, parameters, occlusion ? "pom" : "offset-limit"};
}

inline std::vector<Listing> babylon_listings() {
    std::vector<Listing> all;
    for (const bool occlusion : {false, true})
        for (const bool right_handed : {false, true})
            for (const bool own_tangents : {false, true})
                all.push_back(
                    babylon(occlusion, right_handed ? 0.2f : 0.05f, right_handed, own_tangents));
    return all;
}

}  // namespace quadrel::test
