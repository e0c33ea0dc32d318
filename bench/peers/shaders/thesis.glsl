// "Derivative-Based Relief Mapping" (2012), Parallax.frag, as Quadrel's published rows have it:
// frame-thesis, linear-thesis, h2n-thesis, shadow-march-thesis, shade-thesis. Maps are RGBA, not the
// A8R8G8B8 of the source.
in vec3 P;
in vec3 vertex_normal;
in vec2 uv;
uniform sampler2D color_map, height_map, gloss_map;
uniform samplerCube environment_map;
uniform float relief_depth;
uniform vec3 light_position;
uniform vec3 light_ambient, specular;  // specular: the light's times the material's
out vec4 color;

const float step_length = 1.0 / 128.0;

void main() {
    vec3 E = normalize(-P);
    vec3 N = normalize(vertex_normal);
    vec3 T = normalize(dFdx(P)), B = normalize(dFdy(P));
    vec3 flat_T = T, flat_B = B;
    vec3 flat_N = normalize(cross(T, B));
    if (dot(flat_N, vertex_normal) < 0.0) flat_N *= -1.0;
    vec3 SSR = (-E) / dot(-N, -E);
    vec3 SR = SSR + N * dot(-N, SSR);
    vec2 dUVdT = dFdx(uv) / length(dFdx(P)), dUVdB = dFdy(uv) / length(dFdy(P));
    vec2 dUVdSR = dUVdT * dot(SR, T) + dUVdB * dot(SR, B);
#ifdef PLANTED
    dUVdSR *= 1.1;
#endif

    float offset = 0.0, taken = 0.0;
    for (taken = 0.0; taken <= 128.0; taken += 1.0) {
        float depth = (1.0 - texture(height_map, uv + dUVdSR * offset).x) * relief_depth;
        if (offset > depth) break;
        offset += step_length;
    }
    vec3 SP = P + SR * offset;
    vec3 hit = P + SSR * offset;
    vec2 UV = uv + dUVdSR * offset;

    float H1 = 1.0 - texture(height_map, UV + dUVdT * step_length).x;
    float H2 = 1.0 - texture(height_map, UV - dUVdT * step_length).x;
    float H3 = 1.0 - texture(height_map, UV + dUVdB * step_length).x;
    float H4 = 1.0 - texture(height_map, UV - dUVdB * step_length).x;
    vec3 P1 = SP + T * step_length + relief_depth * H1 * -N;
    vec3 P2 = SP - T * step_length + relief_depth * H2 * -N;
    vec3 P3 = SP + B * step_length + relief_depth * H3 * -N;
    vec3 P4 = SP - B * step_length + relief_depth * H4 * -N;
    T = normalize(P1 - P2);
    B = normalize(P3 - P4);
    N = normalize(cross(T, B)) + (normalize(vertex_normal) - flat_N);
    if (dot(normalize(N), normalize(vertex_normal)) < 0.0) N *= -1.0;

    vec4 base = texture(color_map, UV);
    vec3 gloss = texture(gloss_map, UV).wxy;  // shininess / 255, eta / 2, mirror
    vec3 reflected = normalize(reflect(-E, N));
    vec3 refracted = normalize(refract(-E, N, 2.0 * gloss.y));

    vec3 L = normalize(light_position - hit);
    float intensity = 1.0;
    vec3 light_ray = L / dot(L, flat_N);
    vec2 light_step = (dUVdT * dot(light_ray, flat_T) + dUVdB * dot(light_ray, flat_B)) / 128.0;
    if (dot(L, flat_N) <= 0.01) {
        intensity = 0.0;
    } else {
        vec2 at = UV;
        float light_depth = offset;
        for (; taken >= 0.0; taken -= 1.0) {
            light_depth -= step_length;
            at += light_step;
            if (light_depth > 1.0 - texture(height_map, at).x) {
                intensity = 0.0;
                break;
            }
        }
    }
    vec3 lit = base.rgb * (light_ambient + dot(N, L) * intensity);
    lit += specular * (pow(max(dot(reflect(-L, N), E), 0.0), 255.0 * gloss.x) * intensity);
    vec3 bent = mix(texture(environment_map, refracted).rgb, lit, base.a);
    color = vec4(mix(bent, texture(environment_map, reflected).rgb, gloss.z), base.a);
}
