// Runs of the searches over curved surfaces, and of rows with an error planted in them.
#pragma once

#include "relief/curved/curved_rays.hpp"

namespace quadrel::test {

using CurvedChange = std::function<void(Batch<float>&)>;

struct CurvedRow {
    std::string id;
    CurvedChange before{}, after{};

    void run(Batch<float>& batch, const Parameters& parameters = {}) const {
        if (before) before(batch);
        batch.run(id, parameters);
        if (after) after(batch);
    }
};

inline const char* const curved_rows[] = {"curved-quadric", "prism-free"};

inline void each(Batch<float>& batch, const std::function<void(int)>& change) {
    for (int lane = 0; lane < batch.lanes; ++lane) change(lane);
}

inline constexpr SphereOptions grazing{.least_r = 0.05, .most_r = 0.6};

/// Rays over spheres whose relief is of one height.
struct SphereRays {
    Map map;
    Batch<float> batch{64};
    Spheres spheres;
    double floor;  ///< world depth of the relief's surface below its top

    SphereRays(float height, const SphereOptions& options, Random random)
        : map(flat_map(height)),
          spheres(batch, random, options),
          floor((1 - double(height)) * options.depth) {
        batch.bind(TextureSlot::height, map.sampled);
        batch.material.seat = 1;
    }
    SphereRays(const SphereRays&) = delete;

    /// Distance from the fragment to what the row has found.
    double distance(int lane) {
        return double(batch.real(Value::hit_depth, lane)) / double(batch.real(Value::r, lane));
    }
    Status status(int lane) { return static_cast<Status>(batch.integer(Value::hit_status, lane)); }
};

}  // namespace quadrel::test
