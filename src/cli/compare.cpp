// quadrel compare: strict about NaN, infinities, sizes and channels.
#include "quadrel/compare.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/arguments.hpp"
#include "cli/console.hpp"
#include "cli/verbs.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel::cli {
namespace {

struct Arguments {
    std::string reference, test, channels, heatmap;
    Tolerance tolerance;
    bool json = false;
};

bool belongs_to(const std::string& channel, const std::string& request) {
    return channel == request || channel.compare(0, request.size() + 1, request + ".") == 0;
}

bool holds(const Film& film, const std::string& request) {
    return std::any_of(film.planes.begin(), film.planes.end(),
                       [&](const Plane& plane) { return belongs_to(plane.name, request); });
}

/// Drops the channels that no request names.
void keep_only(Film& film, const std::vector<std::string>& requests) {
    std::erase_if(film.planes, [&](const Plane& plane) {
        return std::none_of(requests.begin(), requests.end(), [&](const std::string& request) {
            return belongs_to(plane.name, request);
        });
    });
}

void select_channels(const std::string& list, Film& reference, Film& test) {
    const std::vector<std::string> requests = parse_list("--channels", list);
    for (const std::string& request : requests)
        if (!holds(reference, request) && !holds(test, request))
            throw UsageError("--channels: neither image has a channel \"" + request + "\"");
    keep_only(reference, requests);
    keep_only(test, requests);
}

ExitCode run_compare(const Arguments& arguments) {
    Film reference = read_exr(arguments.reference).film;
    Film test = read_exr(arguments.test).film;
    if (!arguments.channels.empty()) select_channels(arguments.channels, reference, test);
    const CompareReport report = compare(reference, test, arguments.tolerance);
    print(arguments.json ? to_json(report) : to_text(report));
    if (!arguments.heatmap.empty()) write_png(arguments.heatmap, heatmap(reference, test));
    return report.equal() ? ExitCode::ok : ExitCode::difference;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("compare", "compare two EXR images, value by value");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("reference", a->reference, "the image that is right")->required();
    verb->add_option("test", a->test, "the image to be judged")->required();
    verb->add_option("--abs", a->tolerance.abs, "allow this absolute error of floats")
        ->check(CLI::NonNegativeNumber);
    verb->add_option("--rel", a->tolerance.rel, "allow this error relative to the reference")
        ->check(CLI::NonNegativeNumber);
    verb->add_option("--ulp", a->tolerance.ulp, "allow floats to be so many values apart");
    verb->add_option("--channels", a->channels, "compare these comma-separated channels only");
    verb->add_option("--heatmap", a->heatmap, "write a PNG of the largest error of each pixel");
    verb->add_flag("--json", a->json, "machine-readable, on standard output");
    verb->callback([a, &action] { action = [a] { return run_compare(*a); }; });
}

}  // namespace quadrel::cli
