// Transcriptions of published cone and sphere steps, line by line, for one fragment; above each
// line of code stands the line of the listing that it transcribes, or what that line does. The
// built-ins are those of num/functions.hpp.
#pragma once

#include <cmath>
#include <functional>

#include "quadrel/num/functions.hpp"

namespace quadrel::listings {

using ConeVec2 = vec2<float>;
using ConeVec3 = vec3<float>;

/// Height and what the map holds of the cone, its ratio or the root of it, at a coordinate.
using ConeSampler = std::function<ConeVec2(const ConeVec2&)>;
/// Distance at (u, v, z).
using VolumeSampler = std::function<float(const ConeVec3&)>;

/// Where a listing ends: coordinate, and depth below the top plane.
struct ConeEnd {
    ConeVec2 uv;
    float s = 0;
};

/// Rabbid76, "Parallax Mapping", Cone Step Mapping: ConeStep. GetHeightAndCone, which the page does
/// not show, is that of the repository's example: texture().rg, clamped to [0, 1].
inline ConeEnd rabbid_cone_step(const ConeVec3& texDir3D, const ConeVec2& texCoord,
                                const ConeVec2& tex_size, const ConeSampler& cone_map) {
    // float maxBumpHeight = 1.0;
    const float maxBumpHeight = 1.0f;
    const ConeVec2 xy(texDir3D.x, texDir3D.y);
    // vec2 R = normalize(vec2(length(texDir3D.xy), texDir3D.z));
    const ConeVec2 R = normalize(ConeVec2(length(xy), texDir3D.z));
    // vec2 P = R * maxBumpHeight / texDir3D.z;
    const ConeVec2 P = R * maxBumpHeight / texDir3D.z;
    // vec2 min_tex_step = normalize(texDir3D.xy) / tex_size;
    const ConeVec2 min_tex_step = normalize(xy) / tex_size;
    // float min_step = length(min_tex_step) * 1.0/R.x;
    const float min_step = length(min_tex_step) * 1.0f / R.x;
    // float t = 0.0;
    float t = 0.0f;
    // for ( int i = 0; i < max_no_of_steps; ++ i )
    for (int i = 0; i < 30; ++i) {
        // vec3 sample_pt = vec3(texCoord.xy, maxBumpHeight) + texDir3D * t;
        const ConeVec2 sample_pt = texCoord + xy * t;
        // vec2 h_and_c = GetHeightAndCone( sample_pt.xy );
        const ConeVec2 h_and_c = clamp(cone_map(sample_pt), 0.0f, 1.0f);
        // float h = h_and_c.x * maxBumpHeight;
        const float h = h_and_c.x * maxBumpHeight;
        // float c = h_and_c.y * h_and_c.y / maxBumpHeight;
        const float c = h_and_c.y * h_and_c.y / maxBumpHeight;
        // vec2 C = P + R * t;
        const ConeVec2 C = P + R * t;
        // if ( C.y <= h ) break;
        if (C.y <= h) break;
        // vec2 Q = vec2(C.x, h);
        const ConeVec2 Q(C.x, h);
        // vec2 S = normalize(vec2(c, 1.0));
        const ConeVec2 S = normalize(ConeVec2(c, 1.0f));
        // float new_t = dot(Q-P, vec2(S.y, -S.x)) / dot(R, vec2(S.y, -S.x));
        const float new_t = dot(Q - P, ConeVec2(S.y, -S.x)) / dot(R, ConeVec2(S.y, -S.x));
        // t = max(t+min_step, new_t);
        t = max(t + min_step, new_t);
    }
    // vec2 texC = texCoord.xy + texDir3D.xy * t;
    return {texCoord + xy * t, -texDir3D.z * t};
}

/// J. Dummer, "Cone Step Mapping", 2006: the exact variant. `ds` is the unit ray, z positive.
inline ConeEnd dummer_exact(const ConeVec3& ds, const ConeVec2& dp, int texels,
                            const ConeSampler& cone_map) {
    // w is the width of a texel
    const float w = 1.0f / static_cast<float>(texels);
    // iz is the length of the ray's part along the surface
    const float iz = sqrt(1.0f - ds.z * ds.z);
    // the distance along the ray starts at 0
    float sc = 0.0f;
    // t is the texel there, its cone's ratio the square of its green
    ConeVec2 t = cone_map(dp);
    // while the ray is above the surface
    while (1.0f - ds.z * sc > t.x) {
        // go on by a texel's width and by the cone
        sc = sc + w + (1.0f - ds.z * sc - t.x) / (ds.z + iz / (t.y * t.y));
        // and look again
        t = cone_map(dp + ConeVec2(ds.x, ds.y) * sc);
    }
    // back by a texel's width
    sc = sc - w;
    return {dp + ConeVec2(ds.x, ds.y) * sc, ds.z * sc};
}

/// GPU Gems 3, chapter 18, disc: cone stepping. v = (view.xy * depth, |view.z|), p = (uv, 0).
inline ConeEnd gg3_cone(const ConeVec2& uv, const ConeVec2& v_xy, float v_z,
                        const ConeSampler& cone_map) {
    ConeVec2 p = uv;
    float p_z = 0;
    // dist is the length of v.xy
    const float dist = length(v_xy);
    // 15 times
    for (int i = 0; i < 15; ++i) {
        // fetch the texel at p.xy
        const ConeVec2 tex = cone_map(p);
        // the height over the surface is saturate(depth - p.z)
        const float height = saturate((1.0f - tex.x) - p_z);
        // p advances by v * (cone_ratio * height / (dist + cone_ratio))
        const float step = tex.y * height / (dist + tex.y);
        p = p + v_xy * step;
        p_z = p_z + v_z * step;
    }
    return {p, p_z};
}

/// The same: relaxed cone stepping. v = view / view.z.
inline ConeEnd gg3_relaxed(const ConeVec2& uv, const ConeVec2& v_xy, const ConeSampler& cone_map) {
    // v is the ray over its z; p0 = p
    ConeVec2 v = v_xy, p = uv;
    float v_z = 1, p_z = 0;
    // dist is the length of v.xy
    const float dist = length(v);
    // 15 cone steps
    for (int i = 0; i < 15; ++i) {
        const ConeVec2 tex = cone_map(p);
        const float height = saturate((1.0f - tex.x) - p_z);
        const float step = tex.y * height / (dist + tex.y);
        p = p + v * step;
        p_z = p_z + v_z * step;
    }
    // v *= p.z * 0.5
    v = v * (p_z * 0.5f);
    v_z = v_z * (p_z * 0.5f);
    // p = p0 + v
    p = uv + v;
    p_z = v_z;
    // 8 binary steps
    for (int i = 0; i < 8; ++i) {
        const ConeVec2 tex = cone_map(p);
        // v *= 0.5
        v = v * 0.5f;
        v_z = v_z * 0.5f;
        // forward above the surface, back below it
        if (p_z < 1.0f - tex.x) {
            p = p + v;
            p_z = p_z + v_z;
        } else {
            p = p - v;
            p_z = p_z - v_z;
        }
    }
    return {p, p_z};
}

/// W. Donnelly, GPU Gems 2, chapter 8, disc: the fragment program's loop. `direction` has z in
/// units of the relief's depth measured in layers.
inline ConeEnd donnelly(const ConeVec2& uv, const ConeVec3& direction, float layers, float width,
                        const VolumeSampler& distance_map) {
    // the offset is the normalised direction
    ConeVec3 offset = normalize(direction);
    // its x and y scaled by depth over width
    offset = ConeVec3(offset.x * (layers / width), offset.y * (layers / width), offset.z);
    // the coordinate starts at the top
    ConeVec3 texcoord(uv.x, uv.y, 1.0f);
    // 16 iterations
    for (int i = 0; i < 16; ++i) {
        // multiply-add of the distance there
        texcoord = offset * distance_map(texcoord) + texcoord;
    }
    return {ConeVec2(texcoord.x, texcoord.y), 1.0f - texcoord.z};
}

}  // namespace quadrel::listings
