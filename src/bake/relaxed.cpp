// Relaxed cone maps: the widest cones in which a ray from above pierces the field at most once.
//
// relaxed-cone. Source: Policarpo, Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems
// 3, chapter 18, the preprocess of listing 18-1: for every texel q a ray from above the apex p
// through q goes on below q in 128 point samples until it is outside again. In float32, as the
// listing. Differs in leaving out texels that cannot narrow the cone further (the result is the
// same), and where q is as high as can be (depth 0): the listing divides by 0 there, here q itself
// counts.
#include "bake/cone.hpp"
#include "bake/generators.hpp"

namespace quadrel {

namespace {

struct DepthPoint {
    float u, v, z;
};

class RelaxedSearch {
  public:
    explicit RelaxedSearch(const BakeJob& job)
        : plane_(job.plane),
          metric_(plane_.width, plane_.height),
          top_(highest(plane_)),
          steps_(job.whole("steps")) {
        depths_.reserve(plane_.heights.size());
        for (const float height : plane_.heights) depths_.push_back(depth_of(height));
    }

    float operator()(const Apex& apex) const {
        float best = 1;
        if (top_ <= apex.height) return best;
        search_rings(
            apex.u, apex.v,
            [&](int r) { return hopeless(metric_.ring(r), top_ - apex.height, best); },
            [&](int di, int dj) {
                const double rise = plane_.at(apex.u.at(di), apex.v.at(dj)) - apex.height;
                // The exit lies further out and deeper than q.
                if (!(rise > 0) || hopeless(metric_(di, dj), rise, best)) return;
                const float ratio = listed_ratio(apex, di, dj, best);
                if (!(ratio > best)) best = ratio;
            });
        return best;
    }

  private:
    /// Whether a point can not give less than `best`, float32 rounding included.
    static bool hopeless(double distance, double rise, float best) {
        return distance > rise * best * 1.0001;
    }

    /// A depth map holds [0, 1].
    static float depth_of(double height) {
        return 1.0f - std::clamp(static_cast<float>(height), 0.0f, 1.0f);
    }
    /// Index along one axis of the stored plane. Most of a bake is spent here: whole numbers by
    /// truncation and remainder, which floor() and stored_index() agree with.
    static int stored(float x, int texels, const GridAxis& axis) {
        // Rays that are nearly level run far; beyond this a float has no texels left.
        const double at = std::clamp(static_cast<double>(x) * texels, -1e9, 1e9);
        int i = static_cast<int>(at);
        if (i > at) --i;
        i -= axis.first;
        if (i >= 0 && i < axis.count) return i;
        if (!axis.periodic) return i < 0 ? 0 : axis.count - 1;
        i %= axis.count;
        return i < 0 ? i + axis.count : i;
    }
    float depth_at(float u, float v) const {
        const int i = stored(u, plane_.width, plane_.grid.u);
        const int j = stored(v, plane_.height, plane_.grid.v);
        return depths_[static_cast<std::size_t>(j) * plane_.grid.u.count + i];
    }

    /// The ratio that texel q gives, or any that is not below `best`.
    float listed_ratio(const Apex& apex, int di, int dj, float best) const {
        const auto [width, height] = std::pair(float(plane_.width), float(plane_.height));
        const float u = (float(apex.i + plane_.grid.u.first) + 0.5f) / width;
        const float v = (float(apex.j + plane_.grid.v.first) + 0.5f) / height;
        const float to_u = u + float(di) / width, to_v = v + float(dj) / height;
        const float z = depth_at(to_u, to_v);
        const float apex_depth = depth_of(apex.height);
        const DepthPoint exit =
            z == 0 ? DepthPoint{to_u, to_v, z}
                   : leave({to_u, to_v, z}, {to_u - u, to_v - v, z}, {u, v, apex_depth}, best);
        if (exit.z >= apex_depth) return 1;
        const float x = exit.u - u, y = exit.v - v;
        return std::sqrt(x * x + y * y) / (apex_depth - exit.z);
    }

    /// Whether the ratio at a point of the ray is not below `best`. It only grows along the ray:
    /// each of its operations is monotonic, rounding included. The slack is what these roundings
    /// are of those of listed_ratio.
    static bool is_wider(const DepthPoint& at, const DepthPoint& apex, float best) {
        const float x = at.u - apex.u, y = at.v - apex.v;
        const float radius = best * (apex.z - at.z);
        return radius <= 0 || x * x + y * y > radius * radius * 1.0001f;
    }

    /// Where the ray that comes along `to` is outside again below texel q, by samples; or where it
    /// cannot matter any more.
    DepthPoint leave(const DepthPoint& q, const DepthPoint& to, const DepthPoint& apex,
                     float best) const {
        const float rest = 1.0f - q.z, count = static_cast<float>(steps_);
        const auto step_of = [&](float component) { return component / to.z * rest / count; };
        const DepthPoint step{step_of(to.u), step_of(to.v), step_of(to.z)};
        DepthPoint at{q.u + step.u, q.v + step.v, q.z + step.z};
        for (int i = 1; i < steps_; ++i) {
            if (is_wider(at, apex, best)) break;
            if (!(depth_at(at.u, at.v) <= at.z)) break;  // and stays there for the other turns
            at = {at.u + step.u, at.v + step.v, at.z + step.z};
        }
        return at;
    }

    const HeightPlane& plane_;
    TileMetric metric_;
    double top_;
    int steps_;
    std::vector<float> depths_;  ///< as plane_.heights
};

}  // namespace

std::shared_ptr<Texture> bake_relaxed_cone(const BakeJob& job) {
    return make_cone_map(job, 1, Images::all, RelaxedSearch(job));
}

}  // namespace quadrel
