// A transcription of the listing Parallax.frag, line by line, for the four fragments of a quad:
// what the stages called "published" have to reproduce bit for bit.
//
// Source: "Derivative-based relief mapping", Oregon State University, 2012, appendix: Parallax.vert
// and Parallax.frag. Above each line of code stands the line of the listing that it transcribes;
// the names are the listing's. A Float is the variable of four fragments; the operators act on each
// fragment apart. `if`, `break` and loops are written out fragment by fragment, so nothing here
// goes through masks. The built-ins are those of num/functions.hpp; derivatives are this file's
// own.
//
// What the listing leaves open: a texture read inside a loop takes its gradients over all four
// fragments, and one that has left the loop keeps the coordinate that it read last; a fragment that
// never entered one has the coordinate from before the loop. Texels come in the order A R G B, as
// the listing's own note says; the height map holds one channel, which is its first; the
// environment's images have no alpha, so that its texels are R G B.
#pragma once

#include "quadrel/num/math.hpp"
#include "quadrel/texture/cube.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel::thesis {

using Float = Quad<float>;
using Vec2 = vec2<Float>;
using Vec3 = vec3<Float>;
using Vec4 = vec4<Float>;

/// Fine differences: each row its own in x, each column its own in y; y grows with lanes 2 and 3.
inline Float dFdx(Float v) {
    const float top = v.lane[1] - v.lane[0], bottom = v.lane[3] - v.lane[2];
    return {top, top, bottom, bottom};
}
inline Float dFdy(Float v) {
    const float left = v.lane[2] - v.lane[0], right = v.lane[3] - v.lane[1];
    return {left, right, left, right};
}
inline Vec2 dFdx(const Vec2& v) { return {dFdx(v.x), dFdx(v.y)}; }
inline Vec2 dFdy(const Vec2& v) { return {dFdy(v.x), dFdy(v.y)}; }
inline Vec3 dFdx(const Vec3& v) { return {dFdx(v.x), dFdx(v.y), dFdx(v.z)}; }
inline Vec3 dFdy(const Vec3& v) { return {dFdy(v.x), dFdy(v.y), dFdy(v.z)}; }

/// `v *= -1.` in one fragment.
inline void negate_fragment(Vec3& v, int fragment) {
    for (int c = 0; c < 3; ++c) v[c].lane[fragment] *= -1.0f;
}

/// A height map of one channel; an RGBA map; a cube map. Null: not bound, every texel 0.
struct HeightMap {
    const SampledTexture* bound = nullptr;
};
struct ColorMap {
    const SampledTexture* bound = nullptr;
};
struct CubeMap {
    const SampledTexture* bound = nullptr;
};

inline Vec4 texture(const HeightMap& map, const Vec2& at) {
    if (map.bound == nullptr) return Vec4(Float(0.0f));
    return {quadrel::texture(*map.bound, SampleContext<Float>(), at).x, Float(0.0f), Float(0.0f),
            Float(0.0f)};
}
inline Vec4 argb(const Vec4& rgba) { return {rgba.a, rgba.r, rgba.g, rgba.b}; }
inline Vec4 texture(const ColorMap& map, const Vec2& at) {
    if (map.bound == nullptr) return Vec4(Float(0.0f));
    return argb(quadrel::texture(*map.bound, SampleContext<Float>(), at));
}
inline Vec4 texture(const CubeMap& map, const Vec3& at) {
    if (map.bound == nullptr) return Vec4(Float(0.0f));
    return quadrel::texture_cube(*map.bound, SampleContext<Float>(), at);
}
inline Vec3 rgb(const Vec4& v) { return {v.r, v.g, v.b}; }
inline Vec3 gba(const Vec4& v) { return {v.g, v.b, v.a}; }

