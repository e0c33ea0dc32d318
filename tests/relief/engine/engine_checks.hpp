// Checks of engines' searches where a listing over ordinary maps does not lead: wild and flat maps,
// and how a search says that it ended.
#pragma once

#include "relief/listing_runs.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {

/// The stage with an error behind it.
inline StageUnderTest<float> flawed_behind(const std::string& id, Planted planted) {
    const auto after = [planted](Batch<float>& b) {
        for (int lane = 0; lane < b.lanes; ++lane) {
            std::int32_t& status = b.integer(Value::hit_status, lane);
            if (planted == Planted::nan_is_floor && status == static_cast<int>(Status::nan))
                status = static_cast<int>(Status::floor);
            if (planted == Planted::surface_not_reached) status = static_cast<int>(Status::hit);
            if (planted == Planted::off_the_ray) b.real(Value::hit_uv, lane) += 0.002f;
            if (planted == Planted::fetch_not_counted) b.integer(Value::hit_fetches, lane) -= 1;
        }
    };
    return {id, {}, after};
}

/// Heights from far below the relief to above it, one texel in fifty NaN.
inline Map wild_map(Random& random) {
    return height_map(32, 32, [&](int, int) {
        return random.chance(0.02) ? std::numeric_limits<float>::quiet_NaN()
                                   : static_cast<float>(random.uniform(-2, 1.5));
    });
}

inline testing::AssertionResult follows_on_wild_maps(const Listing& listing,
                                                     const StageUnderTest<float>& stage) {
    for (int i = 0; i < 10; ++i) {
        Inputs inputs(i);
        const Map map = wild_map(inputs.random);
        Batch<float>& b = inputs.batch;
        b.bind(TextureSlot::height, map.sampled);
        stage.run(b, listing.parameters);
        for (int quad = 0; quad < b.lanes / 4; ++quad) {
            const std::array<End, 4> ends = listing.run(b, quad);
            for (int k = 0; k < 4; ++k) {
                const auto equal = lane_equals(listing, b, 4 * quad + k, ends[k]);
                if (!equal) return equal;
            }
        }
    }
    return testing::AssertionSuccess();
}

/// Over a flat map, one quad alone: some searches make all the steps that there are.
inline testing::AssertionResult ends_with(const StageUnderTest<float>& stage,
                                          const Parameters& parameters, float height,
                                          Status expected) {
    Inputs inputs(1);
    Batch<float>& b = inputs.batch;
    std::fill(b.active.begin() + 4, b.active.end(), 0);
    const Map map = flat_map(height);
    b.bind(TextureSlot::height, map.sampled);
    stage.run(b, parameters);
    for (int lane = 0; lane < 4; ++lane) {
        const int status = b.integer(Value::hit_status, lane);
        if (status != static_cast<int>(expected))
            return testing::AssertionFailure() << stage.id << ": status " << status;
    }
    return testing::AssertionSuccess();
}

/// What a search over a flat map of `height` should give a fragment: the coordinate's shift, and
/// by how much it may be off. V is the unit view vector in tangent space.
struct Shift {
    dvec2 expected;
    double error = 0;
};
using ShiftOf = std::function<Shift(const dvec3& V, double height)>;

/// Pixels a hundredth of a texel wide at most, so that searches that look at them see no reason to
/// blur.
inline testing::AssertionResult meets_flat_maps(const StageUnderTest<float>& stage,
                                                const Parameters& parameters,
                                                const ShiftOf& shift_of, int size = 4) {
    for (const float height : {0.03f, 0.5f, 0.93f}) {
        Random random(7);
        Batch<float> b(64);
        const double footprint = 0.01 / size;
        fill_surface(b, random, {0.1, 0.2, 1, footprint, footprint});
        const Map map = flat_map(height, size);
        b.bind(TextureSlot::height, map.sampled);
        stage.run(b, parameters);
        for (int lane = 0; lane < b.lanes; ++lane) {
            const Shift shift = shift_of(dvec3(tangent_view(b, lane)), height);
            const dvec2 uv(b.vector2(Value::uv, lane)), hit_uv(b.vector2(Value::hit_uv, lane));
            const double error = length(hit_uv - (uv + shift.expected));
            if (!(error <= shift.error + 1e-5))
                return testing::AssertionFailure()
                       << stage.id << ", height " << height << ", lane " << lane << ": off by "
                       << error << " of " << length(shift.expected);
        }
    }
    return testing::AssertionSuccess();
}

/// All lanes at `P`, with the frame of the axes.
inline void place_all_at(Batch<float>& b, const dvec3& P) {
    for (int lane = 0; lane < b.lanes; ++lane) {
        b.set(Value::T, lane, dvec3(1, 0, 0));
        b.set(Value::B, lane, dvec3(0, 1, 0));
        b.set(Value::frame_normal, lane, dvec3(0, 0, 1));
        b.set(Value::P, lane, P);
    }
}

/// Exactly along the normal.
inline testing::AssertionResult is_nan_seen_along_the_normal(const StageUnderTest<float>& stage,
                                                             const Parameters& parameters) {
    Inputs inputs(2);
    Batch<float>& b = inputs.batch;
    place_all_at(b, dvec3(0, 0, -2));
    stage.run(b, parameters);
    for (int lane = 0; lane < b.lanes; ++lane) {
        const Vec2 uv = b.vector2(Value::hit_uv, lane);
        if (uv.x == uv.x || b.integer(Value::hit_status, lane) != static_cast<int>(Status::nan))
            return testing::AssertionFailure() << "lane " << lane;
    }
    return testing::AssertionSuccess();
}

/// On the polygon, without a look-up.
inline testing::AssertionResult leaves_the_polygon_alone(const StageUnderTest<float>& stage,
                                                         const Parameters& parameters) {
    Inputs inputs(3);
    Batch<float>& b = inputs.batch;
    stage.run(b, parameters);
    for (int lane = 0; lane < b.lanes; ++lane) {
        const Vec2 uv = b.vector2(Value::uv, lane), hit_uv = b.vector2(Value::hit_uv, lane);
        const bool unmoved = same(uv.x, hit_uv.x) && same(uv.y, hit_uv.y) &&
                             b.real(Value::hit_depth, lane) == 0 &&
                             b.integer(Value::hit_fetches, lane) == 0 &&
                             b.integer(Value::hit_status, lane) == static_cast<int>(Status::hit);
        if (!unmoved) return testing::AssertionFailure() << stage.id << ", lane " << lane;
    }
    return testing::AssertionSuccess();
}

}  // namespace quadrel::test
