// What a run takes: times without counting, counts without a clock.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "quadrel/film/film.hpp"
#include "quadrel/render.hpp"

namespace quadrel::sweep {

/// Least and median of repeated draws, milliseconds: CPU time where one thread draws, which holds
/// no waiting, else wall time.
struct RepeatedTime {
    double least = 0, median = 0;
};

struct RunTime {
    RepeatedTime draw;    ///< the image, maps and geometry ready, as a render without statistics
    RepeatedTime kernel;  ///< sum over the stages, each on its own; CPU time of all threads
    /// Of it the search, the median: stages share a tile's time by what they take of the
    /// processor's counter, and one that was held up leaves too little to the others.
    double trace = 0;
    double load_ms = 0;  ///< once: reading maps and deriving what the search needs, wall time
};

/// Draws R G B A `repeats` times with nothing that counts, and as often with a clock around each
/// stage. Throws as `render` does.
RunTime time_run(const Scene& scene, const RenderOptions& options, int repeats,
                 const std::string& trace);

/// Of one drawing, and of one that marks what is touched; nothing of it is timed.
struct RunCounts {
    std::uint64_t fragments = 0, helpers = 0;
    std::map<std::string, double> look_ups;  ///< a fragment, by texture; helper lanes count
    double look_ups_in_all = 0;
    std::uint64_t texels = 0, lines = 0;  ///< distinct; lines of 64 bytes
    double steps = 0;                     ///< of the search, a fragment; helper lanes count
};
RunCounts count_run(const Scene& scene, RenderOptions options);

/// Look-ups of the search by the channels hit.fetches and A.
struct SearchCost {
    double mean = 0;  ///< a fragment
    /// A fragment, where 32 (8 x 4 pixels) go through the search together and wait for the one that
    /// takes longest, as on a GPU.
    double lockstep = 0;
};
SearchCost search_cost(const Film& film);

}  // namespace quadrel::sweep