/// The uniforms that the listing reads, with its defaults. (Others are declared and never read.)
struct Uniforms {
    // uniform float MaxParallaxOffset = 0.05;
    Float MaxParallaxOffset = 0.05f;
    // uniform vec4 Light0_Ambient = vec4( 0.1, 0.1, 0.1, 1. );
    Vec4 Light0_Ambient = {Float(0.1f), Float(0.1f), Float(0.1f), Float(1.0f)};
    // uniform vec4 Light0_Specular = vec4( 1., 1., 1., 1. );
    Vec4 Light0_Specular = {Float(1.0f), Float(1.0f), Float(1.0f), Float(1.0f)};
    // uniform vec4 Material_Specular = vec4( 0.3, 0.3, 0.3, 1. );
    Vec4 Material_Specular = {Float(0.3f), Float(0.3f), Float(0.3f), Float(1.0f)};
    // uniform sampler2D Color_Map;
    ColorMap Color_Map;
    // uniform sampler2D Emissive_Map;
    ColorMap Emissive_Map;
    // uniform samplerCube Environment_Map;
    CubeMap Environment_Map;
    // uniform sampler2D Gloss_Map;
    ColorMap Gloss_Map;
    // uniform sampler2D Normal_Map;
    HeightMap Normal_Map;
};

/// What Parallax.vert passes on.
struct Varyings {
    // in vec3 EC_SurfacePosition;
    Vec3 EC_SurfacePosition;
    // EC_CameraPosition = vec3( 0., 0., 0. );
    Vec3 EC_CameraPosition = Vec3(Float(0.0f));
    // in vec3 EC_SurfaceNormal;
    Vec3 EC_SurfaceNormal;
    // in vec3 EC_LightPosition;
    Vec3 EC_LightPosition;
    // in vec2 vST;
    Vec2 vST;
};

/// The variables of main, and main in the listing's sections.
struct ParallaxFrag : Uniforms, Varyings {
    Vec3 P, E, N, T, B, T_Flat_Shading, B_Flat_Shading, N_Flat_Shading, SSR, SR, SP;
    Vec2 UV, dUVdT, dUVdB, dUVdSR;
    Float ParallaxScalar, Sample, Max_Samples, OffsetPerSample, Curr_Offset, Offset;
    Vec3 Ambient_Color, Diffuse_Color, Specular_Color, Emissive_Color, Phong_Color;
    Vec3 Refraction_Color, Reflection_Color, Final_Color, Reflect, Refract, L;
    Float Shininess, Eta, Mirror, Light_Intensity, Light_H;
    Vec2 LightTexOffsetPerSample, LightTexCoord;
    Vec3 gl_FragColor;

    void main() {
        unit_vectors();
        sub_surface_ray();
        linear_sampling();
        update_coordinates();
        recalculate_normal();
        color_initialization();
        self_shadowing();
        light_calculations();
        reflection_and_refraction();
    }

    // 1. Parallax Mapping.
    void unit_vectors() {
        // float ParallaxScalar = MaxParallaxOffset;
        ParallaxScalar = MaxParallaxOffset;
        // vec3 P = EC_SurfacePosition;
        P = EC_SurfacePosition;
        // vec3 E = normalize( EC_CameraPosition - EC_SurfacePosition );
        E = normalize(EC_CameraPosition - EC_SurfacePosition);
        // vec3 N = normalize( EC_SurfaceNormal );
        N = normalize(EC_SurfaceNormal);
        // vec2 UV = vST;
        UV = vST;
        // vec3 T_Flat_Shading =  normalize( dFdx( P ) );
        T_Flat_Shading = normalize(dFdx(P));
        // vec3 T = T_Flat_Shading;
        T = T_Flat_Shading;
        // vec3 B_Flat_Shading = normalize( dFdy( P ) );
        B_Flat_Shading = normalize(dFdy(P));
        // vec3 B = B_Flat_Shading;
        B = B_Flat_Shading;
        // vec3 N_Flat_Shading = normalize( cross( T, B ) );
        N_Flat_Shading = normalize(cross(T, B));
        // if( dot( N_Flat_Shading, EC_SurfaceNormal ) < 0. ) N_Flat_Shading *= -1.;
        const Float facing = dot(N_Flat_Shading, EC_SurfaceNormal);
        for (int i = 0; i < 4; ++i) {
            if (facing.lane[i] < 0.0f) negate_fragment(N_Flat_Shading, i);
        }
    }

