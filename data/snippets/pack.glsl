// A float's 32 bits as the codes of a target that holds no floats: GLSL 330, GLSL ES 300 and later.
// In GLSL ES, `precision highp float; precision highp int;` has to stand in front.
// Read back by `quadrel compare shot.png reference.exr --decode bits:hit.U`.

// The bits of a value; of an integer channel the integer itself: uint(steps).
uint value_bits(float value) { return floatBitsToUint(value); }

// RGBA8: bits 0-7 in R, 8-15 in G, 16-23 in B, 24-31 in A. As unpackUnorm4x8 does.
vec4 pack_rgba8(uint bits) {
    return vec4(uvec4(bits, bits >> 8u, bits >> 16u, bits >> 24u) & 255u) / 255.0;
}

// RGB of 8 bits, alpha opaque: 16 of the bits (`high` 0: bits 0-15, 1: bits 16-31) in R and G, in B a
// check byte. Two draws, or two halves of one target, carry a value.
vec4 pack_rgb8(uint bits, uint high) {
    uint half_bits = (bits >> (16u * high)) & 65535u;
    uint check = (3u * (half_bits & 255u) + 7u * (half_bits >> 8u) + (high == 0u ? 90u : 165u)) & 255u;
    return vec4(vec3(uvec3(half_bits & 255u, half_bits >> 8u, check)) / 255.0, 1.0);
}

// RG16: bits 0-15 in R, 16-31 in G. As unpackUnorm2x16 does. Opaque where a target has alpha.
vec4 pack_rg16(uint bits) { return vec4(vec2(uvec2(bits & 65535u, bits >> 16u)) / 65535.0, 0.0, 1.0); }

// RG16UI, and two targets R16UI.
uvec2 pack_rg16ui(uint bits) { return uvec2(bits & 65535u, bits >> 16u); }

// RGB10_A2: bits 0-9 in R, 10-19 in G, 20-29 in B, 30-31 in A.
vec4 pack_rgb10a2(uint bits) {
    return vec4(uvec4(bits, bits >> 10u, bits >> 20u, bits >> 30u) & uvec4(1023u, 1023u, 1023u, 3u)) /
           vec4(1023.0, 1023.0, 1023.0, 3.0);
}

// What `quadrel export --pattern` has at a pixel, counted from the top-left: proves a way from the
// target to the file before anything is judged by it.
uint pattern_bits(uint x, uint y) { return x * 2654435761u + y * 2246822519u; }
