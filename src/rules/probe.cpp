#include "rules/probe.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace quadrel::rules {
namespace {

bool is_same(float a, float b, double tolerance) {
    if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
    if (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b)) return true;
    return std::fabs(double(a) - double(b)) <= tolerance && tolerance > 0;
}

}  // namespace

std::vector<Probe> all_probes() {
    std::vector<Probe> all;
    for (const auto& list : {quad_probes(), coverage_probes(), level_probes(), texel_probes(),
                             cube_probes(), number_probes()})
        all.insert(all.end(), list.begin(), list.end());
    return all;
}

Values answers_of_quadrel(const Probe& probe, const HardwareModel& hardware) {
    return probe.model ? probe.model(hardware) : ask_quadrel(probe.question, hardware);
}

std::size_t differing(const Probe& probe, const Values& a, const Values& b) {
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += !is_same(a[i], b[i], probe.tolerance);
    return count;
}

}  // namespace quadrel::rules
