// relief-binary
Hit trace(Frame f) {
    float above = 0.0, below = 1.0, h_below = 0.0;
    bool found = false;
    for (int k = 0; k <= STEPS; ++k) {
        float s = float(k) / float(STEPS);
        h_below = height_at(f, uv + f.K * s);
        if (h_below >= 1.0 - s) {
            below = s;
            found = true;
            break;
        }
        above = s;
    }
    if (found) {
        for (int i = 0; i < BINARY_STEPS; ++i) {
            float middle = (above + below) * 0.5;
            float h = height_at(f, uv + f.K * middle);
            if (h >= 1.0 - middle) {
                below = middle;
                h_below = h;
            } else {
                above = middle;
            }
        }
    }
    return Hit(uv + f.K * below, below, h_below);
}
