// Transcription of Rabbid76's prisms, graphics-snippets, example/python/parallax,
// parallax_010_generalized_disp_mapping_geo_tbn: displacement_map.geom for one triangle and
// displacement_map.frag for one fragment, line by line; above each line of code stands the line of
// the listing. Names are the listing's; the built-ins those of num/functions.hpp. Lines on colour,
// the world's clipping plane and shading are left out.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "quadrel/num/functions.hpp"

namespace quadrel::listings {

using PrismVec2 = vec2<float>;
using PrismVec3 = vec3<float>;
using PrismVec4 = vec4<float>;
using PrismMat3 = mat3<float>;

/// TGeometryData.
struct PrismVertex {
    PrismVec3 pos, nv, tv, bv, uvh;
    PrismVec4 d;
};

/// Of view_pos, view_nv and uv of a triangle's corners. Seven triangles, those of strips in the
/// order in which a strip's vertices make them.
inline std::vector<std::array<PrismVertex, 3>> prism_geometry(
    const std::array<PrismVec3, 3>& view_pos, const std::array<PrismVec3, 3>& view_nv,
    const std::array<PrismVec2, 3>& uv, float u_displacement_scale) {
    std::array<PrismVec3, 3> view_pos_up;
    // view_pos_up[i] = view_pos[i] + view_nv[i] * u_displacement_scale;
    for (int i = 0; i < 3; ++i) view_pos_up[i] = view_pos[i] + view_nv[i] * u_displacement_scale;
    // vec3  dp1  = view_pos[1].xyz - view_pos[0].xyz;
    const PrismVec3 dp1 = view_pos[1] - view_pos[0];
    // vec3  dp2  = view_pos[2].xyz - view_pos[0].xyz;
    const PrismVec3 dp2 = view_pos[2] - view_pos[0];
    // vec2  duv1 = inData[1].uv.xy - inData[0].uv.xy;
    const PrismVec2 duv1 = uv[1] - uv[0];
    // vec2  duv2 = inData[2].uv.xy - inData[0].uv.xy;
    const PrismVec2 duv2 = uv[2] - uv[0];
    std::array<PrismVec3, 3> nv, tv, bv;
    for (int i = 0; i < 3; ++i) {
        // vec3 dp2perp = cross(dp2, view_nv[i]);
        const PrismVec3 dp2perp = cross(dp2, view_nv[i]);
        // vec3 dp1perp = cross(view_nv[i], dp1);
        const PrismVec3 dp1perp = cross(view_nv[i], dp1);
        // nv[i] = view_nv[i] * u_displacement_scale;
        nv[i] = view_nv[i] * u_displacement_scale;
        // tv[i] = dp2perp * duv1.x + dp1perp * duv2.x;
        tv[i] = dp2perp * duv1.x + dp1perp * duv2.x;
        // bv[i] = dp2perp * duv1.y + dp1perp * duv2.y;
        bv[i] = dp2perp * duv1.y + dp1perp * duv2.y;
    }
    std::array<float, 3> d, d_up, d_opp, d_opp_up, d_top;
    for (int i0 = 0; i0 < 3; ++i0) {
        // d[i0]    = length(view_pos[i0].xyz);
        d[i0] = length(view_pos[i0]);
        // d_up[i0] = length(view_pos_up[i0].xyz);
        d_up[i0] = length(view_pos_up[i0]);
        // int i1 = (i0+1) % 3;
        const int i1 = (i0 + 1) % 3;
        // int i2 = (i0+2) % 3;
        const int i2 = (i0 + 2) % 3;
        // vec3 edge    = view_pos[i2].xyz - view_pos[i1].xyz;
        const PrismVec3 edge = view_pos[i2] - view_pos[i1];
        // vec3 edge_up = view_pos_up[i2].xyz - view_pos_up[i1].xyz;
        const PrismVec3 edge_up = view_pos_up[i2] - view_pos_up[i1];
        // vec3 up      = view_nv[i1].xyz + view_nv[i2].xyz;
        const PrismVec3 up = view_nv[i1] + view_nv[i2];
        // vec3  R0      = vec3(0.0); // for persepctive projection
        const PrismVec3 R0(0.0f);
        // vec3  D       = normalize(view_pos[i0].xyz); // for persepctive projection
        const PrismVec3 D = normalize(view_pos[i0]);
        // vec3  N       = normalize(cross(edge, up));
        const PrismVec3 N = normalize(cross(edge, up));
        // vec3  P0      = (view_pos[i1].xyz+view_pos[i2].xyz)/2.0;
        const PrismVec3 P0 = (view_pos[i1] + view_pos[i2]) / 2.0f;
        // d_opp[i0]     = dot(P0 - R0, N) / dot(D, N);
        d_opp[i0] = dot(P0 - R0, N) / dot(D, N);
        // vec3  R0_up   = vec3(0.0); // for persepctive projection
        const PrismVec3 R0_up(0.0f);
        // vec3  D_up    = normalize(view_pos_up[i0].xyz); // for persepctive projection
        const PrismVec3 D_up = normalize(view_pos_up[i0]);
        // vec3  N_up    = normalize(cross(edge_up, up));
        const PrismVec3 N_up = normalize(cross(edge_up, up));
        // vec3  P0_up   = (view_pos_up[i1].xyz+view_pos_up[i2].xyz)/2.0;
        const PrismVec3 P0_up = (view_pos_up[i1] + view_pos_up[i2]) / 2.0f;
        // d_opp_up[i0]  = dot(P0_up - R0_up, N_up) / dot(D_up, N_up);
        d_opp_up[i0] = dot(P0_up - R0_up, N_up) / dot(D_up, N_up);
        // vec3  N_top   = normalize(view_nv[0]+view_nv[1]+view_nv[2]);
        const PrismVec3 N_top = normalize(view_nv[0] + view_nv[1] + view_nv[2]);
        // vec3  P0_top  = (view_pos_up[0].xyz + view_pos_up[1].xyz + view_pos_up[2].xyz)/3.0;
        const PrismVec3 P0_top = (view_pos_up[0] + view_pos_up[1] + view_pos_up[2]) / 3.0f;
        // d_top[i0]     = dot(P0_top - R0, N_top) / dot(D, N_top);
        d_top[i0] = dot(P0_top - R0, N_top) / dot(D, N_top);
    }
    std::vector<std::array<PrismVertex, 3>> emitted;
    std::array<PrismVertex, 3> base;
    for (int i = 0; i < 3; ++i) {
        // outData.uvh  = vec3(inData[i].uv, 0.0);
        // outData.d    = vec4( i==0 ? d_opp[i] : d[i], i==1 ? d_opp[i] : d[i],
        //                      i==2 ? d_opp[i] : d[i], d_top[i] );
        base[i] = {view_pos[i],
                   nv[i],
                   tv[i],
                   bv[i],
                   PrismVec3(uv[i].x, uv[i].y, 0.0f),
                   PrismVec4(i == 0 ? d_opp[i] : d[i], i == 1 ? d_opp[i] : d[i],
                             i == 2 ? d_opp[i] : d[i], d_top[i])};
    }
    // EndPrimitive();
    emitted.push_back(base);
    // vec3 cpt_tri = (view_pos[0] + view_pos[1] + view_pos[2]) / 3.0;
    const PrismVec3 cpt_tri = (view_pos[0] + view_pos[1] + view_pos[2]) / 3.0f;
    for (int i0 = 0; i0 < 3; ++i0) {
        // int i1 = (i0+1) % 3;
        const int i1 = (i0 + 1) % 3;
        // vec3 cpt_edge    = (view_pos[i0] + view_pos[i1]) / 2.0;
        const PrismVec3 cpt_edge = (view_pos[i0] + view_pos[i1]) / 2.0f;
        // vec3 dir_to_edge = cpt_edge - cpt_tri;
        const PrismVec3 dir_to_edge = cpt_edge - cpt_tri;
        // vec3 edge    = view_pos[i1] - view_pos[i0];
        const PrismVec3 edge = view_pos[i1] - view_pos[i0];
        // vec3 nv_edge  = nv[i0] + nv[i1];
        const PrismVec3 nv_edge = nv[i0] + nv[i1];
        // vec3 nv_side = cross(edge, nv_edge); // normal vector of a side of the prism
        PrismVec3 nv_side = cross(edge, nv_edge);
        // nv_side *= sign(dot(nv_side, dir_to_edge));
        nv_side *= sign(dot(nv_side, dir_to_edge));
        // float frontface = sign(dot(cpt_edge, -nv_side));
        const float frontface = sign(dot(cpt_edge, -nv_side));
        float d_opp0, d_opp1, d_opp_up0, d_opp_up1;
        // if ( frontface > 0.0 )
        if (frontface > 0.0f) {
            // d_opp0    = max(d[i0], d_opp[i0]);
            d_opp0 = max(d[i0], d_opp[i0]);
            // d_opp1    = max(d[i1], d_opp[i1]);
            d_opp1 = max(d[i1], d_opp[i1]);
            // d_opp_up0 = max(d_up[i0], d_opp_up[i0]);
            d_opp_up0 = max(d_up[i0], d_opp_up[i0]);
            // d_opp_up1 = max(d_up[i1], d_opp_up[i1]);
            d_opp_up1 = max(d_up[i1], d_opp_up[i1]);
        } else {
            // d_opp0    = min(d[i0], d_opp[i0]);
            d_opp0 = min(d[i0], d_opp[i0]);
            // d_opp1    = min(d[i1], d_opp[i1]);
            d_opp1 = min(d[i1], d_opp[i1]);
            // d_opp_up0 = min(d_up[i0], d_opp_up[i0]);
            d_opp_up0 = min(d_up[i0], d_opp_up[i0]);
            // d_opp_up1 = min(d_up[i1], d_opp_up[i1]);
            d_opp_up1 = min(d_up[i1], d_opp_up[i1]);
        }
        const auto uvh = [&](int i, float h) { return PrismVec3(uv[i].x, uv[i].y, h); };
        // outData.d    = vec4(d_opp0, d[i0], frontface, d_top[i0]);
        const PrismVertex a{view_pos[i0], nv[i0],        tv[i0],
                            bv[i0],       uvh(i0, 0.0f), {d_opp0, d[i0], frontface, d_top[i0]}};
        // outData.d    = vec4(d[i1], d_opp1, frontface, d_top[i1]);
        const PrismVertex b{view_pos[i1], nv[i1],        tv[i1],
                            bv[i1],       uvh(i1, 0.0f), {d[i1], d_opp1, frontface, d_top[i1]}};
        // outData.d    = vec4(d_opp_up0, d_up[i0], frontface, 0.0);
        const PrismVertex c{view_pos_up[i0], nv[i0],        tv[i0],
                            bv[i0],          uvh(i0, 1.0f), {d_opp_up0, d_up[i0], frontface, 0.0f}};
        // outData.d    = vec4(d_up[i1], d_opp_up1, frontface, 0.0);
        const PrismVertex e{view_pos_up[i1], nv[i1],        tv[i1],
                            bv[i1],          uvh(i1, 1.0f), {d_up[i1], d_opp_up1, frontface, 0.0f}};
        // Triangles n of a strip are of vertices (n, n + 1, n + 2), odd ones of (n + 1, n, n + 2).
        emitted.push_back({a, b, c});
        emitted.push_back({c, b, e});
    }
    return emitted;
}

/// What becomes of a fragment.
struct PrismFragmentEnd {
    bool discarded = false;
    PrismVec3 newTexCoords, view_pos_displ;
    int fetches = 0;
};

class PrismFragment {
  public:
    PrismVec2 u_parallax_quality;
    float u_displacement_scale = 0;
    std::function<float(const PrismVec2&)> u_displacement_map;

