#include "embree/packets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrel::peers {
namespace {

template <int n>
struct Packet;
template <>
struct Packet<8> {
    using Ray = RTCRay8;
    using Hit = RTCRayHit8;
    static constexpr auto intersect = rtcIntersect8;
    static constexpr auto occluded = rtcOccluded8;
};
template <>
struct Packet<16> {
    using Ray = RTCRay16;
    using Hit = RTCRayHit16;
    static constexpr auto intersect = rtcIntersect16;
    static constexpr auto occluded = rtcOccluded16;
};

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Coherent packets of neighbouring pixels.
RTCIntersectContext coherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

template <int n>
void set_rest(typename Packet<n>::Ray& ray, float nearest, float farthest) {
    std::fill_n(ray.tnear, n, nearest);
    std::fill_n(ray.tfar, n, farthest);
    std::fill_n(ray.time, n, 0.0f);
    std::fill_n(ray.mask, n, ~0u);
    std::fill_n(ray.flags, n, 0u);
}

template <int n>
void trace_primary(RTCScene scene, const Rays& rays, std::size_t first, float depth,
                   typename Packet<n>::Hit& hit) {
    alignas(64) int valid[n];
    std::fill_n(valid, n, -1);
    std::copy_n(&rays.origin[0][first], n, hit.ray.org_x);
    std::copy_n(&rays.origin[1][first], n, hit.ray.org_y);
    std::copy_n(&rays.origin[2][first], n, hit.ray.org_z);
    std::copy_n(&rays.direction[0][first], n, hit.ray.dir_x);
    std::copy_n(&rays.direction[1][first], n, hit.ray.dir_y);
    std::copy_n(&rays.direction[2][first], n, hit.ray.dir_z);
    set_rest<n>(hit.ray, 0, depth);
    std::fill_n(hit.hit.geomID, n, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(hit.hit.instID[0], n, RTC_INVALID_GEOMETRY_ID);
    RTCIntersectContext context = coherent();
    Packet<n>::intersect(valid, scene, &context, &hit);
}

/// From the hits to the light, which lies at t = 1.
template <int n>
void trace_shadows(RTCScene scene, const Rays& rays, std::size_t first,
                   const typename Packet<n>::Hit& hit, std::uint8_t* lit) {
    alignas(64) int valid[n];
    typename Packet<n>::Ray ray;
    for (int i = 0; i < n; ++i) {
        const std::size_t at = first + static_cast<std::size_t>(i);
        valid[i] = hit.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? -1 : 0;
        const float t = hit.ray.tfar[i];
        ray.org_x[i] = hit.ray.org_x[i] + hit.ray.dir_x[i] * t;
        ray.org_y[i] = hit.ray.org_y[i] + hit.ray.dir_y[i] * t;
        ray.org_z[i] = hit.ray.org_z[i] + hit.ray.dir_z[i] * t;
        ray.dir_x[i] = rays.light.x - rays.tile[0][at] - ray.org_x[i];
        ray.dir_y[i] = rays.light.y - rays.tile[1][at] - ray.org_y[i];
        ray.dir_z[i] = rays.light.z - ray.org_z[i];
    }
    // Past the triangle that the hit lies on.
    set_rest<n>(ray, 2e-6f, 1);
    RTCIntersectContext context = coherent();
    Packet<n>::occluded(valid, scene, &context, &ray);
    for (int i = 0; i < n; ++i) lit[i] = valid[i] != 0 && ray.tfar[i] >= 0 ? 1 : 0;
}

template <int n>
void trace_all(RTCScene scene, const Rays& rays, std::size_t first, std::size_t last, float depth,
               bool shadows, Traced& traced) {
    for (std::size_t at = first; at < last; at += n) {
        typename Packet<n>::Hit hit;
        trace_primary<n>(scene, rays, at, depth, hit);
        for (int i = 0; i < n; ++i)
            traced.depth[at + static_cast<std::size_t>(i)] =
                hit.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? hit.ray.tfar[i] : infinite;
        if (shadows) trace_shadows<n>(scene, rays, at, hit, &traced.lit[at]);
    }
}

}  // namespace

void trace_packets(RTCScene scene, const Rays& rays, std::size_t first, std::size_t last,
                   int packet, float depth, bool shadows, Traced& traced) {
    if (packet == 8) return trace_all<8>(scene, rays, first, last, depth, shadows, traced);
    trace_all<16>(scene, rays, first, last, depth, shadows, traced);
}

}  // namespace quadrel::peers
