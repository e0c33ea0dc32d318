// What all rows but the thesis' share: inputs, the derivative frame, matte light.
in vec3 P;
in vec3 vertex_normal;
in vec2 uv;
uniform sampler2D color_map, height_map;
uniform float relief_depth;
uniform vec3 light_position;    // eye space
uniform vec3 ambient, diffuse;  // the light's times the material's
out vec4 color;

struct Frame {
    vec3 V, N;            // to the eye; the normal on the viewer's side
    vec3 grad_u, grad_v;  // rows of d(u, v)/dP
    float r;              // V.N
    vec2 K;               // UV shift through the whole relief
    vec2 dx, dy;          // differences of the undisplaced UV
};

struct Hit {
    vec2 uv;
    float s, h;  // depth in units of the relief's, height
};

// frame-gram
Frame surface_frame() {
    Frame f;
    f.V = normalize(-P);
    f.N = normalize(vertex_normal);
    if (dot(f.N, f.V) < 0.0) f.N = -f.N;
    vec3 px = dFdx(P), py = dFdy(P);
    f.dx = dFdx(uv);
    f.dy = dFdy(uv);
    vec3 n = cross(px, py);
    float n2 = dot(n, n);
    vec3 dual_x = cross(py, n) / n2, dual_y = cross(n, px) / n2;
    f.grad_u = dual_x * f.dx.x + dual_y * f.dy.x;
    f.grad_v = dual_x * f.dx.y + dual_y * f.dy.y;
    f.r = dot(f.V, f.N);
    f.K = -vec2(dot(f.grad_u, f.V), dot(f.grad_v, f.V)) / f.r * relief_depth;
#ifdef PLANTED  // a wrong shader, which the comparison has to notice
    f.K *= 1.1;
#endif
    return f;
}

float height_at(Frame f, vec2 at) { return textureGrad(height_map, at, f.dx, f.dy).x; }
