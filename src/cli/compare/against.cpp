#include "cli/compare/against.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "cli/common/arguments.hpp"
#include "cli/common/console.hpp"
#include "cli/common/plugins.hpp"
#include "quadrel/errors.hpp"
#include "quadrel/film/comparable.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::cli {
namespace {

/// Codes went through a transfer function that the file does not name.
void refuse_codes(const ComparableImage& image) {
    for (const auto& [name, storage] : image.stored)
        if (image.film.find(name) != nullptr &&
            (storage == Storage::unorm8 || storage == Storage::unorm16))
            throw UsageError(fmt::format(
                "--against: channel \"{}\" is stored as {}, expected floats, as of an EXR", name,
                storage_name(storage)));
}

ComparableImage judged_image(const AgainstArguments& arguments) {
    ComparableImage image = read_comparable(arguments.image, arguments.selection);
    if (arguments.flip_y) flip_y(image.film);
    map_channels(image, parse_mappings(arguments.mappings));
    if (!arguments.channels.empty()) {
        Film none{image.film.frame, image.film.window, {}};
        select_channels(arguments.channels, none, image.film);
    }
    refuse_codes(image);
    return image;
}

/// Errors with a tolerance, against none at all.
CompareReport judge_tolerances(const std::vector<ToleranceRule>& rules, Film errors) {
    std::set<std::string> named;
    for (const ToleranceRule& rule : rules) {
        if (rule.channel.empty())
            throw UsageError(rule.option +
                             ": expected CHANNEL=VALUE with --against, as err.uv=0.5");
        named.merge(matching_channels(rule.option, rule.channel, errors, errors));
    }
    std::vector<bool> unjudged;
    for (const std::uint32_t kind : errors.find("err.kind")->bits)
        unjudged.push_back(kind == static_cast<std::uint32_t>(ErrorKind::not_judged));
    // An image without hits has no kinds; what it has is judged.
    if (std::ranges::count(unjudged, false) == 0) unjudged.clear();
    std::erase_if(errors.planes, [&](const Plane& plane) { return !named.contains(plane.name); });
    Film none = errors;
    for (Plane& plane : none.planes) std::ranges::fill(plane.bits, 0u);
    CompareRules matched = match_tolerances(rules, none, errors);
    matched.left_out = std::move(unjudged);
    return compare(none, errors, matched);
}

void print_summary(const ErrorSummary& summary, const std::optional<CompareReport>& report,
                   bool json) {
    if (!json) {
        print(to_text(summary));
        if (report) print("\n" + to_text(*report));
        return;
    }
    auto all = nlohmann::ordered_json::parse(to_json(summary));
    if (report) all["tolerances"] = nlohmann::ordered_json::parse(to_json(*report));
    print_json(all.dump(2) + "\n");
}

}  // namespace

ExitCode run_against(const AgainstArguments& arguments) {
    load_plugins(arguments.plugins);
    const std::vector<ToleranceRule> rules = parse_tolerances(arguments.tolerances);
    const ComparableImage image = judged_image(arguments);
    const Window& frame = image.film.frame;
    const Scene scene = load_scene(
        arguments.scene,
        with_size(arguments.overrides, fmt::format("{}x{}", frame.width(), frame.height())));
    say_notes(scene.notes);
    ErrorOptions options;
    if (!arguments.window.empty()) options.window = parse_window("--window", arguments.window);
    Film film;
    options.film = &film;
    ErrorSummary summary;
    {
        ProgressBar bar;
        options.progress = [&bar](double share) { bar.show(share); };
        summary = measure_errors(image.film, scene, options);
    }
    summary.image = arguments.image;
    std::optional<CompareReport> report;
    if (!rules.empty()) report = judge_tolerances(rules, std::move(film));
    print_summary(summary, report, arguments.json);
    return report && !report->equal() ? ExitCode::difference : ExitCode::ok;
}

}  // namespace quadrel::cli
