#include "sweep/advise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "file/temporary_folder.hpp"
#include "io/document/stage_parameters.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/load.hpp"
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
        const JudgedRun judged = scenes_.judge(scenes_.scene_of(run), run);
        const RunError& error = judged.error;
        if (error.judged == 0) throw UsageError("no ray can be judged");
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

bool is_advised(const Candidate& c) { return c.is_good && c.is_affordable; }

/// Good and affordable, then what is neither or one of them, then what could not be judged.
int rank(const Candidate& c) { return !c.failed.empty() ? 2 : is_advised(c) ? 0 : 1; }

bool comes_first(const Candidate& a, const Candidate& b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    return is_advised(a) ? a.look_ups < b.look_ups : a.texels < b.texels;
}

std::string percent(double share) { return share == 0 ? "0" : fmt::format("{:.2g}", 100 * share); }

std::string misses(const Candidate& c) {
    std::string text;
    const auto add = [&text](double share, const char* what) {
        if (share > 0) text += (text.empty() ? "" : ", ") + percent(share) + " % " + what;
    };
    for (std::size_t kind = 0; kind < c.wrong.size(); ++kind)
        add(c.wrong[kind], error_kind_name(static_cast<ErrorKind>(kind)));
    add(c.nan, "NaN");
    return text.empty() ? "nothing" : text;
}

std::string line_of(const Candidate& c) {
    return fmt::format("| {} | {:.1f} | {:.1f} | {:.2g} | {:g} | {} | {} |\n", c.algorithm.name(),
                       c.look_ups, c.most_look_ups, c.texels, c.worst_angle, misses(c),
                       c.maps.empty() ? "-" : c.maps);
}

bool has_trace(const std::vector<Candidate>& candidates, const std::string& trace) {
    return std::any_of(candidates.begin(), candidates.end(),
                       [&](const Candidate& c) { return c.algorithm.trace == trace; });
}

/// Of each search that has none among `advised` the one that is nearest: the rest of a ladder says
/// nothing more.
std::vector<Candidate> best_rungs(const std::vector<Candidate>& candidates,
                                  const std::vector<Candidate>& advised) {
    std::vector<Candidate> best;
    for (const Candidate& c : candidates)
        if (!has_trace(best, c.algorithm.trace) && !has_trace(advised, c.algorithm.trace))
            best.push_back(c);
    return best;
}

std::string table_of(const std::vector<Candidate>& candidates, std::size_t most,
                     const Question& question) {
    if (candidates.empty()) return "none\n";
    std::string text = fmt::format(
        "| search | look-ups | at most | {:g} % within, texels | worst at | misses there | maps |\n"
        "|---|---|---|---|---|---|---|\n",
        question.percent);
    for (std::size_t i = 0; i < std::min(most, candidates.size()); ++i)
        text += line_of(candidates[i]);
    return text;
}

}  // namespace

std::vector<Candidate> advise(const Question& question) {
    load_scene(question.scene, question.overrides);  // what is wrong with it is no row's fault
    std::vector<Candidate> candidates = Adviser(question).run();
    std::stable_sort(candidates.begin(), candidates.end(), comes_first);
    if (!candidates.empty() && !candidates.front().failed.empty())
        throw InputError(question.scene.string(), "",
                         "a scene on which no search can be judged: " + candidates.front().failed,
                         "a first material with a height map");
    return candidates;
}

std::string advice_text(const Question& question, const std::vector<Candidate>& candidates,
                        std::size_t most) {
    std::array<std::vector<Candidate>, 3> kinds;
    for (const Candidate& c : candidates) kinds[static_cast<std::size_t>(rank(c))].push_back(c);
    std::string text = fmt::format(
        "{}: within {:g} texels of the true hit at {:g} % of the pixels, {:g} to {:g} "
        "degrees{}\n\n",
        question.scene.string(), question.texels, question.percent, question.angles.front(),
        question.angles.back(),
        question.budget ? fmt::format(", at most {:g} look-ups", *question.budget) : "");
    text += kinds[0].empty() ? "No search keeps that.\n"
                             : fmt::format("Cheapest: {}.\n", kinds[0].front().algorithm.name());
    text += "\n" + table_of(kinds[0], most, question) + "\nThe nearest of those that do not:\n\n" +
            table_of(best_rungs(kinds[1], kinds[0]), most, question);
    for (const Candidate& c : kinds[2])
        text += "\nNot judged: " + c.algorithm.name() + ": " + c.failed + "\n";
    const bool has_blocks = std::any_of(
        candidates.begin(), candidates.end(),
        [](const Candidate& c) { return c.maps.find("texel-max") != std::string::npos; });
    if (has_blocks)
        text +=
            "\nSearches that read texel-max maps are judged by blocks, the surface that they "
            "search, all others by bilinear patches.\n";
    return text +
           "\nLook-ups of heights and derived maps a fragment, mean over the angles, where 8 x 4 "
           "pixels wait for the one that takes longest.\n";
}

}  // namespace quadrel::sweep
