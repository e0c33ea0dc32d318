// A float's 32 bits as the codes of a target that holds no floats: WGSL.
// Read back by `quadrel compare shot.png reference.exr --decode bits:hit.U`.

// The bits of a value; of an integer channel the integer itself: u32(steps).
fn value_bits(value: f32) -> u32 { return bitcast<u32>(value); }

// rgba8unorm: bits 0-7 in R, 8-15 in G, 16-23 in B, 24-31 in A. As unpack4x8unorm does.
fn pack_rgba8(bits: u32) -> vec4f {
    return vec4f(vec4u(bits, bits >> 8u, bits >> 16u, bits >> 24u) & vec4u(255u)) / 255.0;
}

// RGB of 8 bits, alpha opaque: 16 of the bits (`high` 0: bits 0-15, 1: bits 16-31) in R and G, in B a
// check byte. Two draws, or two halves of one target, carry a value.
fn pack_rgb8(bits: u32, high: u32) -> vec4f {
    let half_bits = (bits >> (16u * high)) & 65535u;
    let check = (3u * (half_bits & 255u) + 7u * (half_bits >> 8u) + select(165u, 90u, high == 0u)) & 255u;
    return vec4f(vec3f(vec3u(half_bits & 255u, half_bits >> 8u, check)) / 255.0, 1.0);
}

// rg16unorm: bits 0-15 in R, 16-31 in G. As unpack2x16unorm does. Opaque where a target has alpha.
fn pack_rg16(bits: u32) -> vec4f {
    return vec4f(vec2f(vec2u(bits & 65535u, bits >> 16u)) / 65535.0, 0.0, 1.0);
}

// rg16uint, and two targets r16uint.
fn pack_rg16ui(bits: u32) -> vec2u { return vec2u(bits & 65535u, bits >> 16u); }

// rgb10a2unorm: bits 0-9 in R, 10-19 in G, 20-29 in B, 30-31 in A.
fn pack_rgb10a2(bits: u32) -> vec4f {
    return vec4f(vec4u(bits, bits >> 10u, bits >> 20u, bits >> 30u) & vec4u(1023u, 1023u, 1023u, 3u)) /
           vec4f(1023.0, 1023.0, 1023.0, 3.0);
}

// What `quadrel export --pattern` has at a pixel, counted from the top-left: proves a way from the
// target to the file before anything is judged by it.
fn pattern_bits(x: u32, y: u32) -> u32 { return x * 2654435761u + y * 2246822519u; }
