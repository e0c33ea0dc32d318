// Rays over planes with an isotropic UV map, with everything that a trace may load: what offsets
// and listings in tangent space need beyond fill_rays.
#pragma once

#include "relief/march/linear_search.hpp"
#include "relief/vertex_inputs.hpp"

namespace quadrel::test {

/// How the rays of a batch are made.
struct RayOptions {
    double least_r = 0.1;  ///< smallest cosine of the angle of view
    double depth = 0.25;   ///< world units
    double density = 1;    ///< UV a world unit
    double least_footprint = 0.001, most_footprint = 0.001;  ///< UV a pixel
    bool back_faces = false;  ///< half of the triangles seen from behind
};

/// A plane in front of the eye at the origin, and its tangents.
struct ViewedPlane {
    dvec3 P, N, T, B;
    double r;

    ViewedPlane(Random& random, double least_r) {
        const double z = random.uniform(1, 5);
        P = {random.uniform(-0.6, 0.6) * z, random.uniform(-0.6, 0.6) * z, -z};
        const dvec3 V = normalize(-P);
        do {
            N = random_direction(random);
            r = dot(N, V);
        } while (r < least_r);
        T = normalize(cross(N, random_direction(random)));
        B = cross(N, T) * (random.chance(0.5) ? 1.0 : -1.0);
    }
};

/// The quad's four fragments on one plane: P, N, T, B, J, r, K in agreement, uv close together.
template <PlainFloat T>
void fill_surface_quad(Batch<T>& batch, int quad, Random& random, const RayOptions& options) {
    const ViewedPlane plane(random, options.least_r);
    const dvec2 uv(random.uniform(-2, 2), random.uniform(-2, 2));
    const double footprint = random.uniform(options.least_footprint, options.most_footprint);
    const dvec3 d = normalize(plane.P);
    const dvec2 shift = dvec2(dot(plane.T, d), dot(plane.B, d)) * options.density;
    const bool behind = options.back_faces && random.chance(0.5);
    set_quad_vertices(batch, quad, plane.P, VertexAxes{plane.T, plane.B, plane.N});
    for (int i = 0; i < 4; ++i) {
        const int lane = 4 * quad + i;
        batch.set(Value::uv, lane, vec2<float>(uv + dvec2(i % 2, i / 2) * footprint));
        batch.set(Value::P, lane, vec3<float>(plane.P));
        batch.set(Value::Ng, lane, vec3<float>(behind ? -plane.N : plane.N));
        batch.set(Value::T, lane, vec3<float>(plane.T));
        batch.set(Value::B, lane, vec3<float>(plane.B));
        batch.set(Value::frame_normal, lane, vec3<float>(plane.N));
        for (int c = 0; c < 3; ++c) {
            batch.real(Value::J, lane, c) = static_cast<float>(plane.T[c] * options.density);
            batch.real(Value::J, lane, 3 + c) = static_cast<float>(plane.B[c] * options.density);
        }
        batch.real(Value::r, lane) = static_cast<float>(plane.r);
        batch.set(Value::uv_rate, lane, vec2<float>(shift / plane.r));
        batch.set(Value::K, lane, vec2<float>(shift * (options.depth / plane.r)));
        batch.set(Value::vertex_normal, lane, vec3<float>(plane.N));
        batch.set(Value::dPdx, lane, vec3<float>(plane.T * (footprint / options.density)));
        batch.set(Value::dPdy, lane, vec3<float>(plane.B * (footprint / options.density)));
        batch.set(Value::dUVdx, lane, dvec2(footprint, 0));
        batch.set(Value::dUVdy, lane, dvec2(0, footprint));
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
        batch.integer(Value::frame_flags, lane) = 0;
    }
}

template <PlainFloat T>
void fill_surface(Batch<T>& batch, Random& random, const RayOptions& options = {}) {
    batch.material.depth = static_cast<float>(options.depth);
    for (int quad = 0; quad < batch.lanes / 4; ++quad) {
        fill_surface_quad(batch, quad, random, options);
    }
}

/// Straight down: K = 0 and r = 1 in every lane, the rest as it was.
template <PlainFloat T>
void look_straight_down(Batch<T>& batch) {
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.set(Value::K, lane, dvec2(0));
        batch.set(Value::uv_rate, lane, dvec2(0));
        batch.real(Value::r, lane) = 1;
        batch.set(Value::P, lane, -batch.vector3(Value::frame_normal, lane) * T(2));
    }
    for (int quad = 0; quad < batch.lanes / 4; ++quad) {
        const auto axis = [&](Value v) { return dvec3(batch.vector3(v, 4 * quad)); };
        const VertexAxes axes{axis(Value::T), axis(Value::B), axis(Value::frame_normal)};
        set_quad_vertices(batch, quad, axes.N * -2.0, axes);
    }
}

}  // namespace quadrel::test
