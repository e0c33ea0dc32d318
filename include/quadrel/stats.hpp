// What a render did and what it took.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "quadrel/errors.hpp"
#include "quadrel/raster/assemble.hpp"
#include "quadrel/texture/counters.hpp"

namespace quadrel {

/// One stage, summed over batches and threads. Of more than a few batches one in seven is measured,
/// and look-ups and times are made of these.
struct StageStats {
    std::string id;
    std::uint64_t batches = 0, lanes = 0;  ///< lanes: helper and padding lanes included
    std::uint64_t fetches = 0;             ///< texture look-ups, one per lane that asks
    double wall_ms = 0, cpu_ms = 0;
};

/// Distinct texels that look-ups touched (texture/marks.hpp has the rule), and distinct cache lines
/// of 64 bytes that they lie in, as float32.
struct TouchedStats {
    std::uint64_t texels = 0, lines = 0;

    TouchedStats& operator+=(const TouchedStats& other) {
        texels += other.texels;
        lines += other.lines;
        return *this;
    }
};

/// A texture that was loaded.
struct TextureStats {
    std::string material, slot, file;
    int width = 0, height = 0, levels = 0, faces = 1, channels = 0;
    std::uint64_t non_finite = 0;  ///< texels of the finest level with NaN or infinity
    /// By mip level, the finest first; all faces together. Empty unless it was asked for.
    std::vector<TouchedStats> touched;
};

/// Time of a part of a render; cpu_ms: of all threads of the process.
struct PhaseTime {
    double wall_ms = 0, cpu_ms = 0;
};

/// Bounds of height maps that were made for searches to leave out steps by; none where an earlier
/// render had made them.
struct MaximaStats {
    std::uint64_t maps = 0, bytes = 0;
    double wall_ms = 0;
};

/// Covered lanes by what is proven of their hits (channel `certified`).
struct CertifiedStats {
    bool drawn = false;  ///< else nothing was asked
    std::uint64_t by_bounds = 0, exactly = 0, not_proven = 0;
    std::uint64_t without_ray = 0;  ///< have no frame or no heights, and so nothing to prove

    /// Of the lanes with a ray, those whose hit is proven; 1 where there are none.
    double share() const {
        const double proven = static_cast<double>(by_bounds + exactly);
        return not_proven == 0 ? 1 : proven / (proven + static_cast<double>(not_proven));
    }
};

/// Covered lanes by what is proven of their pixels, whose exact rays are known to lie in a range
/// (channels `certified.pixel` and `certified.pixel.reason`).
struct CertifiedPixelStats {
    bool drawn = false;  ///< else nothing was asked
    std::uint64_t proven = 0;
    std::uint64_t open = 0;            ///< whether it hits, or in which cell, is not
    std::uint64_t apart = 0;           ///< it ends elsewhere than the drawn ray
    std::uint64_t ray_not_proven = 0;  ///< nor is the hit of the drawn ray
    std::uint64_t without_ray = 0;     ///< as CertifiedStats has them

    /// Of the lanes with a ray, those whose pixel is proven; 1 where there are none.
    double share() const {
        const std::uint64_t rays = proven + open + apart + ray_not_proven;
        return rays == 0 ? 1 : static_cast<double>(proven) / static_cast<double>(rays);
    }
};

/// Samples of pixels that are integrals; the time that they take is that of drawing.
struct IntegralStats {
    bool drawn = false;                 ///< else pixels are no integrals
    std::uint64_t samples = 0;          ///< of all pixels of the window
    std::uint64_t least = 0, most = 0;  ///< of a pixel
    std::uint64_t above = 0;  ///< pixels that have all samples, and an error above the stated one
};

/// Covered lanes by where their hit lies beside the judge's (channel `err.kind`, errors.hpp).
struct KindStats {
    bool drawn = false;  ///< else nothing was asked
    std::array<std::uint64_t, error_kinds> lanes{};
};

/// Everything about one render. Times and memory differ from run to run; the rest does not, except
/// that lanes of padding depend on the tile size, and look-ups without `has_touched` on what was
/// left out, which differs between instruction sets and from run to run.
struct RenderStats {
    std::string isa, number;
    int packet_lanes = 0;      ///< lanes of one packet of the kernels
    std::uint64_t pixels = 0;  ///< of the window
    std::uint64_t quads = 0;   ///< shaded: one for each triangle visible in a quad
    std::uint64_t covered_lanes = 0, helper_lanes = 0;
    /// All stages together, as drawn, or with `has_touched` as the algorithms have them: those of
    /// steps that drawing leaves out, too.
    FetchCounters fetches;
    std::map<std::string, std::uint64_t> fetches_by_kind;  ///< look-ups by texture slot
    bool has_touched = false;  ///< RenderOptions::touched; else `touched` and steps are 0
    TouchedStats touched;      ///< a texture that several materials share is counted once
    /// Points of rays that were tested, helper lanes included, by searches for the hit and towards
    /// lights.
    std::uint64_t trace_steps = 0, shadow_steps = 0;
    CertifiedStats certified;
    CertifiedPixelStats certified_pixels;
    IntegralStats integral;
    KindStats kinds;
    PrimitiveCounts primitives;
    std::vector<StageStats> stages;
    std::vector<TextureStats> textures;
    MaximaStats maxima;
    std::vector<std::string> left_out;  ///< stages, textures and materials that nothing asked for
    PhaseTime plan;                     ///< planning and geometry
    PhaseTime load;                     ///< textures
    PhaseTime draw;                     ///< the image, and writing it where that is done meanwhile
    PhaseTime mark;                     ///< the second pass that finds what was touched, if any
    std::uint64_t peak_memory_kib = 0;  ///< of the process so far (0 where the system cannot tell)
};

std::string to_json(const RenderStats& stats);

/// What is known of every render without counting.
struct RenderSummary {
    std::uint64_t pixels = 0, covered = 0;  ///< of the window; covered: with a visible fragment
    PrimitiveCounts primitives;
    std::vector<std::string> left_out;  ///< as RenderStats has it
    PhaseTime plan, load, draw;         ///< as RenderStats has them
};

}  // namespace quadrel
