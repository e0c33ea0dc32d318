// The colour map, filtered between two levels, under one light.
void main() {
    vec3 N = normalize(vertex_normal);
    if (dot(N, -P) < 0.0) N = -N;
    vec4 base = texture(color_map, uv);
#ifdef PLANTED
    base = texture(color_map, uv * 1.001);
#endif
    vec3 L = normalize(light_position - P);
    color = vec4(ambient * base.rgb + diffuse * base.rgb * max(dot(N, L), 0.0), base.a);
}
