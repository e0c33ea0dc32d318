// quadrel compare: strict about NaN, infinities, sizes and channels.
#include "quadrel/compare.hpp"

#include <CLI/CLI.hpp>
#include <memory>
#include <set>

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

bool is_below(const std::string& channel, const std::string& group) {
    return channel.compare(0, group.size() + 1, group + ".") == 0;
}

/// The names that a request stands for in either image: the channel of that name, else those
/// below it.
std::set<std::string> matches(const std::string& request, const Film& reference, const Film& test) {
    if (reference.find(request) != nullptr || test.find(request) != nullptr) return {request};
    std::set<std::string> names;
    for (const Film* film : {&reference, &test})
        for (const Plane& plane : film->planes)
            if (is_below(plane.name, request)) names.insert(plane.name);
    return names;
}

/// Drops the channels that no request names.
void select_channels(const std::string& list, Film& reference, Film& test) {
    std::set<std::string> wanted;
    for (const std::string& request : parse_list("--channels", list)) {
        const std::set<std::string> names = matches(request, reference, test);
        if (names.empty())
            throw UsageError("--channels: neither image has a channel \"" + request + "\"");
        wanted.insert(names.begin(), names.end());
    }
    const auto unwanted = [&](const Plane& plane) { return wanted.count(plane.name) == 0; };
    std::erase_if(reference.planes, unwanted);
    std::erase_if(test.planes, unwanted);
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
