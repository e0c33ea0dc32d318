// What drawing counts.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "quadrel/errors.hpp"
#include "quadrel/quad/uniforms.hpp"
#include "quadrel/relief/trace/oracle/common_hit.hpp"
#include "quadrel/texture/counters.hpp"
#include "render/stats/stage_clock.hpp"

namespace quadrel {

/// Of integrals over pixels of the film.
struct IntegralCounts {
    std::uint64_t samples = 0;                   ///< of all pixels
    std::uint64_t least = UINT64_MAX, most = 0;  ///< of one
    std::uint64_t above = 0;                     ///< pixels whose error is above the stated one
};

/// Codes of certified.pixel.reason.
inline constexpr std::size_t pixel_reasons = static_cast<std::size_t>(oracle::pixel_apart) + 1;

struct DrawRecord {
    std::uint64_t pixels = 0;  ///< of the film, with a visible fragment; the rest is on demand
    StageTimes stages;
    std::array<FetchCounters, texture_slot_count> fetches{};  ///< by slot
    std::uint64_t quads = 0, covered_lanes = 0, helper_lanes = 0;
    std::uint64_t trace_steps = 0, shadow_steps = 0;  ///< of a marking pass
    std::array<std::uint64_t, 3> certified{};         ///< covered lanes by Certificate
    std::uint64_t without_ray = 0;                    ///< of those of Certificate::none
    /// Covered lanes by what certified.pixel.reason says; those that never have a ray as no_ray.
    std::array<std::uint64_t, pixel_reasons> certified_pixels{};
    IntegralCounts integral;
    std::array<std::uint64_t, error_kinds> kinds{};  ///< covered lanes by ErrorKind
};

inline void merge(IntegralCounts& into, const IntegralCounts& from) {
    into.samples += from.samples;
    into.least = std::min(into.least, from.least);
    into.most = std::max(into.most, from.most);
    into.above += from.above;
}

/// Adds what another thread recorded.
inline void merge(DrawRecord& into, const DrawRecord& from) {
    into.pixels += from.pixels;
    merge(into.stages, from.stages);
    for (std::size_t slot = 0; slot < into.fetches.size(); ++slot)
        into.fetches[slot] += from.fetches[slot];
    into.quads += from.quads;
    into.covered_lanes += from.covered_lanes;
    into.helper_lanes += from.helper_lanes;
    into.trace_steps += from.trace_steps;
    into.shadow_steps += from.shadow_steps;
    for (std::size_t k = 0; k < into.certified.size(); ++k) into.certified[k] += from.certified[k];
    into.without_ray += from.without_ray;
    for (std::size_t k = 0; k < pixel_reasons; ++k)
        into.certified_pixels[k] += from.certified_pixels[k];
    merge(into.integral, from.integral);
    for (std::size_t k = 0; k < into.kinds.size(); ++k) into.kinds[k] += from.kinds[k];
}

}  // namespace quadrel
