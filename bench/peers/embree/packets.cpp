#include "embree/packets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace quadrel::peers {
namespace {

/// Embree's types and functions for packets of one size.
template <class RayPacket, class HitPacket, auto intersect_packet, auto occluded_packet>
struct PacketOf {
    using Ray = RayPacket;
    using Hit = HitPacket;
    static constexpr int size = std::extent_v<decltype(Ray::tnear)>;
    static constexpr auto intersect = intersect_packet;
    static constexpr auto occluded = occluded_packet;
};
using PacketOf8 = PacketOf<RTCRay8, RTCRayHit8, rtcIntersect8, rtcOccluded8>;
using PacketOf16 = PacketOf<RTCRay16, RTCRayHit16, rtcIntersect16, rtcOccluded16>;

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Coherent packets of neighbouring pixels.
RTCIntersectContext coherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

template <class Packet>
void set_rest(typename Packet::Ray& ray, float nearest, float farthest) {
    constexpr int n = Packet::size;
    std::fill_n(ray.tnear, n, nearest);
    std::fill_n(ray.tfar, n, farthest);
    std::fill_n(ray.time, n, 0.0f);
    std::fill_n(ray.mask, n, ~0u);
    std::fill_n(ray.flags, n, 0u);
}

template <class Packet>
void trace_primary(RTCScene scene, const Rays& rays, std::size_t first, float depth,
                   typename Packet::Hit& hit) {
    constexpr int n = Packet::size;
    alignas(64) int valid[n];
    std::fill_n(valid, n, -1);
    std::copy_n(&rays.origin[0][first], n, hit.ray.org_x);
    std::copy_n(&rays.origin[1][first], n, hit.ray.org_y);
    std::copy_n(&rays.origin[2][first], n, hit.ray.org_z);
    std::copy_n(&rays.direction[0][first], n, hit.ray.dir_x);
    std::copy_n(&rays.direction[1][first], n, hit.ray.dir_y);
    std::copy_n(&rays.direction[2][first], n, hit.ray.dir_z);
    set_rest<Packet>(hit.ray, 0, depth);
    std::fill_n(hit.hit.geomID, n, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(hit.hit.instID[0], n, RTC_INVALID_GEOMETRY_ID);
    RTCIntersectContext context = coherent();
    Packet::intersect(valid, scene, &context, &hit);
}

/// From the hits to the light, which lies at t = 1.
template <class Packet>
void trace_shadows(RTCScene scene, const Rays& rays, std::size_t first,
                   const typename Packet::Hit& hit, std::uint8_t* lit) {
    constexpr int n = Packet::size;
    alignas(64) int valid[n];
    typename Packet::Ray ray;
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
    set_rest<Packet>(ray, 2e-6f, 1);
    RTCIntersectContext context = coherent();
    Packet::occluded(valid, scene, &context, &ray);
    for (int i = 0; i < n; ++i) lit[i] = valid[i] != 0 && ray.tfar[i] >= 0 ? 1 : 0;
}

template <class Packet>
void trace_all(RTCScene scene, const Rays& rays, std::size_t first, std::size_t last, float depth,
               bool shadows, Traced& traced) {
    constexpr int n = Packet::size;
    for (std::size_t at = first; at < last; at += n) {
        typename Packet::Hit hit;
        trace_primary<Packet>(scene, rays, at, depth, hit);
        for (int i = 0; i < n; ++i)
            traced.depth[at + static_cast<std::size_t>(i)] =
                hit.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? hit.ray.tfar[i] : infinite;
        if (shadows) trace_shadows<Packet>(scene, rays, at, hit, &traced.lit[at]);
    }
}

}  // namespace

void trace_packets(RTCScene scene, const Rays& rays, std::size_t first, std::size_t last,
                   int packet, float depth, bool shadows, Traced& traced) {
    if (packet == 8) return trace_all<PacketOf8>(scene, rays, first, last, depth, shadows, traced);
    trace_all<PacketOf16>(scene, rays, first, last, depth, shadows, traced);
}

}  // namespace quadrel::peers
