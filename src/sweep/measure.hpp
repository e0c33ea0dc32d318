// What a run takes: times without counting, counts without a clock.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "quadrel/film/film.hpp"
#include "quadrel/render.hpp"
#include "render/plan/prepared.hpp"

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
    int repeats = 0;
    double load_ms = 0;  ///< once: reading maps and deriving what the search needs, wall time
};

/// Nothing of it is timed.
struct RunCounts {
    std::uint64_t fragments = 0, helpers = 0;
    std::map<std::string, double> look_ups;  ///< a fragment, by texture; helper lanes count
    double look_ups_in_all = 0;
    std::uint64_t texels = 0, lines = 0;  ///< distinct; lines of 64 bytes
    double steps = 0;                     ///< of the search, a fragment; helper lanes count
};

/// A run's R G B A, planned, loaded and drawn once, to be timed and counted.
class MeasuredRun {
  public:
    /// The scene must outlive it. Throws as `render` does.
    MeasuredRun(const Scene& scene, const RenderOptions& options);

    /// Draws `repeats` times with nothing that counts, and as often with a clock around each stage.
    /// Begins no repetition once these have taken so many seconds, by the clock of the draws. Calls
    /// `progress` of the options between two repetitions alone.
    RunTime time(int repeats, double seconds, const std::string& trace);

    /// Draws once more, and marks what is touched.
    RunCounts count() const;

  private:
    RenderOptions options_;
    double load_ms_ = 0;
    PreparedRender prepared_;
    Film film_;           ///< its pages are there when it is drawn into the next time
    DrawRecord counted_;  ///< of the first drawing
};

/// Look-ups of the search by the channels hit.fetches and A.
struct SearchCost {
    double mean = 0;  ///< a fragment
    /// A fragment, where 32 (8 x 4 pixels) go through the search together and wait for the one that
    /// takes longest, as on a GPU.
    double lockstep = 0;
};
SearchCost search_cost(const Film& film);

}  // namespace quadrel::sweep
