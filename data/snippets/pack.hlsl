// A float's 32 bits as the codes of a target that holds no floats: HLSL, shader model 4.0 and later.
// Read back by `quadrel compare shot.png reference.exr --decode bits:hit.U`.

// The bits of a value; of an integer channel the integer itself: (uint)steps.
uint value_bits(float value) { return asuint(value); }

// R8G8B8A8_UNORM: bits 0-7 in R, 8-15 in G, 16-23 in B, 24-31 in A.
float4 pack_rgba8(uint bits) {
    return float4(uint4(bits, bits >> 8, bits >> 16, bits >> 24) & 255u) / 255.0;
}

// RGB of 8 bits, alpha opaque: 16 of the bits (`high` 0: bits 0-15, 1: bits 16-31) in R and G, in B a
// check byte. Two draws, or two halves of one target, carry a value.
float4 pack_rgb8(uint bits, uint high) {
    uint half_bits = (bits >> (16 * high)) & 65535u;
    uint check = (3u * (half_bits & 255u) + 7u * (half_bits >> 8) + (high == 0 ? 90u : 165u)) & 255u;
    return float4(float3(uint3(half_bits & 255u, half_bits >> 8, check)) / 255.0, 1.0);
}

// R16G16_UNORM: bits 0-15 in R, 16-31 in G. Opaque where a target has alpha.
float4 pack_rg16(uint bits) { return float4(float2(uint2(bits & 65535u, bits >> 16)) / 65535.0, 0.0, 1.0); }

// R16G16_UINT, and two targets R16_UINT.
uint2 pack_rg16ui(uint bits) { return uint2(bits & 65535u, bits >> 16); }

// R10G10B10A2_UNORM: bits 0-9 in R, 10-19 in G, 20-29 in B, 30-31 in A.
float4 pack_rgb10a2(uint bits) {
    return float4(uint4(bits, bits >> 10, bits >> 20, bits >> 30) & uint4(1023, 1023, 1023, 3)) /
           float4(1023.0, 1023.0, 1023.0, 3.0);
}

// What `quadrel export --pattern` has at a pixel, counted from the top-left: proves a way from the
// target to the file before anything is judged by it.
uint pattern_bits(uint x, uint y) { return x * 2654435761u + y * 2246822519u; }
