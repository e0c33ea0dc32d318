// linear
Hit trace(Frame f) {
    float h = 0.0;
    for (int k = 0; k <= STEPS; ++k) {
        float s = float(k) / float(STEPS);
        h = height_at(f, uv + f.K * s);
        if (h >= 1.0 - s) return Hit(uv + f.K * s, s, h);
    }
    return Hit(uv + f.K, 1.0, h);
}
