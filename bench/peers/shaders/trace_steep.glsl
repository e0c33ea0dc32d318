// steep
Hit trace(Frame f) {
    float n = ceil(float(2 * STEPS) - clamp(f.r, 0.0, 1.0) * float(STEPS));
    float h = 0.0;
    for (int k = 0; k <= int(n); ++k) {
        float s = min(float(k) / n, 1.0);
        h = height_at(f, uv + f.K * s);
        if (h >= 1.0 - s) return Hit(uv + f.K * s, s, h);
    }
    return Hit(uv + f.K, 1.0, h);
}
