// The rays of relaxed cones, as GPU Gems 3, listing 18-1 follows them: in float32, by point
// samples.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "bake/height_plane.hpp"

namespace quadrel {

class RelaxedRays {
  public:
    /// `steps`: samples below a texel.
    RelaxedRays(const HeightPlane& plane, int steps) : plane_(plane), steps_(steps) {
        depths_.reserve(plane.heights.size());
        for (const float height : plane.heights) depths_.push_back(depth_of(height));
    }

    /// By stored indices, in [0, 1].
    float depth(int x, int y) const {
        return depths_[static_cast<std::size_t>(y) * plane_.grid.u.count + x];
    }

    /// The ratio that the texel at an offset gives the cone of stored texel (i, j), or any that is
    /// not below `best`. `samples`: after so many the ray is known not to come out any more.
    float ratio(int i, int j, int di, int dj, float best, int samples) const {
        const auto [width, height] = std::pair(float(plane_.width), float(plane_.height));
        const float u = (float(i + plane_.grid.u.first) + 0.5f) / width;
        const float v = (float(j + plane_.grid.v.first) + 0.5f) / height;
        const float to_u = u + float(di) / width, to_v = v + float(dj) / height;
        const float z = depth_at(to_u, to_v), apex_depth = depth(i, j);
        const Point exit = z == 0 ? Point{to_u, to_v, z}
                                  : leave({to_u, to_v, z}, {to_u - u, to_v - v, z},
                                          {u, v, apex_depth}, best, samples);
        if (exit.z >= apex_depth) return 1;
        const float x = exit.u - u, y = exit.v - v;
        return std::sqrt(x * x + y * y) / (apex_depth - exit.z);
    }

  private:
    struct Point {
        float u, v, z;
    };

    static float depth_of(float height) { return 1.0f - std::clamp(height, 0.0f, 1.0f); }

    /// Index along one axis of the stored plane, |x| < 4 or so, as is_wider() sees to. Most of a
    /// bake is spent here: whole numbers by truncation and remainder, which floor() and
    /// stored_index() agree with.
    static int stored(float x, int texels, const GridAxis& axis) {
        const double at = static_cast<double>(x) * texels;
        int i = static_cast<int>(at);
        if (i > at) --i;
        i -= axis.first;
        if (i >= 0 && i < axis.count) return i;
        if (!axis.periodic) return i < 0 ? 0 : axis.count - 1;
        i %= axis.count;
        return i < 0 ? i + axis.count : i;
    }
    float depth_at(float u, float v) const {
        return depth(stored(u, plane_.width, plane_.grid.u),
                     stored(v, plane_.height, plane_.grid.v));
    }

    /// Whether the ratio at a point of the ray is not below `best`. It only grows along the ray:
    /// each of its operations is monotonic, rounding included. The slack is what these roundings
    /// are of those of ratio().
    static bool is_wider(const Point& at, const Point& apex, float best) {
        const float x = at.u - apex.u, y = at.v - apex.v;
        const float radius = best * (apex.z - at.z);
        return radius <= 0 || x * x + y * y > radius * radius * 1.0001f;
    }

    /// Where the ray that comes along `to` is outside again below texel q, by samples; or where it
    /// cannot matter any more.
    Point leave(const Point& q, const Point& to, const Point& apex, float best, int samples) const {
        const float rest = 1.0f - q.z, count = static_cast<float>(steps_);
        const auto step_of = [&](float component) { return component / to.z * rest / count; };
        const Point step{step_of(to.u), step_of(to.v), step_of(to.z)};
        Point at{q.u + step.u, q.v + step.v, q.z + step.z};
        for (int i = 1; i < steps_; ++i) {
            if (is_wider(at, apex, best)) break;
            if (i > samples) return {at.u, at.v, 1};
            if (!(depth_at(at.u, at.v) <= at.z)) break;  // and stays there for the other turns
            at = {at.u + step.u, at.v + step.v, at.z + step.z};
        }
        return at;
    }

    const HeightPlane& plane_;
    int steps_;
    std::vector<float> depths_;  ///< as plane_.heights
};

}  // namespace quadrel
