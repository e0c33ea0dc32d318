// The tables, one a function.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "options.hpp"
#include "picture.hpp"
#include "process.hpp"
#include "report.hpp"

namespace quadrel::peers {

/// What a run of the program has at hand, and what it found.
struct Run {
    const Options& options;
    ProcessRunner& processes;
    std::filesystem::path maps;  ///< folder of the wall's maps
    /// Peers that are not there, and why.
    std::vector<std::string> skipped = {};
    /// Pictures that should be the same and are not.
    std::vector<std::string> disagreements = {};
    int judged = 0;   ///< pictures that were held against a peer's
    int refused = 0;  ///< of these

    /// A picture that lies `difference` from a peer's; `what` is said where that is too far.
    void judge(const std::string& what, double difference, double tolerance);
    /// Once, however often it is said.
    void skip(const std::string& peer, const std::string& why);
};

/// Quadrel's picture of the wall at that angle, in colours, of the run's size and maps unless
/// others are given.
Picture colour_picture(const Run& run, double angle, const std::vector<std::string>& overrides);
Picture colour_picture(const Run& run, double angle, const std::vector<std::string>& overrides,
                       const std::filesystem::path& maps, int size);

/// The names that --tables takes, in the order in which they are made.
std::vector<std::string> table_names();

/// Makes a table. The names are those above.
Table make_table(const std::string& name, Run& run);

/// Quadrel beside llvmpipe, each on so many threads.
Table drawn_table(Run& run, int threads);
/// Exact hits beside Embree.
Table traced_table(Run& run, int threads);
/// The command line as a process: from start to file.
Table file_table(Run& run);
/// Quadrel alone: maps from small to large, frames from small to large, one thread and two.
Table map_table(Run& run);
Table frame_table(Run& run);
Table thread_table(Run& run);
/// Quadrel beside llvmpipe, and beside itself without shortcuts, on maps and meshes of many kinds.
Table other_map_table(Run& run);
/// What look-ups, film, loading and packing alone take, and how far drawing is from it.
Table floor_table(Run& run);
Table file_floor_table(Run& run);
/// What --stats adds to a render.
Table stats_table(Run& run);

}  // namespace quadrel::peers
