// What the properties of offsets and marches are written with: a row with an error behind it,
// checks over all rows of a kind, and rays whose one crossing is known.
#pragma once

#include "quadrel/bake/bake.hpp"
#include "relief/trace/trace_rows.hpp"

namespace quadrel::test {

template <class T>
using Trace = StageUnderTest<T>;

/// Runs a trace with the maps that it reads besides the heights, baked of the batch's.
template <class T>
void run_baked(const Trace<T>& trace, Batch<T>& batch, const Parameters& parameters) {
    const SampledTexture& heights = *batch.bound(TextureSlot::height);
    const TextureView& view = heights.view;
    const Map height = height_map(view.width[0], view.height[0], [&](int x, int y) {
        return view.texels[view.offset[0] + (y * view.width[0] + x) * view.channels];
    });
    std::map<TextureSlot, Map> baked;
    for (const TextureSlot slot : find_stage(trace.id)->textures) {
        if (batch.bound(slot) || slot < TextureSlot::max_mip) continue;
        Map& map = baked[slot];
        map.texture = bake(*height.texture, bake_kind_from_name(slot_name(slot)), heights.sampler);
        map.sampled = {map.texture->view(), heights.sampler};
        batch.bind(slot, map.sampled);
    }
    trace.run(batch, parameters);
    for (const auto& [slot, map] : baked) batch.unbind(slot);
}

template <class T>
Status status_of(Batch<T>& batch, int lane) {
    return static_cast<Status>(batch.integer(Value::hit_status, lane));
}

/// Moves every lane's result by ds along its ray.
template <class T>
void move_hit(Batch<T>& batch, double ds) {
    for (int lane = 0; lane < batch.lanes; ++lane) {
        T& s = batch.real(Value::hit_s, lane);
        s += static_cast<T>(ds);
        const T along = s - (T(1) - T(batch.material.seat));
        batch.set(Value::hit_uv, lane,
                  batch.vector2(Value::uv, lane) + batch.vector2(Value::K, lane) * along);
        batch.real(Value::hit_depth, lane) = along * batch.real(Value::relief_depth, lane);
    }
}

/// The row with an error behind it.
template <class T>
Trace<T> flawed(const TraceRow& row, Planted planted) {
    const double step = 1.0 / std::max(row.lattice, 1);
    return {row.id, {}, [planted, step](Batch<T>& b) {
                if (planted == Planted::one_sample_late) move_hit(b, step);
                if (planted == Planted::one_sample_early) move_hit(b, -step);
                if (planted == Planted::half_a_step_late) move_hit(b, step / 2);
                if (planted == Planted::surface_not_reached) move_hit(b, -0.2);
                if (planted == Planted::off_the_ray) b.real(Value::hit_uv, 3, 1) += T(1e-5);
                if (planted == Planted::fetch_not_counted) b.integer(Value::hit_fetches, 5) -= 1;
                if (planted == Planted::hit_at_nan)
                    for (int lane = 0; lane < b.lanes; ++lane)
                        b.real(Value::hit_s, lane) = std::numeric_limits<T>::quiet_NaN();
                if (planted == Planted::nan_is_floor) {
                    b.integer(Value::hit_status, 7) = static_cast<int>(Status::floor);
                }
            }};
}

/// A property: how an implementation of a row fails it, or success.
template <class T>
using Property = testing::AssertionResult (*)(const TraceRow&, const Trace<T>&);

template <class T>
void holds_for_all(Property<T> property, std::initializer_list<TraceKind> kinds) {
    for (const TraceRow& row : trace_rows()) {
        if (std::find(kinds.begin(), kinds.end(), row.kind) == kinds.end()) continue;
        EXPECT_TRUE(property(row, {row.id})) << name_of(row);
    }
}
/// Of all those rows.
template <class T>
void notices(Property<T> property, Planted planted, std::initializer_list<TraceKind> kinds) {
    for (const TraceRow& row : trace_rows()) {
        if (std::find(kinds.begin(), kinds.end(), row.kind) == kinds.end()) continue;
        EXPECT_FALSE(property(row, flawed<T>(row, planted)))
            << name_of(row) << ", " << static_cast<int>(planted);
    }
}

// ---- Rays that cross once
// ------------------------------------------------------------------------

/// Of all rays of |K| < 1.4: slopes of 0.7 at most, curved by the wave's corners.
inline Map gentle_map() {
    return height_map(32, 32, [](int x, int y) {
        return static_cast<float>(std::abs(x - 16) + std::abs(y - 16)) / 64 + 0.25f;
    });
}

inline constexpr int brute_steps = 20000;

/// s of the first of 20001 samples at or below the surface, in double.
template <class T>
std::vector<double> brute_hits(Batch<T>& rays) {
    Batch<double> batch(rays.lanes);
    for (int lane = 0; lane < rays.lanes; ++lane) {
        for (const Value v : {Value::uv, Value::K, Value::dUVdx, Value::dUVdy}) {
            batch.set(v, lane, rays.vector2(v, lane));
        }
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
        batch.integer(Value::frame_flags, lane) = 0;
    }
    batch.material = rays.material;
    batch.bind(TextureSlot::height, *rays.bound(TextureSlot::height));
    batch.run("linear", {{"steps", brute_steps}});
    std::vector<double> hits;
    for (int lane = 0; lane < rays.lanes; ++lane) hits.push_back(batch.real(Value::hit_s, lane));
    return hits;
}

/// Rays over the gentle map, and where they cross it.
template <class T>
struct GentleInputs {
    Map map = gentle_map();
    Batch<T> batch{64};
    std::vector<double> hits;

    GentleInputs() {
        Random random(6);
        fill_surface(batch, random, {0.3});
        batch.bind(TextureSlot::height, map.sampled);
        hits = brute_hits(batch);
    }
};

}  // namespace quadrel::test