    PrismFragmentEnd main(const PrismVertex& in_data, bool gl_FrontFacing) {
        // vec3  objPosEs    = in_data.pos;
        const PrismVec3 objPosEs = in_data.pos;
        // vec3  objNormalEs = in_data.nv;
        const PrismVec3 objNormalEs = in_data.nv;
        // vec3  texCoords   = in_data.uvh.stp;
        const PrismVec3 texCoords = in_data.uvh;
        // float frontFace   = (texCoords.p > 0.0) ? 1.0 : (gl_FrontFacing ? 1.0 : -1.0);
        const float frontFace = (texCoords.z > 0.0f) ? 1.0f : (gl_FrontFacing ? 1.0f : -1.0f);
        // vec3  N           = frontFace * objNormalEs;
        const PrismVec3 N = objNormalEs * frontFace;
        // vec3  T           = in_data.tv;
        const PrismVec3 T = in_data.tv;
        // vec3  B           = in_data.bv;
        const PrismVec3 B = in_data.bv;
        // float invmax      = inversesqrt(max(dot(T, T), dot(B, B)));
        const float invmax = inversesqrt(max(dot(T, T), dot(B, B)));
        // mat3  tbnMat      = mat3(T * invmax, B * invmax, N * invmax);
        const PrismMat3 tbnMat(T * invmax, B * invmax, N * invmax);
        // mat3  inv_tbnMat  = inverse( tbnMat );
        const PrismMat3 inv_tbnMat = inverse(tbnMat);
        // bool  is_silhouette    = texCoords.p > 0.0001;
        const bool is_silhouette = texCoords.z > 0.0001f;
        // bool  silhouette_front = in_data.d.z > 0.0;
        const bool silhouette_front = in_data.d.z > 0.0f;
        // float df = length( objPosEs );
        const float df = length(objPosEs);
        float d0, d1;
        // if ( is_silhouette == false )
        if (is_silhouette == false) {
            // if ( frontFace > 0.0 )
            if (frontFace > 0.0f) {
                // d1 = 0.0;
                d1 = 0.0f;
                // d0 = min(min(in_data.d.x, in_data.d.y), in_data.d.z) - df;
                d0 = min(min(in_data.d.x, in_data.d.y), in_data.d.z) - df;
            } else {
                // d0 = 0.0;
                d0 = 0.0f;
                // d1 = max(max(in_data.d.x, in_data.d.y), in_data.d.z) - df;
                d1 = max(max(in_data.d.x, in_data.d.y), in_data.d.z) - df;
            }
        } else {
            // d1 = min(in_data.d.x, in_data.d.y) - df;
            d1 = min(in_data.d.x, in_data.d.y) - df;
            // d0 = max(in_data.d.x, in_data.d.y) - df;
            d0 = max(in_data.d.x, in_data.d.y) - df;
        }
        // vec3  V  = objPosEs / df;
        const PrismVec3 V = objPosEs / df;
        // vec3  P0 = V * d0;
        const PrismVec3 P0 = V * d0;
        // vec3  P1 = V * d1;
        const PrismVec3 P1 = V * d1;
        // vec3  tbnP0        = inv_tbnMat * P0;
        PrismVec3 tbnP0 = inv_tbnMat * P0;
        // vec3  tbnP1        = inv_tbnMat * P1;
        PrismVec3 tbnP1 = inv_tbnMat * P1;
        // vec3  tbnDir       = normalize(inv_tbnMat * objPosEs);
        const PrismVec3 tbnDir = normalize(inv_tbnMat * objPosEs);
        // float base_height  = texCoords.p;
        const float base_height = texCoords.z;
        // bool  is_up_isect  = is_silhouette && tbnDir.z > 0.0;
        const bool is_up_isect = is_silhouette && tbnDir.z > 0.0f;
        // float delta_height0 = is_up_isect ? 1.05*(1.0-base_height) : base_height;
        const float delta_height0 = is_up_isect ? 1.05f * (1.0f - base_height) : base_height;
        // float delta_height1 = is_up_isect ? 0.0 : (base_height - 1.0);
        const float delta_height1 = is_up_isect ? 0.0f : (base_height - 1.0f);
        // vec3 texDist = is_silhouette == false ? tbnDir / abs(tbnDir.z)
        //              : tbnDir / max(abs(tbnDir.z), 0.5*length(tbnDir.xy));
        const PrismVec3 texDist =
            is_silhouette == false
                ? tbnDir / abs(tbnDir.z)
                : tbnDir / max(abs(tbnDir.z), 0.5f * length(PrismVec2(tbnDir.x, tbnDir.y)));
        // vec3 tbnStep = vec3(texDist.xy, sign(tbnDir.z));
        const PrismVec3 tbnStep(texDist.x, texDist.y, sign(tbnDir.z));
        // tbnP0 = delta_height0 * tbnStep; // sample end - bottom of prism
        tbnP0 = tbnStep * delta_height0;
        // tbnP1 = delta_height1 * tbnStep; // sample start - top of prism
        tbnP1 = tbnStep * delta_height1;
        // if ( is_silhouette )
        if (is_silhouette) {
            // if ( silhouette_front )
            if (silhouette_front)
                // tbnP1 = vec3(0.0);
                tbnP1 = PrismVec3(0.0f);
            else
                // tbnP0 = vec3(0.0);
                tbnP0 = PrismVec3(0.0f);
        }
        PrismFragmentEnd end;
        // vec3  newTexCoords = abs(u_displacement_scale) < 0.001 ? vec3(texCoords.st, 0.0)
        //     : Parallax( frontFace, texCoords.stp, tbnP0, tbnP1, tbnStep );
        end.newTexCoords = abs(u_displacement_scale) < 0.001f
                               ? PrismVec3(texCoords.x, texCoords.y, 0.0f)
                               : Parallax(frontFace, texCoords, tbnP0, tbnP1, tbnStep);
        // vec3  tex_offst    = newTexCoords.stp-texCoords.stp;
        const PrismVec3 tex_offst = end.newTexCoords - texCoords;
        // if ( is_silhouette )
        if (is_silhouette) {
            // if ( newTexCoords.z > 1.000001 || newTexCoords.z < 0.0 ||
            //      dot(tex_offst, tbnDir)*in_data.d.z < 0.0 )
            //     discard;
            if (end.newTexCoords.z > 1.000001f || end.newTexCoords.z < 0.0f ||
                dot(tex_offst, tbnDir) * in_data.d.z < 0.0f)
                end.discarded = true;
            // if ( silhouette_front == false && is_up_isect )
            //     discard;
            if (silhouette_front == false && is_up_isect) end.discarded = true;
        }
        // vec3  displ_vec      = tbnMat * tex_offst/invmax;
        const PrismVec3 displ_vec = tbnMat * tex_offst / invmax;
        // vec3  view_pos_displ = objPosEs + displ_vec;
        end.view_pos_displ = objPosEs + displ_vec;
        end.fetches = fetches_;
        return end;
    }

