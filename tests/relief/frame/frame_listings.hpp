// Transcriptions of the published frames, line by line, for one fragment; above each line of code
// stands the line of the listing. The names are the listings'; the built-ins those of
// num/functions.hpp.
#pragma once

#include "quadrel/num/functions.hpp"

namespace quadrel::listings {

using vec2f = vec2<float>;
using vec3f = vec3<float>;
using mat3f = mat3<float>;

/// What the listings' dFdx and dFdy see: the varyings of a fragment and their differences.
struct Varyings {
    vec3f position, dFdx_position, dFdy_position, normal;
    vec2f uv, dFdx_uv, dFdy_uv;
};

/// C. Schueler, "Followup: Normal Mapping Without Precomputed Tangents", 2013: cotangent_frame.
inline mat3f cotangent_frame(const vec3f& N, const Varyings& v) {
    // vec3 dp1 = dFdx( p );
    const vec3f dp1 = v.dFdx_position;
    // vec3 dp2 = dFdy( p );
    const vec3f dp2 = v.dFdy_position;
    // vec2 duv1 = dFdx( uv );
    const vec2f duv1 = v.dFdx_uv;
    // vec2 duv2 = dFdy( uv );
    const vec2f duv2 = v.dFdy_uv;
    // vec3 dp2perp = cross( dp2, N );
    const vec3f dp2perp = cross(dp2, N);
    // vec3 dp1perp = cross( N, dp1 );
    const vec3f dp1perp = cross(N, dp1);
    // vec3 T = dp2perp * duv1.x + dp1perp * duv2.x;
    const vec3f T = dp2perp * duv1.x + dp1perp * duv2.x;
    // vec3 B = dp2perp * duv1.y + dp1perp * duv2.y;
    const vec3f B = dp2perp * duv1.y + dp1perp * duv2.y;
    // float invmax = inversesqrt( max( dot(T,T), dot(B,B) ) );
    const float invmax = inversesqrt(max(dot(T, T), dot(B, B)));
    // return mat3( T * invmax, B * invmax, N );
    return mat3f(T * invmax, B * invmax, N);
}

/// Rabbid76, graphics-snippets, "Parallax Mapping": main() up to the parallax, and texStep of its
/// searches for a front face.
struct ParallaxMain {
    float u_displacement_scale = 0;
    mat3f tbnMat;
    vec3f texDir3D;
    vec2f texStep;

    void main(const Varyings& in_data) {
        // vec3 objPosEs = in_data.pos;
        const vec3f objPosEs = in_data.position;
        // vec3 objNormalEs = in_data.nv;
        const vec3f objNormalEs = in_data.normal;
        // vec3 N = normalize( objNormalEs );
        const vec3f N = normalize(objNormalEs);
        // vec3 dp1 = dFdx( objPosEs );
        const vec3f dp1 = in_data.dFdx_position;
        // vec3 dp2 = dFdy( objPosEs );
        const vec3f dp2 = in_data.dFdy_position;
        // vec2 duv1 = dFdx( texCoords );
        const vec2f duv1 = in_data.dFdx_uv;
        // vec2 duv2 = dFdy( texCoords );
        const vec2f duv2 = in_data.dFdy_uv;
        // vec3 dp2perp = cross(dp2, N);
        const vec3f dp2perp = cross(dp2, N);
        // vec3 dp1perp = cross(N, dp1);
        const vec3f dp1perp = cross(N, dp1);
        // vec3 T = dp2perp * duv1.x + dp1perp * duv2.x;
        const vec3f T = dp2perp * duv1.x + dp1perp * duv2.x;
        // vec3 B = dp2perp * duv1.y + dp1perp * duv2.y;
        const vec3f B = dp2perp * duv1.y + dp1perp * duv2.y;
        // float invmax = inversesqrt(max(dot(T, T), dot(B, B)));
        const float invmax = inversesqrt(max(dot(T, T), dot(B, B)));
        // mat3 tbnMat = mat3(T * invmax, B * invmax, N * u_displacement_scale);
        tbnMat = mat3f(T * invmax, B * invmax, N * u_displacement_scale);
        // vec3 texDir3D = normalize( inverse( tbnMat ) * objPosEs );
        texDir3D = normalize(inverse(tbnMat) * objPosEs);
        // abs(u_displacement_scale) < 0.001 ? vec3(texCoords.st, 0.0) : Parallax(...)
        if (std::abs(u_displacement_scale) < 0.001f) {
            texStep = vec2f(0, 0);
            return;
        }
        // vec2 texStep = surf_sign * texDir3D.xy / abs(texDir3D.z);
        texStep = vec2f(texDir3D.x, texDir3D.y) / std::abs(texDir3D.z);
    }
};

/// T. Welsh, "Parallax Mapping with Offset Limiting", 2004: the vertex program of 4.2.
struct WelshVertex {
    vec3f eye;  ///< mvit[3].xyz
    vec3f tangent, binormal, normal, position;
    vec3f texcoord3;

    void main() {
        // SUB eyevec, mvit[3], vertex.position;
        const vec3f eyevec = eye - position;
        // DP3 result.texcoord[3].x, eyevec, tangent;
        texcoord3.x = dot(eyevec, tangent);
        // DP3 result.texcoord[3].y, eyevec, binormal;
        texcoord3.y = dot(eyevec, binormal);
        // DP3 result.texcoord[3].z, eyevec, normal;
        texcoord3.z = dot(eyevec, normal);
    }
};

/// The fragment program of 4.2, with scale and bias for its 0.04 and -0.02.
struct WelshFragment {
    vec3f texcoord3;
    vec2f texcoord0;
    float texel = 0, scale = 0, bias = 0;
    vec3f eyevecs;
    vec2f newtexcoord;

    void main() {
        // DP3 temp, fragment.texcoord[3], fragment.texcoord[3];
        float temp = dot(texcoord3, texcoord3);
        // RSQ temp, temp.x;
        temp = inversesqrt(temp);
        // MUL eyevecs, fragment.texcoord[3], temp;
        eyevecs = texcoord3 * temp;
        // TEX height, fragment.texcoord[0], texture[2], 2D;
        float height = texel;
        // MAD height, height, 0.04, -0.02; # scale and bias
        height = height * scale + bias;
        // RCP temp, eyevecs.z;
        temp = 1.0f / eyevecs.z;
        // MUL height, height, temp;
        height = height * temp;
        // MAD newtexcoord, height, eyevecs, fragment.texcoord[0];
        newtexcoord = vec2f(eyevecs.x, eyevecs.y) * height + texcoord0;
    }
};

}  // namespace quadrel::listings
