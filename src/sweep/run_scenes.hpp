// The scenes of a plan's runs, and what their hits should have been.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "quadrel/render.hpp"
#include "sweep/made_maps.hpp"
#include "sweep/plan/runs.hpp"
#include "sweep/run_error.hpp"

namespace quadrel::sweep {

/// A run's scene, and the overrides that made it.
struct RunScene {
    Scene scene;
    std::vector<std::string> overrides;
};

/// A run's film with error_channels, hit.fetches and A, and how far it is from the truth.
struct JudgedRun {
    Film film;
    RunError error;
    MapSize map;
};

class RunScenes {
  public:
    /// Maps that the plan has made are written into `maps`. The plan must outlive it.
    RunScenes(const Plan& plan, std::filesystem::path maps) : plan_(plan), maps_(std::move(maps)) {}

    /// Throws InputError for a scene that cannot be read.
    RunScene scene_of(const Run& run);

    /// Renders the run and, unless it was the one before's too, the truth. `more` channels are
    /// asked for beside. Throws as `render` does, and UsageError for a scene without a height map.
    JudgedRun judge(const RunScene& run_scene, const Run& run,
                    const std::vector<std::string>& more = {});

    static RenderOptions render_options(const Run& run);

  private:
    const std::string& heights_of(const Run& run);
    Scene load(const Run& run, const std::vector<std::string>& overrides);
    const Film& truth_of(const Run& run);

    const Plan& plan_;
    std::filesystem::path maps_;
    std::map<std::pair<std::size_t, std::size_t>, std::string> heights_;  ///< by scene and map
    std::shared_ptr<TextureCache> cache_;
    std::pair<std::size_t, std::size_t> cached_;  ///< scene and map
    std::map<std::string, Film> truths_;          ///< by the scene's hash and the number type
};

}  // namespace quadrel::sweep
