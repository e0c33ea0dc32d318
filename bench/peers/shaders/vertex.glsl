// Eye space, as Quadrel's frames have it. The matrices are those of the scene.
in vec3 position;
in vec3 normal;
in vec2 mesh_uv;
uniform mat4 to_eye, projection, texture_matrix;
uniform mat3 normal_to_eye;
out vec3 P;
out vec3 vertex_normal;
out vec2 uv;

void main() {
    vec4 at = to_eye * vec4(position, 1.0);
    P = at.xyz;
    vertex_normal = normal_to_eye * normal;
    uv = (texture_matrix * vec4(mesh_uv, 0.0, 1.0)).xy;
    gl_Position = projection * at;
}
