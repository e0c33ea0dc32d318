// Lanes on one plane with the frame of that plane, as the stages behind the search see them: no
// search, no neighbours.
#pragma once

#include "quadrel/texture/height_sampler.hpp"
#include "relief/frame/frame_oracle.hpp"

namespace quadrel::test {

/// Every lane at the plane's origin with its exact J, `N` as the frame's normal, and a small
/// footprint; hit_uv random in the middle half of the map.
inline Batch<float> facet_batch(const Plane& plane, const dvec3& N, float depth, Random& random,
                                int lanes = 64) {
    Batch<float> batch(lanes);
    batch.material.depth = depth;
    const auto J = ExactJacobian::from_edges(plane.dPdu, plane.dPdv, dvec2(1, 0), dvec2(0, 1));
    for (int lane = 0; lane < lanes; ++lane) {
        batch.set(Value::P, lane, plane.origin);
        batch.set(Value::hit_P, lane, plane.origin);
        batch.set(Value::Ng, lane, plane.normal);
        batch.set(Value::frame_normal, lane, N);
        for (int c = 0; c < 3; ++c) {
            batch.real(Value::J, lane, c) = static_cast<float>(J.grad_u[c]);
            batch.real(Value::J, lane, 3 + c) = static_cast<float>(J.grad_v[c]);
        }
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
        batch.set(Value::dUVdx, lane, dvec2(0.001, 0));
        batch.set(Value::dUVdy, lane, dvec2(0, 0.001));
        batch.set(Value::hit_uv, lane,
                  dvec2(random.uniform(0.25, 0.75), random.uniform(0.25, 0.75)));
        batch.set(Value::uv, lane, batch.vector2(Value::hit_uv, lane));
    }
    return batch;
}

/// A unit vector that leans from the plane's normal by up to `lean`.
inline dvec3 leaning(const Plane& plane, Random& random, double lean) {
    return normalize(plane.normal + random_direction(random) * lean);
}

/// A fetch for a single lane, in all four.
using Fetch = Quad<float>;

/// The height at uv with the gradients of a lane of the batch.
inline float height_at(Batch<float>& batch, int lane, const vec2<float>& uv) {
    const auto spread = [](const vec2<float>& v) { return vec2<Fetch>(Fetch(v.x), Fetch(v.y)); };
    const GeneralHeight<Fetch> height(*batch.bound(TextureSlot::height),
                                      spread(batch.vector2(Value::dUVdx, lane)),
                                      spread(batch.vector2(Value::dUVdy, lane)));
    return height({}, spread(uv)).lane[0];
}

}  // namespace quadrel::test
