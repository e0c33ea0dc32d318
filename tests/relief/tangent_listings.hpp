// What listings in tangent space read at the four fragments of a quad: varyings of their vertex
// programs over bent triangles, objects turned, scaled and mirrored, frames askew, maps with mip
// levels, and displaced coordinates that jump from fragment to fragment. A Float is the quad.
#pragma once

#include "quadrel/raster/interpolation.hpp"
#include "relief/surface_rays.hpp"

namespace quadrel::test::tangent {

using Float = Quad<float>;
using Vec2 = vec2<Float>;
using Vec3 = vec3<Float>;
using Vec4 = vec4<Float>;
/// A vertex, a uniform: the same for all four.
using One3 = vec3<float>;

inline Float lanes(Batch<float>& batch, Value v, int quad, int component = 0) {
    return load<Float>(&batch.real(v, 4 * quad, component));
}
inline Vec2 lanes2(Batch<float>& batch, Value v, int quad) {
    return {lanes(batch, v, quad, 0), lanes(batch, v, quad, 1)};
}
inline Vec3 lanes3(Batch<float>& batch, Value v, int quad) {
    return {lanes(batch, v, quad, 0), lanes(batch, v, quad, 1), lanes(batch, v, quad, 2)};
}
inline One3 three(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
inline Vec3 all(const One3& v) { return {Float(v.x), Float(v.y), Float(v.z)}; }

/// Rows of an affine map with a point (w = 1) or a vector (w = 0): DP4 each.
inline One3 affine(const float (&rows)[12], const One3& v, float w) {
    const auto DP4 = [&](int row) {
        const float* m = rows + 4 * row;
        return m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3] * w;
    };
    return {DP4(0), DP4(1), DP4(2)};
}

/// What `program(row, vertex)` gives, interpolated.
template <class Program>
Vec3 varying(const Batch<float>& batch, int quad, const Program& program) {
    const auto first = static_cast<std::size_t>(4 * quad);
    const auto primitive = static_cast<std::size_t>(batch.primitive[first]);
    const auto& w = batch.primitives[primitive].w;
    const auto edge = [&](std::size_t i) { return load_wide<Float>(&batch.edges[i][first]); };
    const auto b =
        perspective_barycentrics(EdgeValues<Float>{edge(0), edge(1), edge(2)},
                                 PerVertex<Float>{Float(w[0]), Float(w[1]), Float(w[2])});
    const PrimitiveVertices& row = batch.vertices[primitive];
    return interpolate(
        b, PerVertex<Vec3>{all(program(row, 0)), all(program(row, 1)), all(program(row, 2))});
}

/// Turned, scaled and half of the time mirrored, and its inverse.
inline void random_object(Random& random, PrimitiveVertices& row) {
    const dvec3 x = random_direction(random);
    const dvec3 y = normalize(cross(x, random_direction(random)));
    const dvec3 axes[3] = {x, y, cross(x, y) * (random.chance(0.5) ? 1.0 : -1.0)};
    const dvec3 moved(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    for (int i = 0; i < 3; ++i) {
        const double scale = random.uniform(0.5, 2);
        for (int c = 0; c < 3; ++c) {
            row.to_eye[4 * c + i] = static_cast<float>(axes[i][c] * scale);
            row.to_object[4 * i + c] = static_cast<float>(axes[i][c] / scale);
        }
        row.to_object[4 * i + 3] = static_cast<float>(-dot(axes[i], moved) / scale);
        row.to_eye[4 * i + 3] = static_cast<float>(moved[i]);
    }
}

/// Moves the vertices apart and their axes away from each other's, further than a mesh would.
inline void bend(PrimitiveVertices& row, Random& random) {
    for (float(*attribute)[3] : {row.position, row.tangent, row.binormal, row.normal})
        for (int v = 0; v < 3; ++v)
            for (int c = 0; c < 3; ++c)
                attribute[v][c] += static_cast<float>(random.uniform(-0.5, 0.5));
}

/// A frame that is neither unit nor perpendicular, nor the same in two lanes.
inline void skew_frame(Batch<float>& batch, int lane, Random& random) {
    for (const Value v : {Value::T, Value::B, Value::frame_normal})
        batch.set(v, lane,
                  dvec3(batch.vector3(v, lane)) * random.uniform(0.8, 1.2) +
                      random_direction(random) * 0.2);
}

/// 64 x 64 texels of `channels`, smooth enough that levels look alike and differ by more than
/// rounding; trilinear.
inline Map mip_map(Random& random, int channels) {
    SamplerState s;
    s.wrap_u = s.wrap_v = Wrap::repeat;
    s.mip = MipFilter::linear;
    std::vector<float> coarse;
    for (int i = 0; i < 64 * channels; ++i)
        coarse.push_back(static_cast<float>(random.uniform(0.1, 0.9)));
    return make_map(
        64, 64, channels,
        [&](int x, int y, int c) {
            const float fine = static_cast<float>((x + 2 * y) % 5) * 0.05f - 0.1f;
            return coarse[static_cast<std::size_t>((y / 8 * 8 + x / 8) * channels + c)] + fine;
        },
        s);
}

struct Inputs {
    Batch<float> batch;
    Map color, normal, height;

    explicit Inputs(int seed) : batch(64) {
        Random random(static_cast<std::uint64_t>(seed) * 13 + 5);
        random_material(random, batch.material);
        fill_surface(batch, random, {0.2, 0.1, 1, 0.0005, 0.05, true});
        bend_vertices(batch, random);
        for (PrimitiveVertices& row : batch.vertices) {
            bend(row, random);
            random_object(random, row);
        }
        batch.frame.light_count = 2;
        for (LightUniforms& light : batch.frame.lights) random_light(random, light);
        for (int lane = 0; lane < batch.lanes; ++lane) fill_lane(lane, random);
        color = mip_map(random, 4);
        normal = mip_map(random, 4);
        height = make_map(
            64, 64, 1,
            [&](int x, int y, int) { return normal.sampled.view.texels[4 * (64 * y + x) + 3]; },
            normal.sampled.sampler);
        batch.bind(TextureSlot::color, color.sampled);
        batch.bind(TextureSlot::normal, normal.sampled);
        batch.bind(TextureSlot::height, height.sampled);
    }
    Inputs(const Inputs&) = delete;

  private:
    void fill_lane(int lane, Random& random) {
        skew_frame(batch, lane, random);
        const dvec2 jump(random.uniform(-0.04, 0.04), random.uniform(-0.04, 0.04));
        batch.set(Value::hit_uv, lane,
                  dvec2(batch.vector2(Value::uv, lane)) + (random.chance(0.5) ? jump : dvec2(0)));
        batch.set(Value::hit_P, lane,
                  dvec3(batch.vector3(Value::P, lane)) * random.uniform(1, 1.3));
        batch.real(Value::hit_h, lane) = 0;
        batch.integer(Value::hit_steps, lane) = 1;
        batch.real(Value::occlusion, lane) = 1;
        for (int light = 0; light < 2; ++light)
            batch.real(Value::shadow_visibility, lane, 0, light) = random.chance(0.5) ? 1.0f : 0.0f;
    }
};

/// Errors planted in what a listing is given.
struct Flaws {
    bool light_of_the_displaced_point = false;
    bool light_of_the_fragment = false;  ///< made of its interpolated axes, not at the vertices
    bool undisplaced_gradients = false;
};

/// A vertex program's vector along tangent, binormal and normal of the vertices. `vector(row, v)`.
template <class Vector>
Vec3 in_tangent_space(Batch<float>& batch, int quad, const Flaws& flaws, const Vector& vector) {
    const auto axis = [&](const auto member) {
        return varying(batch, quad,
                       [&](const auto& row, int v) { return three((row.*member)[v]); });
    };
    if (flaws.light_of_the_fragment) {
        const Vec3 to = varying(batch, quad, vector);
        return {dot(to, axis(&PrimitiveVertices::tangent)),
                dot(to, axis(&PrimitiveVertices::binormal)),
                dot(to, axis(&PrimitiveVertices::normal))};
    }
    return varying(batch, quad, [&](const PrimitiveVertices& row, int v) {
        const One3 light0vec = vector(row, v);
        // DP3 result.texcoord[1].x, light0vec, tangent;
        // DP3 result.texcoord[1].y, light0vec, binormal;
        // DP3 result.texcoord[1].z, light0vec, normal;
        return One3(dot(light0vec, three(row.tangent[v])), dot(light0vec, three(row.binormal[v])),
                    dot(light0vec, three(row.normal[v])));
    });
}

/// How far the displaced point of a quad's first lane is from the surface, in object space.
inline One3 displacement(Batch<float>& batch, int quad, const PrimitiveVertices& row) {
    const int lane = 4 * quad;
    return affine(row.to_object, batch.vector3(Value::hit_P, lane) - batch.vector3(Value::P, lane),
                  0);
}

/// tsL before it is normalised, y against growing v.
inline Vec3 mcguire_light(Batch<float>& batch, int quad, const Flaws& flaws) {
    const LightUniforms& light = batch.frame.lights[0];
    const Vec3 along = in_tangent_space(batch, quad, flaws, [&](const auto& row, int v) {
        const float w = light.directional ? 0.0f : 1.0f;
        const One3 position = affine(row.to_object, three(light.position), w);
        One3 from = three(row.position[v]) * w;
        if (flaws.light_of_the_displaced_point) from += displacement(batch, quad, row);
        return position - from;
    });
    return {along.x, -along.y, along.z};
}

/// Lanes in which a component of `found` is off by more than `tolerance` (1 + |expected|).
inline int lanes_off(Batch<float>& batch, Value found, int quad, const Vec3& expected,
                     float tolerance) {
    int off = 0;
    for (int i = 0; i < 4; ++i) {
        bool good = true;
        for (int c = 0; c < 3; ++c) {
            const float a = batch.real(found, 4 * quad + i, c), b = expected[c].lane[i];
            good &= std::abs(a - b) <= tolerance * (1 + std::abs(b));
        }
        off += !good;
    }
    return off;
}

}  // namespace quadrel::test::tangent
