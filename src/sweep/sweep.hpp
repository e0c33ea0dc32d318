// Running a plan, run by run, into a folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/document/json.hpp"
#include "sweep/plan/plan.hpp"

namespace quadrel::sweep {

struct SweepOptions {
    std::filesystem::path output;  ///< a folder, made where absent
    int task = 1, of = 1;          ///< every `of`-th run from the `task`-th on
    std::string version;           ///< of the program
    /// Told before each run how many are done, how many there are, and which one it is.
    std::function<void(std::size_t done, std::size_t all, const std::string& name)> progress;
    /// Called now and then within a run, from any thread, one at a time, but not while something is
    /// timed. What it throws ends the sweep: nothing is kept of this run.
    std::function<void()> pause = {};
};

struct SweepOutcome {
    std::size_t measured = 0, known = 0, failed = 0;
    std::vector<Json> records;  ///< of this task's runs, in the plan's order
};

/// Measures what output/runs has not: a run is known by a hash of its scene with all files, how it
/// is run, the program and the processor. Each becomes a file of its own as it is finished; one
/// that cannot be drawn is kept with the reason, and tried again the next time. Maps that the plan
/// has made lie in output/maps, and output/part.json says what was asked for (part.hpp). Throws
/// InputError for a plan whose scenes cannot be read,
/// OutputError.
SweepOutcome run_sweep(const Plan& plan, const SweepOptions& options);

struct MergedSweeps {
    std::vector<Json> records;  ///< in the plan's order
    /// What there is of the plan whose runs are not all there, as lacking_runs says it; empty if
    /// all are, or the folders do not say which there should be.
    std::string lacking;
};

/// All runs of the folders' sweeps, each once, copied into output/runs, and the maps that their
/// commands name into output/maps. Where runs of the folders' plans are missing nothing is written,
/// unless `partial`. Throws InputError for that, and for a folder that is none of a sweep;
/// OutputError.
MergedSweeps merge_sweeps(const std::vector<std::filesystem::path>& folders,
                          const std::filesystem::path& output, bool partial = false);

/// Makes a folder. Throws OutputError.
void make_folder(const std::filesystem::path& folder);

}  // namespace quadrel::sweep