    void sub_surface_ray() {
        // vec3 SSR = ( -E ) / dot( -N, -E );
        SSR = (-E) / dot(-N, -E);
        // vec3 SR = SSR + ( N * dot( -N, SSR ) );
        SR = SSR + (N * dot(-N, SSR));
        // vec2 dUVdT = dFdx( UV ) / length( dFdx( P ) );
        dUVdT = dFdx(UV) / length(dFdx(P));
        // vec2 dUVdB = dFdy( UV ) / length( dFdy( P ) );
        dUVdB = dFdy(UV) / length(dFdy(P));
        // vec2 dUVdSR = ( dUVdT * dot( SR, T ) ) + ( dUVdB * dot( SR, B ) );
        dUVdSR = (dUVdT * dot(SR, T)) + (dUVdB * dot(SR, B));
    }

    void linear_sampling() {
        // float Sample = 0.;
        Sample = 0.0f;
        // float Max_Samples = 128.;
        Max_Samples = 128.0f;
        // float Max_Offset = 1.;
        const Float Max_Offset = 1.0f;
        // float Min_Offset = 0.;
        const Float Min_Offset = 0.0f;
        // float Curr_Offset = 0.;
        Curr_Offset = 0.0f;
        // float OffsetPerSample = Min_Offset + ( Max_Offset / Max_Samples );
        OffsetPerSample = Min_Offset + (Max_Offset / Max_Samples);
        bool inside[4] = {true, true, true, true};
        // for( Sample = 0.; Sample <= Max_Samples; Sample += 1. )
        while (any_inside(inside, Sample, Max_Samples)) {
            // float SSR_H = Curr_Offset;
            const Float SSR_H = Curr_Offset;
            // float Tex_H = ( 1. - texture( Normal_Map, UV + ( dUVdSR * Curr_Offset ) ).r ) *
            //               ParallaxScalar;
            const Float Tex_H =
                (1.0f - texture(Normal_Map, UV + (dUVdSR * Curr_Offset)).r) * ParallaxScalar;
            for (int i = 0; i < 4; ++i) {
                // if( SSR_H > Tex_H ) break;
                if (SSR_H.lane[i] > Tex_H.lane[i]) inside[i] = false;
                if (!inside[i]) continue;
                // Curr_Offset += OffsetPerSample;
                Curr_Offset.lane[i] += OffsetPerSample.lane[i];
                Sample.lane[i] += 1.0f;
            }
        }
    }

    /// The condition `count <= last` of a loop in each fragment that is still inside; whether any
    /// is.
    static bool any_inside(bool (&inside)[4], Float count, Float last) {
        for (int i = 0; i < 4; ++i) inside[i] = inside[i] && count.lane[i] <= last.lane[i];
        return inside[0] || inside[1] || inside[2] || inside[3];
    }

    void update_coordinates() {
        // float Offset = Curr_Offset;
        Offset = Curr_Offset;
        // vec3 SP = P + ( SR * Offset );
        SP = P + (SR * Offset);
        // P = P + ( SSR * Offset );
        P = P + (SSR * Offset);
        // UV = UV + ( dUVdSR * Curr_Offset );
        UV = UV + (dUVdSR * Curr_Offset);
    }

