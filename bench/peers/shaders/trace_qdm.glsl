// Quadtree displacement mapping: the texels as blocks, in float, at most NODES nodes a ray. Its
// picture is compared with Quadrel's qdm.
uniform sampler2D max_map;  // each level: the greatest of four texels of the finer one

Hit trace(Frame f) {
    ivec2 texels = textureSize(max_map, 0);
    int top = int(log2(float(texels.x)) + 0.5), level = top;
    vec2 start = fract(uv) * vec2(texels), rate = f.K * vec2(texels);
    vec2 ahead = vec2(rate.x > 0.0 ? 1.0 : 0.0, rate.y > 0.0 ? 1.0 : 0.0);
    // Surely across a border: a small part of a texel further.
    float across = 0.003 / max(max(abs(rate.x), abs(rate.y)), 0.003);
    float s = 0.0, h = 0.0;
    for (int i = 0; i < NODES && s < 1.0; ++i) {
        float side = float(1 << level);
        vec2 node = floor((start + rate * s) / side);
        h = texelFetch(max_map, ivec2(node) & ((texels >> level) - 1), level).x;
        vec2 border = ((node + ahead) * side - start) / rate;
        float leaves = min(rate.x != 0.0 ? border.x : 2.0, rate.y != 0.0 ? border.y : 2.0);
        float meets = max(s, 1.0 - h);
        if (meets < leaves) {  // below the node's top before its border
            s = meets;
            if (level == 0) break;
            --level;
        } else {
            s = leaves + across;
            level = min(level + 1, top);
        }
    }
    s = min(s, 1.0);
    return Hit(uv + f.K * s, s, h);
}
