// Advice in words and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "sweep/advise.hpp"

namespace quadrel::sweep {
namespace {

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

/// Those that keep all, and those of the others that were judged.
std::array<std::vector<Candidate>, 2> parted(const std::vector<Candidate>& candidates) {
    std::array<std::vector<Candidate>, 2> parts;
    for (const Candidate& c : candidates)
        if (c.failed.empty()) parts[keeps_all(c) ? 0 : 1].push_back(c);
    return parts;
}

std::string in_words(oracle::Surface surface) {
    switch (surface) {
        case oracle::Surface::bilinear:
            return "bilinear patches";
        case oracle::Surface::block:
            return "texels as blocks";
        default:
            return "triangles";
    }
}

std::string others_text(const Question& question, const Advice& advice, oracle::Surface surface,
                        std::size_t most) {
    std::vector<Candidate> of_surface;
    for (const Candidate& c : advice.others)
        if (c.surface == surface) of_surface.push_back(c);
    if (of_surface.empty()) return "";
    const auto [good, rest] = parted(of_surface);
    const std::string rest_text = rest.empty()
                                      ? ""
                                      : "\nThe nearest of those that do not keep that:\n\n" +
                                            table_of(best_rungs(rest, good), most, question);
    return fmt::format(
               "\nNot of this surface: the scene draws {}, these searches meet {}. They are judged "
               "by the surface that they search, and their hits lie elsewhere than the scene's, "
               "however exact they are:\n\n",
               in_words(advice.surface), in_words(surface)) +
           table_of(good, most, question) + rest_text;
}

Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const Candidate& c) {
    Json parameters = Json::object(), wrong = Json::object();
    for (const auto& [name, value] : c.algorithm.parameters)
        parameters[name] = value.name() ? Json(*value.name()) : Json(*value.number());
    for (std::size_t kind = 0; kind < c.wrong.size(); ++kind)
        wrong[error_kind_name(static_cast<ErrorKind>(kind))] = c.wrong[kind];
    return {{"search", c.algorithm.name()},
            {"trace", c.algorithm.trace},
            {"parameters", parameters},
            {"surface", oracle::surface_names[static_cast<std::size_t>(c.surface)].name},
            {"maps", c.maps},
            {"look_ups", c.look_ups},
            {"most_look_ups", c.most_look_ups},
            {"texels", or_null(c.texels)},
            {"worst_angle", c.worst_angle},
            {"wrong", wrong},
            {"nan", c.nan},
            {"keeps_error", c.is_good},
            {"keeps_budget", c.is_affordable}};
}

Json list_of(const std::vector<Candidate>& candidates) {
    Json list = Json::array();
    for (const Candidate& c : candidates)
        if (c.failed.empty()) list.push_back(json_of(c));
    return list;
}

bool has_advised(const std::vector<Candidate>& candidates) {
    return !candidates.empty() && candidates.front().failed.empty() &&
           keeps_all(candidates.front());
}

}  // namespace

std::string advice_text(const Question& question, const Advice& advice, std::size_t most) {
    const auto [good, rest] = parted(advice.searches);
    std::string text = fmt::format(
        "{}: within {:g} texels of the true hit of {} at {:g} % of the pixels, {:g} to {:g} "
        "degrees{}\n\n",
        question.scene.string(), question.texels, in_words(advice.surface), question.percent,
        question.angles.front(), question.angles.back(),
        question.budget ? fmt::format(", at most {:g} look-ups", *question.budget) : "");
    text += good.empty() ? "No search keeps that.\n"
                         : fmt::format("Cheapest: {}.\n", good.front().algorithm.name());
    text += "\n" + table_of(good, most, question) + "\nThe nearest of those that do not:\n\n" +
            table_of(best_rungs(rest, good), most, question);
    for (const ValueName& surface : oracle::surface_names)
        text += others_text(question, advice,
                            static_cast<oracle::Surface>(static_cast<int>(surface.value)), most);
    for (const Candidate& c : advice.searches)
        if (!c.failed.empty())
            text += "\nNot judged: " + c.algorithm.name() + ": " + c.failed + "\n";
    return text +
           "\nLook-ups of heights and derived maps a fragment, mean over the angles, where 8 x 4 "
           "pixels wait for the one that takes longest.\n";
}

Json advice_json(const Question& question, const Advice& advice) {
    Json not_judged = Json::array();
    for (const Candidate& c : advice.searches)
        if (!c.failed.empty())
            not_judged.push_back({{"search", c.algorithm.name()}, {"reason", c.failed}});
    return {
        {"scene", question.scene.string()},
        {"error_texels", question.texels},
        {"percent", question.percent},
        {"angles", question.angles},
        {"budget", question.budget ? Json(*question.budget) : Json()},
        {"surface", oracle::surface_names[static_cast<std::size_t>(advice.surface)].name},
        {"cheapest",
         has_advised(advice.searches) ? Json(advice.searches.front().algorithm.name()) : Json()},
        {"searches", list_of(advice.searches)},
        {"other_surfaces", list_of(advice.others)},
        {"not_judged", not_judged}};
}

}  // namespace quadrel::sweep
