// Summaries of errors, for people and for tools.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "quadrel/errors.hpp"

namespace quadrel {
namespace {

using Json = nlohmann::ordered_json;

constexpr ErrorKind listed_kinds[] = {ErrorKind::same,   ErrorKind::late,
                                      ErrorKind::early,  ErrorKind::other_surface,
                                      ErrorKind::missed, ErrorKind::invented};

/// Nothing is 0 that is not.
std::string percent(double share) {
    if (share > 0 && share < 5e-5) return "<0.01 %";
    if (share < 1 && share > 1 - 5e-5) return "99.99 %";
    return fmt::format("{:.2f} %", 100 * share);
}

std::string percent_column(double share) { return fmt::format("{:>15}", percent(share)); }

double ratio(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

bool has_kinds(const ErrorPartSummary& part) {
    for (const ErrorKind kind : listed_kinds)
        if (part.kinds[static_cast<std::size_t>(kind)] > 0) return true;
    return false;
}

std::string kinds_text(const ErrorSummary& summary) {
    std::string text = fmt::format("\n{:<8}", "");
    for (const ErrorKind kind : listed_kinds) text += fmt::format("{:>15}", error_kind_name(kind));
    text += fmt::format("{:>15}\n", "other cell");
    bool any = false;
    for (const ErrorPartSummary& part : summary.parts) {
        if (!has_kinds(part)) continue;
        any = true;
        text += fmt::format("{:<8}", part.name);
        for (const ErrorKind kind : listed_kinds) text += percent_column(part.share(kind));
        text += part.other_cell ? percent_column(ratio(*part.other_cell, summary.judged)) : "";
        text += '\n';
    }
    return any ? text : "";
}

std::string number(double x) { return fmt::format("{:>11}", fmt::format("{:.4g}", x)); }

std::string spreads_text(const ErrorSummary& summary) {
    std::string text = fmt::format("\n{:<8}{:<22}{:>11}{:>11}{:>11}{:>11}{:>11}\n", "", "", "50 %",
                                   "90 %", "99 %", "99.9 %", "most");
    for (const ErrorPartSummary& part : summary.parts) {
        std::string name = part.name;
        for (const ErrorSpread& spread : part.spreads) {
            if (spread.values == 0) continue;
            const std::string measure = spread.channel.substr(spread.channel.rfind('.') + 1);
            text += fmt::format("{:<8}{:<22}", name, fmt::format("{} ({})", measure, spread.unit));
            for (const double x : {spread.p50, spread.p90, spread.p99, spread.p999, spread.most})
                text += number(x);
            if (spread.not_finite > 0)
                text += fmt::format("   {} pixels have none", spread.not_finite);
            text += '\n';
            name.clear();
        }
    }
    return text;
}

std::string worst_text(const ErrorSummary& summary) {
    std::string text, channel;
    for (const WorstPixel& pixel : summary.worst) {
        if (pixel.channel != channel) text += fmt::format("\nworst {}\n", pixel.channel);
        channel = pixel.channel;
        text += fmt::format("{:>11.4g} at {},{} ({}){}\n", pixel.value, pixel.x, pixel.y,
                            error_kind_name(pixel.kind),
                            pixel.command.empty() ? "" : "\n    " + pixel.command);
    }
    return text;
}

/// JSON has no NaN and no infinity.
Json number_json(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json spread_json(const ErrorSpread& spread) {
    return {{"channel", spread.channel},      {"unit", spread.unit},
            {"values", spread.values},        {"not_finite", spread.not_finite},
            {"p50", number_json(spread.p50)}, {"p90", number_json(spread.p90)},
            {"p99", number_json(spread.p99)}, {"p99.9", number_json(spread.p999)},
            {"max", number_json(spread.most)}};
}

Json part_json(const ErrorPartSummary& part) {
    Json kinds = Json::object(), spreads = Json::array();
    for (std::size_t k = 0; k < error_kinds; ++k)
        kinds[error_kind_name(static_cast<ErrorKind>(k))] = part.kinds[k];
    for (const ErrorSpread& spread : part.spreads) spreads.push_back(spread_json(spread));
    return {{"name", part.name},
            {"kinds", kinds},
            {"other_cell", part.other_cell ? Json(*part.other_cell) : Json()},
            {"errors", spreads}};
}

}  // namespace

std::string to_text(const ErrorSummary& summary) {
    std::string text;
    if (!summary.image.empty()) text += summary.image + "\n";
    text += fmt::format("{} pixels, {} covered ({}), {} judged, {} of these certified\n",
                        summary.pixels, summary.covered,
                        percent(ratio(summary.covered, summary.pixels)), summary.judged,
                        percent(ratio(summary.certified, summary.judged)));
    if (summary.other_object)
        text += fmt::format("{} pixels show another object than with the judge's search\n",
                            *summary.other_object);
    if (!summary.judges.empty()) text += "judged by\n" + summary.judges + "\n";
    if (summary.judged == 0) return text;
    return text + kinds_text(summary) + spreads_text(summary) + worst_text(summary);
}

std::string to_json(const ErrorSummary& summary) {
    Json parts = Json::array(), worst = Json::array();
    for (const ErrorPartSummary& part : summary.parts) parts.push_back(part_json(part));
    for (const WorstPixel& pixel : summary.worst)
        worst.push_back({{"x", pixel.x},
                         {"y", pixel.y},
                         {"channel", pixel.channel},
                         {"value", number_json(pixel.value)},
                         {"kind", error_kind_name(pixel.kind)},
                         {"command", pixel.command}});
    const Json all = {{"image", summary.image},
                      {"pixels", summary.pixels},
                      {"covered", summary.covered},
                      {"judged", summary.judged},
                      {"certified", summary.certified},
                      {"other_object", summary.other_object ? Json(*summary.other_object) : Json()},
                      {"judges", summary.judges},
                      {"parts", parts},
                      {"worst", worst}};
    return all.dump(2) + "\n";
}

}  // namespace quadrel
