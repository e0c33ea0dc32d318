#include "sweep/plan/plan_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "quadrel/error.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::sweep {
namespace {

constexpr std::size_t most_runs = 1'000'000;

/// Tables and charts tell scenes, and maps of one size, by their names.
void refuse_equal_names(const Plan& plan, const SceneValue& root) {
    std::set<std::string> scenes, maps;
    for (const PlannedScene& scene : plan.scenes)
        if (!scenes.insert(scene.name).second)
            root.member("scenes").fail("two scenes named \"" + scene.name + "\"",
                                       "a \"name\" of its own for each");
    for (const PlannedMap& map : plan.maps)
        if (!maps.insert(map.name + " " + std::to_string(map.size)).second)
            root.member("maps").fail("two maps named \"" + map.name + "\" of one size",
                                     "a \"name\" of its own for each");
}

void refuse_too_many_runs(const Plan& plan) {
    double runs = 1;
    for (const std::size_t factor :
         {plan.scenes.size(), plan.maps.size(), plan.views.size(), plan.algorithms.size(),
          plan.numbers.size(), plan.isas.size(), plan.threads.size()})
        runs *= static_cast<double>(factor);
    if (runs > static_cast<double>(most_runs))
        throw InputError(plan.file.string(), "", fmt::format("{:.3g} runs", runs),
                         fmt::format("at most {}", most_runs));
}

bool has_view(const Plan& plan, double angle) {
    return std::ranges::any_of(plan.views, [&](const View& view) { return view.angle == angle; });
}

std::string angles_text(const Plan& plan) {
    std::vector<std::string> names;
    for (const View& view : plan.views)
        if (view.angle) names.push_back(view.name());
    return names.empty() ? "none: no view is an angle"
                         : fmt::format("one of the views {}", fmt::join(names, ", "));
}

void refuse_unknown_angles(const Plan& plan, const SceneValue& root) {
    for (const double angle : plan.pictures.angles)
        if (!has_view(plan, angle))
            root.member("pictures")
                .member("angles")
                .fail(fmt::format("{:g} degrees", angle), angles_text(plan));
    for (const Algorithm& algorithm : plan.algorithms)
        for (const auto& [angle, frames] : algorithm.published)
            if (!has_view(plan, angle))
                root.member("algorithms")
                    .fail(fmt::format("figures of {} published for {:g} degrees", algorithm.name(),
                                      angle),
                          angles_text(plan));
}

}  // namespace

void check_plan(const Plan& plan, const SceneValue& root) {
    refuse_equal_names(plan, root);
    refuse_unknown_angles(plan, root);
    refuse_too_many_runs(plan);
}

void check_scenes(const Plan& plan) {
    for (std::size_t i = 0; i < plan.scenes.size(); ++i) {
        const PlannedScene& scene = plan.scenes[i];
        try {
            RenderOptions options;
            options.channels = {"A"};  // parameters are checked whatever is drawn
            explain(load_scene(scene.file_or_name, scene.overrides), options);
        } catch (const InputError& error) {
            throw InputError(
                plan.file.string(), fmt::format("scenes[{}]", i),
                fmt::format("the scene {}, which cannot be read: {}", scene.name, error.what()),
                "one that can, with what \"set\" changes");
        }
    }
}

}  // namespace quadrel::sweep
