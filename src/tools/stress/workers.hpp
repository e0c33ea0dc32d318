// Scenes in processes of their own: one that crashes or hangs takes nothing else with it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "stress/checks.hpp"
#include "stress/scenes/job.hpp"

namespace quadrel::stress {

struct WorkerOptions {
    int processes = 1;
    double seconds = 20;  ///< of processor time that a scene may take; ten times that on the clock
    double look_ups = usual_look_ups;  ///< CheckOptions has it
    std::filesystem::path folder;      ///< with all maps; each process gets one of its own below it
};

/// Runs all scenes; `done` is told of each, in any order, one at a time. A crash, a failed check or
/// a hang is a finding.
void run_scenes(const Job& job, const WorkerOptions& options,
                const std::function<void(const StressScene&, const SceneResult&)>& done);

}  // namespace quadrel::stress
