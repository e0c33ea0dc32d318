// The runs of a plan, in its order, and the scene that each of them draws.
#pragma once

#include <string>
#include <vector>

#include "quadrel/scene/scene.hpp"
#include "sweep/plan/plan.hpp"

namespace quadrel::sweep {

/// Indices into the plan's lists.
struct Run {
    std::size_t scene, map, view, algorithm;
    std::string number, isa;
    int threads;
};

/// Scenes, then maps, then views, then algorithms, so that runs that share a truth follow another.
std::vector<Run> runs_of(const Plan& plan);

/// Every `of`-th run from the `task`-th on, both counted from 1.
std::vector<Run> runs_of_task(const std::vector<Run>& all, int task, int of);

/// "material.height=..." for a map that lies in `file`, or for a scene's own: read at level 0
/// alone, as the judge reads it, so that only searches differ.
std::string height_override(const PlannedMap& map, const std::filesystem::path& file);
std::string height_override(const TextureReference& own);

/// "key=value" that make the run's scene of the planned one. `heights`: a height_override, or empty
/// where the scene has no map; `normal_file`: a normal map made of it, or empty.
std::vector<std::string> overrides_of(const Plan& plan, const Run& run, const std::string& heights,
                                      const std::filesystem::path& normal_file);

/// The line that renders the run's picture.
std::string render_command(const Plan& plan, const Run& run,
                           const std::vector<std::string>& overrides);

}  // namespace quadrel::sweep
