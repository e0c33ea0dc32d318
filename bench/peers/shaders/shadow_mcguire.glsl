// shadow-march-mcguire
float visibility(Frame f, Hit hit, vec3 L) {
    float rise = dot(L, f.N);
    if (!(rise > 0.0)) return 0.0;
    vec2 K = vec2(dot(f.grad_u, L), dot(f.grad_v, L)) / rise * relief_depth;
    float z = max(1.0 - hit.s, hit.h);
    float n = max(trunc(mix(60.0, 5.0, clamp(rise, 0.0, 1.0))), 1.0);
    for (int k = 1; k <= 60; ++k) {
        float t = (float(k) + 0.1) / n;
        if (!(z + t < 1.0)) break;
        if (height_at(f, hit.uv + K * t) >= z + t) return 0.0;
    }
    return 1.0;
}