    void recalculate_normal() {
        // vec2 UV1 = UV + ( dUVdT * OffsetPerSample );
        const Vec2 UV1 = UV + (dUVdT * OffsetPerSample);
        // vec2 UV2 = UV - ( dUVdT * OffsetPerSample );
        const Vec2 UV2 = UV - (dUVdT * OffsetPerSample);
        // vec2 UV3 = UV + ( dUVdB * OffsetPerSample );
        const Vec2 UV3 = UV + (dUVdB * OffsetPerSample);
        // vec2 UV4 = UV - ( dUVdB * OffsetPerSample );
        const Vec2 UV4 = UV - (dUVdB * OffsetPerSample);
        // float H1 = 1. - texture( Normal_Map, UV1 ).r;
        const Float H1 = 1.0f - texture(Normal_Map, UV1).r;
        // float H2 = 1. - texture( Normal_Map, UV2 ).r;
        const Float H2 = 1.0f - texture(Normal_Map, UV2).r;
        // float H3 = 1. - texture( Normal_Map, UV3 ).r;
        const Float H3 = 1.0f - texture(Normal_Map, UV3).r;
        // float H4 = 1. - texture( Normal_Map, UV4 ).r;
        const Float H4 = 1.0f - texture(Normal_Map, UV4).r;
        // vec3 P1 = SP + ( T * OffsetPerSample ) + ( ParallaxScalar * H1 * -N );
        const Vec3 P1 = SP + (T * OffsetPerSample) + (ParallaxScalar * H1 * -N);
        // vec3 P2 = SP - ( T * OffsetPerSample ) + ( ParallaxScalar * H2 * -N );
        const Vec3 P2 = SP - (T * OffsetPerSample) + (ParallaxScalar * H2 * -N);
        // vec3 P3 = SP + ( B * OffsetPerSample ) + ( ParallaxScalar * H3 * -N );
        const Vec3 P3 = SP + (B * OffsetPerSample) + (ParallaxScalar * H3 * -N);
        // vec3 P4 = SP - ( B * OffsetPerSample ) + ( ParallaxScalar * H4 * -N );
        const Vec3 P4 = SP - (B * OffsetPerSample) + (ParallaxScalar * H4 * -N);
        combine_normal(P1 - P2, P3 - P4);
    }

    /// The rest of that section; the arguments are `P1 - P2` and `P3 - P4`.
    void combine_normal(const Vec3& P1_P2, const Vec3& P3_P4) {
        // T = normalize( P1 - P2 );
        T = normalize(P1_P2);
        // B = normalize( P3 - P4 );
        B = normalize(P3_P4);
        // N = normalize( cross( T, B ) );
        N = normalize(cross(T, B));
        // vec3 Normal_Difference = normalize( EC_SurfaceNormal ) - normalize( N_Flat_Shading );
        const Vec3 Normal_Difference = normalize(EC_SurfaceNormal) - normalize(N_Flat_Shading);
        // N += Normal_Difference;
        N += Normal_Difference;
        // if( dot( normalize( N ), normalize( EC_SurfaceNormal ) ) < 0. ) N *= -1.;
        const Float facing = dot(normalize(N), normalize(EC_SurfaceNormal));
        for (int i = 0; i < 4; ++i) {
            if (facing.lane[i] < 0.0f) negate_fragment(N, i);
        }
    }

    // 2. Color Initialization
    void color_initialization() {
        // vec3 BLACK = vec3( 0.,0.,0. );  and nine colours = BLACK, each assigned again below
        // float Shininess = 255. * texture( Gloss_Map, UV ).r; // [0,1] -> [0, 255]
        Shininess = 255.0f * texture(Gloss_Map, UV).r;
        // float Eta = 2. * texture( Gloss_Map, UV ).g; // [0,1] -> [0, 2]
        Eta = 2.0f * texture(Gloss_Map, UV).g;
        // float Mirror = texture( Gloss_Map, UV ).b; // [0,1] -> [0,1]
        Mirror = texture(Gloss_Map, UV).b;
        // vec3 Reflect = normalize( reflect( -E, N ) );
        Reflect = normalize(reflect(-E, N));
        // vec3 Refract = normalize( refract( -E, N, Eta ) );
        Refract = normalize(refract(-E, N, Eta));
    }

    // 3. Per Light Calculations
    void self_shadowing() {
        // vec3 L = normalize( EC_LightPosition - P );
        L = normalize(EC_LightPosition - P);
        // Ambient_Color = Light0_Ambient.rgb * texture( Color_Map, UV ).gba;
        Ambient_Color = rgb(Light0_Ambient) * gba(texture(Color_Map, UV));
        // float Light_Intensity = 1.;
        Light_Intensity = 1.0f;
        // vec3 LightRay = ( L ) / dot( L, N_Flat_Shading );
        const Vec3 LightRay = (L) / dot(L, N_Flat_Shading);
        // vec2 LightTexOffset = ( dUVdT * dot( LightRay, T_Flat_Shading ) )
        //                       + ( dUVdB * dot( LightRay, B_Flat_Shading ) );
        const Vec2 LightTexOffset =
            (dUVdT * dot(LightRay, T_Flat_Shading)) + (dUVdB * dot(LightRay, B_Flat_Shading));
        // vec2 LightTexOffsetPerSample = LightTexOffset / Max_Samples;
        LightTexOffsetPerSample = LightTexOffset / Max_Samples;
        // vec2 LightTexCoord = UV;
        LightTexCoord = UV;
        // float Light_H = Curr_Offset;
        Light_H = Curr_Offset;
        const Float above = dot(L, N_Flat_Shading);
        bool inside[4];
        for (int i = 0; i < 4; ++i) {
            // if( dot( L, N_Flat_Shading ) <= 0.01 ) Light_Intensity = 0.;
            // else
            inside[i] = !(above.lane[i] <= 0.01f);
            if (!inside[i]) Light_Intensity.lane[i] = 0.0f;
        }
        march_to_light(inside);
    }

