// rabbid-pom, names as in its source
Hit trace(Frame f) {
    vec3 texDir3D = normalize(vec3(f.K, -1.0));
    float quality = mix(0.5, 1.0, 1.0 - texDir3D.z * texDir3D.z);
    float numSteps = clamp(quality * 50.0, 1.0, 50.0);
    vec2 texStep = texDir3D.xy / abs(texDir3D.z);
    vec2 texC = uv + texStep;
    float bumpHeightStep = 1.0 / numSteps;
    float mapHeight = 1.0, bestBumpHeight = 1.0;
    for (int i = 0; i < int(numSteps); ++i) {
        mapHeight = clamp(texture(height_map, texC - texStep * bestBumpHeight).x, 0.0, 1.0);
        if (mapHeight >= bestBumpHeight) break;
        bestBumpHeight -= bumpHeightStep;
    }
    bestBumpHeight -= bumpHeightStep * clamp((bestBumpHeight - mapHeight) / bumpHeightStep, 0.0, 1.0);
    return Hit(texC - texStep * bestBumpHeight, 1.0 - bestBumpHeight, mapHeight);
}
