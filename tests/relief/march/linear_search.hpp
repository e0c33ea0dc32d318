// Rays without geometry, and the linear search once more as a loop over plain numbers: what the
// stage has to equal, and, with an error planted, what the properties have to catch.
#pragma once

#include "relief/facet.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {

using Search = StageUnderTest<float>;

/// Rays without geometry: uv in [-2, 2], K in [-0.6, 0.6], a footprint of `footprint`.
inline void fill_rays(Batch<float>& batch, Random& random, double footprint = 0.001) {
    for (int lane = 0; lane < batch.lanes; ++lane) {
        for (int c = 0; c < 2; ++c) {
            batch.real(Value::uv, lane, c) = static_cast<float>(random.uniform(-2, 2));
            batch.real(Value::K, lane, c) = static_cast<float>(random.uniform(-0.6, 0.6));
        }
        batch.set(Value::dUVdx, lane, dvec2(footprint, 0));
        batch.set(Value::dUVdy, lane, dvec2(0, footprint));
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
        batch.integer(Value::frame_flags, lane) = 0;
    }
    batch.material.depth = 0.25f;
}

// ---- The same search over plain floats ----------------------------------------------------------

struct Found {
    float s = 1, h = 0;
    int steps = 0;
    bool found = false, met_nan = false;
};

inline Found search(const GeneralHeight<Fetch>& height, vec2<float> uv, vec2<float> K,
                    float polygon, int n, bool strict) {
    Found result;
    for (int k = 0; k <= n && !result.found; ++k) {
        const float s = static_cast<float>(k) / static_cast<float>(n), along = s - polygon;
        const vec2<Fetch> at(Fetch(uv.x + K.x * along), Fetch(uv.y + K.y * along));
        result.h = height({}, at).lane[0];
        result.steps = k + 1;
        result.met_nan |= result.h != result.h;
        result.found = strict ? result.h > 1 - s : result.h >= 1 - s;
        if (result.found) result.s = s;
    }
    return result;
}

inline Status status_of(const Found& found, Planted planted) {
    if (found.met_nan && planted != Planted::nan_is_floor) return Status::nan;
    return found.found ? Status::hit : Status::floor;
}

inline void search_lane(Batch<float>& batch, int lane, int n, Planted planted) {
    const bool seated = planted != Planted::seat_forgotten;
    const float polygon = seated ? 1 - batch.material.seat : 0.0f;
    const vec2<float> uv = batch.vector2(Value::uv, lane), K = batch.vector2(Value::K, lane);
    const auto gradient = [&](Value v) {
        return vec2<Fetch>(Fetch(batch.real(v, lane, 0)), Fetch(batch.real(v, lane, 1)));
    };
    const GeneralHeight<Fetch> height(*batch.bound(TextureSlot::height), gradient(Value::dUVdx),
                                      gradient(Value::dUVdy));
    Found found = search(height, uv, K, polygon, n, planted == Planted::strict_comparison);
    const float step = 1 / static_cast<float>(n);
    if (found.found && planted == Planted::one_sample_late) found.s += step;
    if (found.found && planted == Planted::one_sample_early) found.s -= step;
    if (planted == Planted::steps_counted_once) found.steps = n + 1;
    const float along = found.s - polygon;
    batch.set(Value::hit_uv, lane, vec2<float>(uv.x + K.x * along, uv.y + K.y * along));
    batch.real(Value::hit_s, lane) = found.s;
    batch.real(Value::hit_h, lane) = found.h;
    batch.real(Value::hit_depth, lane) = along * batch.material.depth;
    batch.integer(Value::hit_status, lane) = static_cast<int>(status_of(found, planted));
    const bool below = found.found && found.s == 0 && found.h > 1;
    batch.integer(Value::hit_flags, lane) =
        batch.integer(Value::frame_flags, lane) | (below ? HitFlag::start_below : 0);
    batch.integer(Value::hit_steps, lane) = found.steps;
    batch.integer(Value::hit_fetches, lane) = found.steps;
}

/// The stage, or that loop with an error.
inline Search linear(Planted planted = Planted::none) {
    if (planted == Planted::none) return {"linear"};
    return {"linear", {}, {}, [planted](Batch<float>& batch, const Parameters& parameters) {
                const auto steps = parameters.find("steps");
                const int n = steps == parameters.end() ? 128 : static_cast<int>(steps->second);
                for (int lane = 0; lane < batch.lanes; ++lane) {
                    search_lane(batch, lane, n, planted);
                }
            }};
}

inline constexpr auto hit_values =
    values(Value::hit_uv, Value::hit_s, Value::hit_h, Value::hit_depth, Value::hit_status,
           Value::hit_flags, Value::hit_steps, Value::hit_fetches);

}  // namespace quadrel::test