    void march_to_light(bool (&inside)[4]) {
        // for( float LightSample = Sample; LightSample >= 0.; LightSample -= 1. )
        Float LightSample = Sample;
        while (any_inside(inside, Float(0.0f), LightSample)) {
            for (int i = 0; i < 4; ++i) {
                if (!inside[i]) continue;
                // Light_H -= OffsetPerSample;
                Light_H.lane[i] -= OffsetPerSample.lane[i];
                // LightTexCoord += LightTexOffsetPerSample;
                LightTexCoord.x.lane[i] += LightTexOffsetPerSample.x.lane[i];
                LightTexCoord.y.lane[i] += LightTexOffsetPerSample.y.lane[i];
            }
            // float Tex_H = ( 1. - texture( Normal_Map, LightTexCoord ).r );
            const Float Tex_H = (1.0f - texture(Normal_Map, LightTexCoord).r);
            for (int i = 0; i < 4; ++i) {
                if (!inside[i]) continue;
                // if( Light_H > Tex_H ) { Light_Intensity = 0.; break; }
                if (Light_H.lane[i] > Tex_H.lane[i]) {
                    Light_Intensity.lane[i] = 0.0f;
                    inside[i] = false;
                }
                if (inside[i]) LightSample.lane[i] -= 1.0f;
            }
        }
    }

    void light_calculations() {
        // float Diffuse_Intensity = dot( N, L ) * Light_Intensity;
        const Float Diffuse_Intensity = dot(N, L) * Light_Intensity;
        // Diffuse_Color = Diffuse_Intensity * texture( Color_Map, UV ).gba;
        Diffuse_Color = Diffuse_Intensity * gba(texture(Color_Map, UV));
        // float Specular_Intensity = pow( max( dot( reflect( -L, N ), E ), 0. ), Shininess )
        //                            * Light_Intensity;
        const Float Specular_Intensity =
            pow(max(dot(reflect(-L, N), E), Float(0.0f)), Shininess) * Light_Intensity;
        // Specular_Color = Light0_Specular.rgb * Material_Specular.rgb * Specular_Intensity;
        Specular_Color = rgb(Light0_Specular) * rgb(Material_Specular) * Specular_Intensity;
        // Emissive_Color = texture( Emissive_Map, UV ).rgb;
        Emissive_Color = rgb(texture(Emissive_Map, UV));
        // Phong_Color = Emissive_Color + Ambient_Color + Diffuse_Color + Specular_Color;
        Phong_Color = Emissive_Color + Ambient_Color + Diffuse_Color + Specular_Color;
    }

    // 4. Reflection and Refraction Calculations
    void reflection_and_refraction() {
        // Reflection_Color = texture( Environment_Map, Reflect ).rgb;
        Reflection_Color = rgb(texture(Environment_Map, Reflect));
        // Refraction_Color = texture( Environment_Map, Refract ).rgb;
        Refraction_Color = rgb(texture(Environment_Map, Refract));
        // Final_Color = mix( Refraction_Color, Phong_Color, texture( Color_Map, UV ).r );
        Final_Color = mix(Refraction_Color, Phong_Color, texture(Color_Map, UV).r);
        // Final_Color = mix( Final_Color, Reflection_Color, Mirror );
        Final_Color = mix(Final_Color, Reflection_Color, Mirror);
        // gl_FragColor.rgb = Final_Color.rgb;
        gl_FragColor = Final_Color;
    }
};

}  // namespace quadrel::thesis
