// What a render did and what it took.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "quadrel/raster/assemble.hpp"
#include "quadrel/texture/counters.hpp"

namespace quadrel {

/// One stage, summed over batches and threads.
struct StageStats {
    std::string id;
    std::uint64_t batches = 0, lanes = 0;  ///< lanes: helper and padding lanes included
    std::uint64_t fetches = 0;             ///< texture look-ups, one a lane that asks
    double wall_ms = 0, cpu_ms = 0;
};

/// A texture that was loaded.
struct TextureStats {
    std::string material, slot, file;
    int width = 0, height = 0, levels = 0, faces = 1, channels = 0;
};

/// Everything about one render. Times and memory differ from run to run; the rest does not, except
/// that lanes of padding depend on the tile size.
struct RenderStats {
    std::string isa, number;
    int packet_lanes = 0;      ///< lanes of one packet of the kernels
    std::uint64_t pixels = 0;  ///< of the window
    std::uint64_t quads = 0;   ///< shaded: one for each triangle visible in a quad
    std::uint64_t covered_lanes = 0, helper_lanes = 0;
    FetchCounters fetches;                                 ///< all stages together
    std::map<std::string, std::uint64_t> fetches_by_kind;  ///< look-ups by texture slot
    PrimitiveCounts primitives;
    std::vector<StageStats> stages;
    std::vector<TextureStats> textures;
    std::vector<std::string> left_out;  ///< stages, textures and materials that nothing asked for
    double plan_ms = 0;                 ///< wall time: planning and geometry
    double load_ms = 0;                 ///< textures
    double draw_ms = 0;
    std::uint64_t peak_memory_kib = 0;  ///< of the process so far (0 where the system cannot tell)
};

std::string to_json(const RenderStats& stats);

}  // namespace quadrel
