// Frame, search, shadow, light.
void main() {
    Frame f = surface_frame();
    Hit hit = trace(f);
    vec3 hit_P = P - f.V / f.r * (hit.s * relief_depth);
    vec3 L = normalize(light_position - hit_P);
    vec4 base = textureGrad(color_map, hit.uv, f.dx, f.dy);
    float lit = max(dot(f.N, L), 0.0) * visibility(f, hit, L);
    color = vec4(ambient * base.rgb + diffuse * base.rgb * lit, base.a);
}
