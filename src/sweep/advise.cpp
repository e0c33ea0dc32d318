#include "sweep/advise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "file/temporary_folder.hpp"
#include "io/document/stage_parameters.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"
#include "render/errors/error_plan.hpp"
#include "sweep/measure.hpp"
#include "sweep/plan/families.hpp"
#include "sweep/run_scenes.hpp"

namespace quadrel::sweep {
namespace {

constexpr std::array ladder{4, 8, 16, 32, 64, 128, 256, 512, 1024};

/// Parameters that count the steps of a search; several go up together.
std::vector<std::string> step_parameters(const std::string& trace) {
    std::vector<std::string> names;
    for (const ParameterText& parameter : find_stage(trace)->parameters) {
        const std::string name = parameter.name;
        if (name == "steps" || name == "points" || name.starts_with("steps_"))
            names.push_back(name);
    }
    return names;
}

/// Rungs of a row's ladder, the fewest steps first; one without parameters where it has none.
std::vector<Algorithm> rungs_of(const std::string& trace) {
    const std::vector<std::string> names = step_parameters(trace);
    if (names.empty()) return {{trace, {}, {}}};
    std::vector<Algorithm> rungs;
    for (const int steps : ladder) {
        Algorithm rung{trace, {}, {}};
        for (const std::string& name : names)
            if (number_of(*find_parameter(trace, name), steps)) rung.parameters[name] = steps;
        if (!rung.parameters.empty()) rungs.push_back(rung);
    }
    return rungs;
}

std::string derived_maps(const std::string& trace) {
    std::string names;
    for (const TextureSlot slot : find_stage(trace)->textures) {
        const std::string name(slot_name(slot));
        if (name != "height") names += (names.empty() ? "" : ", ") + name;
    }
    return names;
}

Plan plan_of(const Question& question) {
    Plan plan;
    plan.scenes.push_back({question.scene.stem().string(), question.scene, question.overrides});
    plan.maps.push_back(scene_map());
    for (const double angle : question.angles) plan.views.push_back({angle});
    plan.width = plan.height = question.side;
    plan.wrong_texels = question.texels;
    return plan;
}

class Adviser {
  public:
    explicit Adviser(const Question& question)
        : question_(question), plan_(plan_of(question)), scenes_(plan_, folder_.path()) {}

    std::vector<Candidate> run() {
        const std::vector<std::string> rows = trace_rows(Rows::corrected);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (question_.progress) question_.progress(i, rows.size(), rows[i]);
            climb(rows[i]);
        }
        return std::move(candidates_);
    }

  private:
    void climb(const std::string& trace) {
        for (const Algorithm& rung : rungs_of(trace)) {
            candidates_.push_back(judge(rung));
            const Candidate& last = candidates_.back();
            if (last.is_good || !last.failed.empty() || !last.is_affordable) break;
        }
    }

    Candidate judge(const Algorithm& algorithm) {
        Candidate candidate;
        candidate.algorithm = algorithm;
        candidate.maps = derived_maps(algorithm.trace);
        plan_.algorithms = {algorithm};
        try {
            for (std::size_t view = 0; view < plan_.views.size(); ++view) add(candidate, view);
        } catch (const InputError& error) {
            candidate.failed = error.what();
        } catch (const UsageError& error) {
            candidate.failed = error.what();
        }
        candidate.look_ups /= static_cast<double>(plan_.views.size());
        candidate.is_good =
            candidate.failed.empty() && candidate.texels <= question_.texels && candidate.nan == 0;
        candidate.is_affordable = !question_.budget || candidate.look_ups <= *question_.budget;
        return candidate;
    }

    void add(Candidate& candidate, std::size_t view) {
        const Run run{0, 0, view, 0, question_.number, "auto", 0};
        const RunScene made = scenes_.scene_of(run);
        const JudgedRun judged = scenes_.judge(made, run);
        const RunError& error = judged.error;
        if (error.judged == 0) throw UsageError("no ray can be judged");
        candidate.surface = error_judge(made.scene, made.scene.materials.front())->surface;
        const double look_ups = search_cost(judged.film).lockstep;
        candidate.look_ups += look_ups;
        candidate.most_look_ups = std::max(candidate.most_look_ups, look_ups);
        const double known = error.texels_at(question_.percent);
        const double texels = std::isnan(known) ? std::numeric_limits<double>::infinity() : known;
        candidate.nan = std::max(candidate.nan, error.nan);
        if (view != 0 && texels <= candidate.texels) return;
        candidate.texels = texels;
        candidate.worst_angle = *plan_.views[view].angle;
        candidate.wrong = error.wrong_kinds;
    }

    const Question& question_;
    TemporaryFolder folder_;
    Plan plan_;
    RunScenes scenes_;
    std::vector<Candidate> candidates_;
};

/// Good and affordable, then what is neither or one of them, then what could not be judged.
int rank(const Candidate& c) { return !c.failed.empty() ? 2 : keeps_all(c) ? 0 : 1; }

bool comes_first(const Candidate& a, const Candidate& b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    return keeps_all(a) ? a.look_ups < b.look_ups : a.texels < b.texels;
}

bool is_to_the_nearest(const SamplerState& sampler) {
    return sampler.mag == Filter::nearest && sampler.min == Filter::nearest;
}

bool any_judged(const std::vector<Candidate>& sorted) {
    return !sorted.empty() && sorted.front().failed.empty();
}

}  // namespace

bool keeps_all(const Candidate& candidate) { return candidate.is_good && candidate.is_affordable; }

oracle::Surface surface_of_scene(const Scene& scene) {
    const Material& material = scene.materials.front();
    const auto judge = error_judge(scene, material);
    if (judge && judge->layers == 0 && material.trace.id != "trace-none") return judge->surface;
    const auto heights = material.textures.find("height");
    const bool blocks =
        heights != material.textures.end() && is_to_the_nearest(heights->second.sampler);
    return blocks ? oracle::Surface::block : oracle::Surface::bilinear;
}

Advice advise(const Question& question) {
    // What is wrong with it is no row's fault.
    const Scene scene = load_scene(question.scene, question.overrides);
    Advice advice;
    std::vector<Candidate> candidates = Adviser(question).run();
    std::stable_sort(candidates.begin(), candidates.end(), comes_first);
    if (!any_judged(candidates))
        throw InputError(question.scene.string(), "",
                         "a scene on which no search can be judged" +
                             (candidates.empty() ? "" : ": " + candidates.front().failed),
                         "a first material with a height map");
    advice.surface = surface_of_scene(scene);
    for (Candidate& c : candidates)
        (c.failed.empty() && c.surface != advice.surface ? advice.others : advice.searches)
            .push_back(std::move(c));
    return advice;
}

}  // namespace quadrel::sweep
