#include "film/plane_summary.hpp"

#include <algorithm>
#include <bit>

namespace quadrel {
namespace {

void add_integers(const Plane& plane, PlaneSummary& summary) {
    for (const std::uint32_t bits : plane.bits) {
        summary.least = std::min(summary.least, bits);
        summary.most = std::max(summary.most, bits);
    }
}

/// Without branches.
void add_floats(const Plane& plane, PlaneSummary& summary) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr std::uint32_t infinity_bits = 0x7f800000u;
    float low = summary.low, high = summary.high;
    std::size_t nan = 0, infinite = 0;
    for (const std::uint32_t bits : plane.bits) {
        const std::uint32_t magnitude = bits & 0x7fffffffu;
        const bool finite = magnitude < infinity_bits;
        const float value = std::bit_cast<float>(bits);
        low = std::min(low, finite ? value : infinity);
        high = std::max(high, finite ? value : -infinity);
        nan += magnitude > infinity_bits;
        infinite += magnitude == infinity_bits;
    }
    summary.low = low;
    summary.high = high;
    summary.nan += nan;
    summary.infinite += infinite;
}

}  // namespace

void PlaneSummary::add(const Plane& plane) {
    plane.type == ChannelType::uint32 ? add_integers(plane, *this) : add_floats(plane, *this);
}

}  // namespace quadrel
