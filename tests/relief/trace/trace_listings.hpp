// Transcriptions of published listings, line by line, for one fragment: what the traces called
// "published", and those that are named after a listing, have to reproduce bit for bit. Above each
// line of code stands the line of the listing that it transcribes, or what that line does (braces
// and declarations left out); the names are the listing's. The built-ins are those of
// num/functions.hpp over plain floats; the samplers are functions that a test hands in.
#pragma once

#include <functional>

#include "quadrel/num/math.hpp"

namespace quadrel::listings {

using Vec2 = vec2<float>;
using Vec3 = vec3<float>;
/// The height at a coordinate: the channel that the listing reads.
using Sampler = std::function<float(const Vec2&)>;

/// Where a listing ends up, and how it got there.
struct End {
    Vec2 uv;
    float s = 0;    ///< depth of the ray's end below the top plane
    float map = 0;  ///< height that was read last
    int fetches = 0;
};

/// T. Welsh, "Parallax Mapping with Offset Limiting", 2004: the fragment programs of sections 4.2
/// (limited = false) and 4.3. `texcoord3` is the eye vector in tangent space.
inline End welsh(const Vec2& texcoord0, const Vec3& texcoord3, float scale, float bias,
                 bool limited, const Sampler& texture2) {
    End end;
    // DP3 temp, fragment.texcoord[3], fragment.texcoord[3];
    float temp = texcoord3.x * texcoord3.x + texcoord3.y * texcoord3.y + texcoord3.z * texcoord3.z;
    // RSQ temp, temp.x;
    temp = 1.0f / std::sqrt(temp);
    // MUL eyevecs, fragment.texcoord[3], temp;
    const Vec3 eyevecs(texcoord3.x * temp, texcoord3.y * temp, texcoord3.z * temp);
    // TEX height, fragment.texcoord[0], texture[2], 2D;
    float height = texture2(texcoord0);
    end.map = height;
    // MAD height, height, 0.04, -0.02; # scale and bias
    height = height * scale + bias;
    if (!limited) {
        // RCP temp, eyevecs.z;
        temp = 1.0f / eyevecs.z;
        // MUL height, height, temp;
        height = height * temp;
    }
    // MAD newtexcoord, height, eyevecs, fragment.texcoord[0];
    end.uv = {height * eyevecs.x + texcoord0.x, height * eyevecs.y + texcoord0.y};
    end.s = 1.0f - end.map;
    end.fetches = 1;
    return end;
}

/// Unity, UnityCG.cginc, ParallaxOffset: its steps in its order, in words of this project.
inline End unity(const Vec2& uv, const Vec3& view, float height, const Sampler& map) {
    End end;
    end.map = map(uv);
    end.fetches = 1;
    end.s = 1.0f - end.map;
    // The height times its range, minus half of the range.
    const float h = end.map * height - height / 2.0f;
    // The view vector normalised, 0.42 added to its z.
    Vec3 v = normalize(view);
    v.z += 0.42f;
    // The height times (v.xy / v.z).
    end.uv = {uv.x + h * (v.x / v.z), uv.y + h * (v.y / v.z)};
    return end;
}

/// M. McGuire, M. McGuire, "Steep Parallax Mapping", 2005: the view march; `constant_xy` takes the
/// two commented lines for delta and step. `numSteps` is 5 in the listing.
inline End mcguire(const Vec2& texCoord, const Vec3& _tsE, float numSteps, float bumpScale,
                   bool constant_xy, const Sampler& normalBumpMap) {
    End end;
    // float height = 1.0;
    float height = 1.0f;
    // vec2 offsetCoord = texCoord.xy;
    Vec2 offsetCoord = texCoord;
    // vec4 NB = texture2D(normalBumpMap, offsetCoord);
    float NB_a = normalBumpMap(offsetCoord);
    end.fetches = 1;
    // vec3 tsE = normalize(_tsE);
    const Vec3 tsE = normalize(_tsE);
    // numSteps = mix(numSteps*2, numSteps, tsE.z);
    numSteps = mix(numSteps * 2, numSteps, tsE.z);
    float step;
    Vec2 delta;
    if (!constant_xy) {
        // step = 1.0 / numSteps;
        step = 1.0f / numSteps;
        // delta = vec2(-_tsE.x, _tsE.y) * bumpScale / (_tsE.z * numSteps);
        const float divisor = _tsE.z * numSteps;
        delta = {-_tsE.x * bumpScale / divisor, _tsE.y * bumpScale / divisor};
    } else {
        // // delta = 1.0 / (25.6 * numSteps) * vec2(-tsE.x, tsE.y);
        const float length_xy = 1.0f / (25.6f * numSteps);
        delta = {length_xy * -tsE.x, length_xy * tsE.y};
        // // step = tsE.z * bumpScale * (25.6 * numSteps) / (length(tsE.xy) * 400);
        step = tsE.z * bumpScale * (25.6f * numSteps) / (length(Vec2(tsE.x, tsE.y)) * 400.0f);
    }
    // while (NB.a < height) {
    while (NB_a < height) {
        // height -= step;
        height -= step;
        // offsetCoord += delta;
        offsetCoord += delta;
        // NB = texture2D(normalBumpMap, offsetCoord);
        NB_a = normalBumpMap(offsetCoord);
        ++end.fetches;
    }
    end.s = 1.0f - height;
    end.uv = offsetCoord;
    // height = NB.a;
    end.map = NB_a;
    return end;
}

/// T. Renk, FlightGear wiki, relief maps, 2016: height_coord_shift and its call.
inline End flightgear(const Vec2& texCoord, const Vec3& relPos, float relief_vscale,
                      float relief_hresolution, int npoints, const Sampler& heightmap_texture) {
    End end;
    const Vec2 base_pos = texCoord;
    // vec3 nRay = normalize(relPos);
    const Vec3 nRay = normalize(relPos);
    // float sampling_resolution = relief_vscale/float(npoints) * 0.6;
    const float sampling_resolution = relief_vscale / static_cast<float>(npoints) * 0.6f;
    // vec3 vRay = -sampling_resolution * nRay;
    const Vec3 vRay(-sampling_resolution * nRay.x, -sampling_resolution * nRay.y,
                    -sampling_resolution * nRay.z);
    // vec3 pos = vec3(base_pos, 0.0);
    Vec3 pos(base_pos.x, base_pos.y, 0.0f);
    // pos += vRay * float(npoints);
    pos += vRay * static_cast<float>(npoints);
    // for (int i = 0; i < npoints; i++)
    for (int i = 0; i < npoints; i++) {
        // height = height_function (pos.xy);
        // (vec4 height_texel = texture2D (heightmap_texture, pos/relief_hresolution);)
        end.map = heightmap_texture({pos.x / relief_hresolution, pos.y / relief_hresolution});
        ++end.fetches;
        // (return relief_vscale * height_texel.a;)
        const float height = relief_vscale * end.map;
        // if (height > pos.z)
        if (height > pos.z) break;
        // pos -= vRay;
        pos -= vRay;
    }
    // return pos.xy - base_pos.xy;
    const Vec2 shift(pos.x - base_pos.x, pos.y - base_pos.y);
    // texCoord = texCoord + height_coord_shift(texCoord);
    end.uv = texCoord + shift;
    end.s = 1.0f - pos.z / relief_vscale;
    return end;
}

/// N. Tatarchuk, DirectX SDK sample ParallaxOcclusionMapping.fx, pixel shader, as far as the
/// displaced coordinate: its steps in its order, in words of this project. `offset` is its parallax
/// offset (-K), `level` the mip level that it computes, `fetch` reads with the gradients of uv.
inline End dx_sdk(const Vec2& uv, const Vec2& offset, float NdotV, int most_samples,
                  int least_samples, float level, int threshold, const Sampler& fetch) {
    End end;
    // Beyond the threshold: the coordinate as it is.
    end.uv = uv;
    if (!(level <= static_cast<float>(threshold))) return end;
    // Number of steps: the linear interpolation between the two bounds by N.V, cast to int.
    const int steps =
        to_int(lerp(static_cast<float>(most_samples), static_cast<float>(least_samples), NdotV));
    // Step size 1 / steps; the height before the first sample is 1.
    const float step_size = 1.0f / static_cast<float>(steps);
    float previous = 1.0f, bound = 1.0f;
    // Offset a step: step size times offset. Both points of the interval start as (0, 0).
    const Vec2 offset_a_step(step_size * offset.x, step_size * offset.y);
    Vec2 current = uv, pt1(0.0f, 0.0f), pt2(0.0f, 0.0f);
    int index = 0;
    while (index < steps) {
        // One step on, then the fetch, then the bound is lowered.
        current -= offset_a_step;
        const float height = fetch(current);
        ++end.fetches;
        bound -= step_size;
        // Strictly above the bound: the interval is this point and the one before it; leave.
        if (height > bound) {
            pt1 = {bound, height};
            pt2 = {bound + step_size, previous};
            index = steps + 1;
        } else {
            index++;
        }
        previous = height;
    }
    // The lines meet at (x1 d2 - x2 d1) / (d2 - d1), d = bound - height; 0 if they are parallel.
    const float delta2 = pt2.x - pt2.y, delta1 = pt1.x - pt1.y;
    const float denominator = delta2 - delta1;
    const float amount =
        denominator == 0.0f ? 0.0f : (pt1.x * delta2 - pt2.x * delta1) / denominator;
    // The coordinate minus offset times (1 - amount).
    const float share = 1.0f - amount;
    const Vec2 displaced(uv.x - offset.x * share, uv.y - offset.y * share);
    end.uv = displaced;
    // Within the last level before the threshold: interpolated to uv by the level's fraction.
    if (level > static_cast<float>(threshold - 1)) {
        const float fraction = level - std::trunc(level);
        end.uv = {lerp(displaced.x, uv.x, fraction), lerp(displaced.y, uv.y, fraction)};
    }
    end.s = share;
    end.map = previous;
    return end;
}

/// Rabbid76, "Parallax Mapping": function Parallax of Offset Limiting.
inline End rabbid_offset(const Vec3& texDir3D, const Vec2& texCoord,
                         const Sampler& u_displacement_map) {
    End end;
    // float parallaxScale = 0.1;
    const float parallaxScale = 0.1f;
    // float mapHeight = CalculateHeight( texCoord.st );
    // (float height = texture( u_displacement_map, texCoords ).x;)
    // (return clamp( height, 0.0, 1.0 );)
    const float mapHeight = clamp(u_displacement_map(texCoord), 0.0f, 1.0f);
    end.fetches = 1;
    // vec2 texCoordOffst = -parallaxScale * mapHeight * texDir3D.xy;
    const float scale = -parallaxScale * mapHeight;
    const Vec2 texCoordOffst(scale * texDir3D.x, scale * texDir3D.y);
    // return vec3(texCoord.xy + texCoordOffst.xy, mapHeight);
    end.uv = texCoord + texCoordOffst;
    end.map = mapHeight;
    end.s = 1.0f - mapHeight;
    return end;
}

/// Rabbid76, "Parallax Mapping": function Parallax of Parallax Occlusion Mapping (`relief` false)
/// and of Relief Parallax Mapping, whose second loop reads the map by `second`.
inline End rabbid(const Vec3& texDir3D, const Vec2& texCoord, const Vec2& u_parallax_quality,
                  float frontFace, bool relief, const Sampler& first, const Sampler& second) {
    End end;
    const auto CalculateHeight = [&](const Sampler& u_displacement_map, const Vec2& texCoords) {
        ++end.fetches;
        // float height = texture( u_displacement_map, texCoords ).x;
        const float height = u_displacement_map(texCoords);
        // return clamp( height, 0.0, 1.0 );
        return clamp(height, 0.0f, 1.0f);
    };
    // vec2 quality_range = u_parallax_quality;
    const Vec2 quality_range = u_parallax_quality;
    // float quality = mix( quality_range.x, quality_range.y, 1.0 -
    // pow(abs(normalize(texDir3D).z),2.0) );
    const float quality =
        mix(quality_range.x, quality_range.y, 1.0f - pow(abs(normalize(texDir3D).z), 2.0f));
    // float numSteps = clamp( quality * 50.0, 1.0, 50.0 );
    const float numSteps = clamp(quality * 50.0f, 1.0f, 50.0f);
    // int numBinarySteps = int( clamp( quality * 10.0, 1.0, 7.0 ) );
    const int numBinarySteps = to_int(clamp(quality * 10.0f, 1.0f, 7.0f));
    // float surf_sign = frontFace;
    const float surf_sign = frontFace;
    // float back_face = step(0.0, -surf_sign);
    const float back_face = step(0.0f, -surf_sign);
    // vec2 texStep = surf_sign * texDir3D.xy / abs(texDir3D.z);
    const Vec2 texStep(surf_sign * texDir3D.x / std::fabs(texDir3D.z),
                       surf_sign * texDir3D.y / std::fabs(texDir3D.z));
    // vec2 texC = texCoord.st + surf_sign * texStep + back_face * texStep.xy;
    Vec2 texC(texCoord.x + surf_sign * texStep.x + back_face * texStep.x,
              texCoord.y + surf_sign * texStep.y + back_face * texStep.y);
    // float mapHeight = 1.0;
    float mapHeight = 1.0f;
    // float bestBumpHeight = mapHeight;
    float bestBumpHeight = mapHeight;
    // float bumpHeightStep = 1.0 / numSteps;
    float bumpHeightStep = 1.0f / numSteps;
    // for ( int i = 0; i < int( numSteps ); ++ i )
    for (int i = 0; i < to_int(numSteps); ++i) {
        // mapHeight = back_face + surf_sign * CalculateHeight( texC.xy - bestBumpHeight *
        // texStep.xy );
        mapHeight =
            back_face + surf_sign * CalculateHeight(first, {texC.x - bestBumpHeight * texStep.x,
                                                            texC.y - bestBumpHeight * texStep.y});
        // if ( mapHeight >= bestBumpHeight ) break;
        if (mapHeight >= bestBumpHeight) break;
        // bestBumpHeight -= bumpHeightStep;
        bestBumpHeight -= bumpHeightStep;
    }
    if (relief) {
        // bestBumpHeight += bumpHeightStep;
        bestBumpHeight += bumpHeightStep;
        // for ( int i = 0; i < numBinarySteps; ++ i )
        for (int i = 0; i < numBinarySteps; ++i) {
            // bumpHeightStep *= 0.5;
            bumpHeightStep *= 0.5f;
            // bestBumpHeight -= bumpHeightStep;
            bestBumpHeight -= bumpHeightStep;
            // mapHeight = back_face + surf_sign * CalculateHeight( texC.xy - bestBumpHeight *
            // texStep.xy );
            mapHeight = back_face +
                        surf_sign * CalculateHeight(second, {texC.x - bestBumpHeight * texStep.x,
                                                             texC.y - bestBumpHeight * texStep.y});
            // bestBumpHeight += ( bestBumpHeight < mapHeight ) ? bumpHeightStep : 0.0;
            bestBumpHeight += (bestBumpHeight < mapHeight) ? bumpHeightStep : 0.0f;
        }
    }
    end.map = mapHeight;
    // bestBumpHeight -= bumpHeightStep * clamp( ( bestBumpHeight - mapHeight ) / bumpHeightStep,
    // 0.0, 1.0 );
    bestBumpHeight -=
        bumpHeightStep * clamp((bestBumpHeight - mapHeight) / bumpHeightStep, 0.0f, 1.0f);
    // mapHeight = bestBumpHeight;
    mapHeight = bestBumpHeight;
    // texC -= mapHeight * texStep;
    texC = {texC.x - mapHeight * texStep.x, texC.y - mapHeight * texStep.y};
    // return vec3( texC.xy, mapHeight );
    end.uv = texC;
    end.s = 1.0f - mapHeight;
    return end;
}

/// F. Policarpo, M. M. Oliveira, GPU Gems 3, chapter 18, demonstration, relief mapping: its steps
/// in its order, in words of this project. `v` has z = 1 and the depth applied; `depth` reads the
/// map, which holds 1 - h.
inline End gpu_gems_3(const Vec2& uv, Vec3 v, int linear_steps, int binary_steps,
                      const Sampler& depth) {
    End end;
    // p starts at (uv, 0); v is divided by v.z times the number of linear steps.
    Vec3 p(uv.x, uv.y, 0.0f);
    v /= v.z * static_cast<float>(linear_steps);
    // Linear steps: fetch at p; on by v while p.z is less than the depth. No exit.
    for (int i = 0; i < linear_steps; i++) {
        end.map = depth({p.x, p.y});
        ++end.fetches;
        if (p.z < end.map) p += v;
    }
    // Binary steps: v is halved, then the fetch at p, then on or back by v.
    for (int i = 0; i < binary_steps; i++) {
        v *= 0.5f;
        end.map = depth({p.x, p.y});
        ++end.fetches;
        if (p.z < end.map) {
            p += v;
        } else {
            p -= v;
        }
    }
    end.uv = {p.x, p.y};
    end.s = p.z;
    return end;
}

/// "Derivative-Based Relief Mapping", 2012, has no listing of its search by texels. Its text:
/// "perform a linear per-pixel search over the uninterpolated height map, followed by a binary
/// search over the interpolated values of the last two texels where the intersection is found in
/// the linear search". Comparisons as in its listed search; `steps` is one per texel; at(s) is the
/// ray. The two ends of the interval are looked up once more, to see whether there is a crossing.
inline End thesis_by_texels(const std::function<Vec2(float)>& at, int steps, int halvings,
                            const Sampler& uninterpolated, const Sampler& interpolated) {
    End end;
    float last = 0, found = -1;
    // a linear per-pixel search over the uninterpolated height map
    for (int k = 0; k <= steps && found < 0; ++k) {
        const float s = static_cast<float>(k) / static_cast<float>(steps);
        end.map = uninterpolated(at(s));
        ++end.fetches;
        if (end.map > 1 - s) {
            found = s;
        } else {
            last = s;
        }
    }
    end.s = found < 0 ? 1 : found;
    // followed by a binary search over the interpolated values
    if (found >= 0) end.fetches += 2;
    for (int i = 0; found >= 0 && i < halvings; ++i) {
        const float middle = (last + end.s) * 0.5f, h = interpolated(at(middle));
        ++end.fetches;
        if (h > 1 - middle) {
            end.s = middle;
            end.map = h;
        } else {
            last = middle;
        }
    }
    end.uv = at(end.s);
    return end;
}

}  // namespace quadrel::listings
