// Random shading points, and the lighting written down once more in double, one light and one
// channel at a time, from the formulas of the Phong model.
#pragma once

#include <algorithm>

#include "quadrel/num/math.hpp"
#include "relief/inputs.hpp"
#include "relief/vertex_inputs.hpp"
#include "shade/planted.hpp"

namespace quadrel::test {

/// Shading points in front of the eye, normals on the viewer's side, visibilities in [0, 1] for
/// every light; no textures, and no frame, so that every vector stays in eye space.
inline Batch<float> random_points(Random& random, int lights, int lanes = 64) {
    Batch<float> batch(lanes);
    random_material(random, batch.material);
    batch.frame.light_count = lights;
    for (LightUniforms& light : batch.frame.lights) {
        random_light(random, light);
        light.directional = random.chance(0.3);
    }
    for (int lane = 0; lane < lanes; ++lane) {
        const dvec3 P(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-4, -1));
        dvec3 N = random_direction(random);
        if (dot(N, P) > 0) N = -N;
        batch.set(Value::P, lane, P);
        batch.set(Value::hit_P, lane, P * random.uniform(1, 1.1));
        batch.set(Value::N, lane, N);
        for (const Value v : {Value::T, Value::B, Value::frame_normal})
            batch.set(v, lane, dvec3(0.0));
        if (lane % 4 == 0) set_quad_vertices(batch, lane / 4, P, VertexAxes{});
        batch.set(Value::hit_uv, lane, dvec2(random.uniform(0, 1), random.uniform(0, 1)));
        batch.set(Value::dUVdx, lane, dvec2(0.001, 0));
        batch.set(Value::dUVdy, lane, dvec2(0, 0.001));
        batch.real(Value::occlusion, lane) = static_cast<float>(random.uniform(0, 1));
        for (int light = 0; light < max_lights; ++light) {
            batch.real(Value::shadow_visibility, lane, 0, light) =
                static_cast<float>(random.uniform(0, 1));
        }
    }
    return batch;
}

/// No ambient occlusion.
inline void open_sky(Batch<float>& batch) {
    for (int lane = 0; lane < batch.lanes; ++lane) batch.real(Value::occlusion, lane) = 1;
}

/// One texel of the given channels.
inline Map constant_map(const vec4<float>& texel) {
    return make_map(
        1, 1, 4, [texel](int, int, int c) { return texel[c]; }, plain_sampler());
}
/// An environment of faces of one random colour each, or all white; bilinear.
inline Map cube_map(Random& random, int size, bool white) {
    std::array<Image, 6> faces;
    for (Image& face : faces) {
        face.width = face.height = size;
        face.channels = 3;
        for (int i = 0; i < size * size * 3; ++i) {
            face.values.push_back(white ? 1.0f : static_cast<float>(random.uniform(0, 1)));
        }
    }
    Map map{make_cube_texture(faces)};
    map.sampled = {map.texture->view(), plain_sampler()};
    return map;
}

/// Base colour, gloss and emissive texels, of maps or of their absence.
struct Surface {
    vec4<float> base = vec4<float>(1), gloss = vec4<float>(0), glow = vec4<float>(0);
};

struct Lighting {
    dvec3 ambient{0.0}, diffuse{0.0}, specular{0.0};
};

inline dvec3 three(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// What light `i` adds at a lane.
inline Lighting one_light(Batch<float>& batch, int lane, int i, const Surface& surface) {
    const LightUniforms& light = batch.frame.lights[i];
    const MaterialUniforms& material = batch.material;
    const dvec3 base(surface.base), P(batch.vector3(Value::hit_P, lane));
    const dvec3 to_light = three(light.position) - (light.directional ? dvec3(0.0) : P);
    const double d = length(to_light);
    const dvec3 L = to_light / d, N(batch.vector3(Value::N, lane));
    const dvec3 V = normalize(-dvec3(batch.vector3(Value::P, lane)));
    const float(&a)[3] = light.attenuation;
    double arriving = batch.real(Value::shadow_visibility, lane, 0, i) * light.intensity;
    if (!light.directional) arriving /= a[0] + a[1] * d + a[2] * d * d;
    Lighting result;
    result.ambient = three(light.ambient) * three(material.ambient) * base;
    const double cosine = dot(N, L);
    if (cosine <= 0) return result;
    const dvec3 R = N * (2 * cosine) - L;
    const double highlight = pow(std::max(dot(R, V), 0.0), 255.0 * surface.gloss.r);
    result.diffuse = three(light.diffuse) * three(material.diffuse) * base * (cosine * arriving);
    result.specular = three(light.specular) * three(material.specular) * (highlight * arriving);
    return result;
}

inline Lighting all_lights(Batch<float>& batch, int lane, const Surface& surface) {
    Lighting sum;
    for (int i = 0; i < batch.frame.light_count; ++i) {
        const Lighting light = one_light(batch, lane, i, surface);
        sum.ambient += light.ambient;
        sum.diffuse += light.diffuse;
        sum.specular += light.specular;
    }
    sum.ambient *= batch.real(Value::occlusion, lane);
    return sum;
}

/// |a - b| <= 3e-4 (1 + |b|), a component. High powers of a rounded cosine take most of it.
inline bool near(const vec3<float>& a, const dvec3& b) {
    for (int c = 0; c < 3; ++c) {
        if (!(std::abs(a[c] - b[c]) <= 3e-4 * (1 + std::abs(b[c])))) return false;
    }
    return true;
}

}  // namespace quadrel::test