  private:
    float CalculateHeight(const PrismVec2& texCoords) {
        ++fetches_;
        // float height = texture( u_displacement_map, texCoords ).x;
        const float height = u_displacement_map(texCoords);
        // return clamp( height, 0.0, 1.0 );
        return clamp(height, 0.0f, 1.0f);
    }

    PrismVec3 Parallax(float frontFace, const PrismVec3& texCoord, const PrismVec3& tbnP0,
                       const PrismVec3& tbnP1, const PrismVec3& tbnStep) {
        // float back_face = step(0.0, -frontFace);
        const float back_face = step(0.0f, -frontFace);
        // vec3 texC0 = texCoord.xyz + tbnP0 + back_face * vec3(tbnStep.xy, 0.0);
        const PrismVec3 texC0 =
            texCoord + tbnP0 + PrismVec3(tbnStep.x, tbnStep.y, 0.0f) * back_face;
        // vec3 texC1 = texCoord.xyz + tbnP1 + back_face * vec3(tbnStep.xy, 0.0);
        const PrismVec3 texC1 =
            texCoord + tbnP1 + PrismVec3(tbnStep.x, tbnStep.y, 0.0f) * back_face;
        const PrismVec2 xy0(texC0.x, texC0.y), xy1(texC1.x, texC1.y);
        // vec2  quality_range  = u_parallax_quality;
        const PrismVec2 quality_range = u_parallax_quality;
        // float quality        = mix( quality_range.x, quality_range.y,
        //                             1.0 - abs(normalize(tbnStep).z) );
        const float quality =
            mix(quality_range.x, quality_range.y, 1.0f - abs(normalize(tbnStep).z));
        // float numSteps       = clamp( quality * 50.0, 1.0, 50.0 );
        const float numSteps = clamp(quality * 50.0f, 1.0f, 50.0f);
        // int   numBinarySteps = int( clamp( quality * 10.0, 1.0, 10.0 ) );
        const int numBinarySteps = static_cast<int>(clamp(quality * 10.0f, 1.0f, 10.0f));
        // float bumpHeightStep = (texC0.z-texC1.z) / (numSteps-1.0);
        float bumpHeightStep = (texC0.z - texC1.z) / (numSteps - 1.0f);
        // float bestBumpHeight = texC1.z;
        float bestBumpHeight = texC1.z;
        // float mapHeight      = 1.0;
        float mapHeight = 1.0f;
        // for ( int i = 0; i < int( numSteps ); ++ i )
        for (int i = 0; i < static_cast<int>(numSteps); ++i) {
            // mapHeight = back_face + frontFace * CalculateHeight( mix(texC0.xy, texC1.xy,
            //             (bestBumpHeight-texC0.z)/(texC1.z-texC0.z)) );
            mapHeight =
                back_face +
                frontFace * CalculateHeight(
                                mix(xy0, xy1, (bestBumpHeight - texC0.z) / (texC1.z - texC0.z)));
            // if ( mapHeight >= bestBumpHeight || bestBumpHeight > 1.0 )
            //     break;
            if (mapHeight >= bestBumpHeight || bestBumpHeight > 1.0f) break;
            // bestBumpHeight += bumpHeightStep;
            bestBumpHeight += bumpHeightStep;
        }
        // if ( texCoord.z < 0.0001 || bestBumpHeight >= 0.0 ) // if not a silhouett
        if (texCoord.z < 0.0001f || bestBumpHeight >= 0.0f) {
            // bestBumpHeight -= bumpHeightStep;
            bestBumpHeight -= bumpHeightStep;
            // for ( int i = 0; i < numBinarySteps; ++ i )
            for (int i = 0; i < numBinarySteps; ++i) {
                // bumpHeightStep *= 0.5;
                bumpHeightStep *= 0.5f;
                // bestBumpHeight += bumpHeightStep;
                bestBumpHeight += bumpHeightStep;
                // mapHeight       = back_face + frontFace * CalculateHeight( mix(texC0.xy,
                //     texC1.xy, (bestBumpHeight-texC0.z)/(texC1.z-texC0.z)) );
                mapHeight =
                    back_face +
                    frontFace * CalculateHeight(mix(
                                    xy0, xy1, (bestBumpHeight - texC0.z) / (texC1.z - texC0.z)));
                // bestBumpHeight -= ( bestBumpHeight < mapHeight ) ? bumpHeightStep : 0.0;
                bestBumpHeight -= (bestBumpHeight < mapHeight) ? bumpHeightStep : 0.0f;
            }
            // bestBumpHeight += bumpHeightStep * clamp( ( bestBumpHeight - mapHeight )
            //                   / abs(bumpHeightStep), 0.0, 1.0 );
            bestBumpHeight += bumpHeightStep *
                              clamp((bestBumpHeight - mapHeight) / abs(bumpHeightStep), 0.0f, 1.0f);
        }
        // vec2 texC  = mix(texC0.xy, texC1.xy, (bestBumpHeight-texC0.z)/(texC1.z-texC0.z));
        const PrismVec2 texC = mix(xy0, xy1, (bestBumpHeight - texC0.z) / (texC1.z - texC0.z));
        // mapHeight  = bestBumpHeight;
        mapHeight = bestBumpHeight;
        // return vec3(texC.xy, mapHeight);
        return {texC.x, texC.y, mapHeight};
    }

    int fetches_ = 0;
};

}  // namespace quadrel::listings
