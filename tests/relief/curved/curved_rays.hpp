// Rays that come down on curved surfaces: where they are over a sphere, exactly.
#pragma once

#include "quadrel/num/inverse_trig.hpp"
#include "quadrel/relief/rooms.hpp"
#include "relief/surface_rays.hpp"

namespace quadrel::test {

/// How fragments lie on spheres.
struct SphereOptions {
    double least_r = 0.05, most_r = 1;  ///< cosine of the angle of view
    double depth = 0.1;                 ///< of the relief, in radii
    double density = 1;                 ///< UV a world unit along the surface
    bool hollow = false;                ///< seen from inside
};

/// The spheres of the quads of a batch, radius 1 in world units of each.
struct Spheres {
    std::vector<dvec3> centre;
    SphereOptions options;

    /// Quads in tangent planes, a ten-thousandth of a radius wide: P, uv and J of the plane;
    /// normals, not of unit length, of the sphere; quadrics of its curvature.
    template <PlainFloat T>
    Spheres(Batch<T>& batch, Random& random, const SphereOptions& given) : options(given) {
        batch.material.depth = static_cast<float>(options.depth);
        const double side = options.hollow ? -1 : 1;
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            ViewedPlane plane(random, options.least_r);
            while (plane.r > options.most_r) plane = ViewedPlane(random, options.least_r);
            centre.push_back(plane.P - plane.N * side);
            const dvec2 uv(random.uniform(-2, 2), random.uniform(-2, 2));
            for (int i = 0; i < 4; ++i) {
                const double x = 1e-4 * (i % 2), y = 1e-4 * (i / 2);
                set_lane(batch, 4 * quad + i, plane, plane.P + plane.T * x + plane.B * y,
                         uv + dvec2(x, y) * options.density);
            }
        }
    }

  private:
    template <PlainFloat T>
    void set_lane(Batch<T>& batch, int lane, const ViewedPlane& plane, const dvec3& P,
                  const dvec2& uv) const {
        const dvec3 V = normalize(-P), d = -V;
        const double side = options.hollow ? -1 : 1, r = dot(plane.N, V);
        batch.set(Value::P, lane, P);
        batch.set(Value::uv, lane, uv);
        batch.set(Value::Ng, lane, plane.N);
        batch.set(Value::frame_normal, lane, plane.N);
        batch.set(Value::vertex_normal, lane, (P - centre[std::size_t(lane / 4)]) * side * 0.7);
        batch.set(Value::T, lane, plane.T);
        batch.set(Value::B, lane, plane.B);
        for (int c = 0; c < 3; ++c) {
            batch.real(Value::J, lane, c) = static_cast<T>(plane.T[c] * options.density);
            batch.real(Value::J, lane, 3 + c) = static_cast<T>(plane.B[c] * options.density);
        }
        const dvec2 shift = dvec2(dot(plane.T, d), dot(plane.B, d)) * options.density;
        batch.real(Value::r, lane) = static_cast<T>(r);
        batch.set(Value::uv_rate, lane, shift / r);
        batch.set(Value::K, lane, shift * (options.depth / r));
        batch.set(Value::quadric, lane, dvec2(0.5 * side, 0.5 * side));
        batch.set(Value::dUVdx, lane, dvec2(1e-4 * options.density, 0));
        batch.set(Value::dUVdy, lane, dvec2(0, 1e-4 * options.density));
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
        batch.integer(Value::frame_flags, lane) = 0;
    }
};

/// A lane's ray and its sphere.
struct SphereRay {
    dvec3 P, d, N, centre;
    dvec2 uv, along;  ///< coordinates of the fragment; direction of the ray in texture space, unit
    double r, density, side;

    template <PlainFloat T>
    SphereRay(Batch<T>& batch, int lane, const Spheres& spheres)
        : P(batch.vector3(Value::P, lane)),
          d(normalize(P)),
          N(batch.vector3(Value::frame_normal, lane)),
          centre(spheres.centre[std::size_t(lane / 4)]),
          uv(batch.vector2(Value::uv, lane)),
          r(-dot(N, d)),
          density(spheres.options.density),
          side(spheres.options.hollow ? -1 : 1) {
        const dvec2 K(batch.vector2(Value::K, lane));
        along = K / length(K);
    }

    /// How far the ray is below the sphere at a distance t from the fragment.
    double depth_at(double t) const { return side * (1 - length(P + d * t - centre)); }
    /// The coordinates there: the arc along the sphere.
    dvec2 uv_at(double t) const {
        const dvec3 from = P - centre, to = P + d * t - centre;
        const double sine = length(cross(from, to)), cosine = dot(from, to);
        return uv + along * (atan2(sine, cosine) * density);
    }
    /// Where it is nearest to the centre, and farthest below a sphere seen from outside.
    double turning() const { return dot(centre - P, d); }
};

}  // namespace quadrel::test
