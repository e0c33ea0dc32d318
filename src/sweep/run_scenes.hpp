// The scenes of a plan's runs, and what their hits should have been.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "quadrel/render.hpp"
#include "render/errors/known_truths.hpp"
#include "sweep/made_maps.hpp"
#include "sweep/plan/runs.hpp"
#include "sweep/run_error.hpp"

namespace quadrel::sweep {

/// A run's scene, and the overrides that made it.
struct RunScene {
    Scene scene;
    std::vector<std::string> overrides;
};

/// A run's film with run_error_channels and hit.fetches, and how far it is from the truth.
struct JudgedRun {
    Film film;
    RunError error;
    MapSize map;
};

class RunScenes {
  public:
    /// Maps that the plan has made are written into `maps`. The plan must outlive it. Renders call
    /// `pause` now and then, if it is one; what it throws ends them.
    RunScenes(const Plan& plan, std::filesystem::path maps, std::function<void()> pause = {})
        : plan_(plan), maps_(std::move(maps)), pause_(std::move(pause)) {}

    /// Throws InputError for a scene that cannot be read.
    RunScene scene_of(const Run& run);

    /// Renders the run and what it is judged by. `more` channels are asked for beside. Throws as
    /// `render` does, and UsageError for a scene without a height map.
    JudgedRun judge(const RunScene& run_scene, const Run& run,
                    const std::vector<std::string>& more = {});

    RenderOptions render_options(const Run& run) const;

  private:
    const std::string& heights_of(const Run& run);
    const std::filesystem::path& normals_of(const Material& material);
    KnownTruths* truths_of(const RunScene& run_scene, const Run& run);
    Scene load(const Run& run, const std::vector<std::string>& overrides);

    const Plan& plan_;
    std::filesystem::path maps_;
    std::function<void()> pause_;
    std::map<std::pair<std::size_t, std::size_t>, std::string> heights_;  ///< by scene and map
    std::map<std::pair<std::filesystem::path, float>, std::filesystem::path> normals_;
    /// By scene, map, view, number type and the judge: runs that differ in their search alone.
    std::map<std::tuple<std::size_t, std::size_t, std::size_t, std::string, std::string>,
             std::unique_ptr<KnownTruths>>
        truths_;
    std::shared_ptr<TextureCache> cache_;
    std::pair<std::size_t, std::size_t> cached_;  ///< scene and map
};

}  // namespace quadrel::sweep
