// offset-limit
Hit trace(Frame f) {
    float h = height_at(f, uv);
    return Hit(uv + f.K * ((1.0 - h) * f.r), 1.0 - h, h);
}
