// quadrel view: a page to look at every value of one image or of two.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <set>

#include "cli/common/arguments.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/common/hints.hpp"
#include "cli/common/quiet.hpp"
#include "cli/common/selection_options.hpp"
#include "cli/compare/arguments.hpp"
#include "cli/verbs.hpp"
#include "cli/view.hpp"
#include "file/atomic_file.hpp"
#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

constexpr double mebibyte = 1024 * 1024;
/// Beyond the first, the page takes a while to open; beyond the second, browsers give up.
constexpr std::size_t large_page = 15 << 20, largest_page = 256 << 20;
/// Values of all sources: half a gigabyte of bits in the browser.
constexpr std::size_t most_values = std::size_t(1) << 27;

struct ViewArguments {
    std::vector<std::string> images;
    std::string output, channels, window;
    ImageSelection selection;
};

/// Keeps channels that the list names in either image.
void keep_channels(const std::string& list, std::vector<page::ViewSource>& sources) {
    if (list.empty()) return;
    Film& first = sources.front().image.film;
    Film none{first.frame, first.window, {}};
    select_channels(list, first, sources.size() > 1 ? sources[1].image.film : none);
}

void keep_window(const std::string& text, std::vector<page::ViewSource>& sources) {
    if (text.empty()) return;
    const Window window = parse_window("--window", text);
    for (page::ViewSource& source : sources) {
        Film& film = source.image.film;
        if (!contains(film.window, window))
            throw UsageError(fmt::format(
                "--window: found {}, expected one in {}, which has "
                "{},{},{},{}",
                text, source.name, film.window.x0, film.window.y0, film.window.x1, film.window.y1));
        crop(film, window);
    }
}

void check_values(const std::vector<page::ViewSource>& sources) {
    std::size_t values = 0;
    for (const page::ViewSource& source : sources)
        values += source.image.film.window.area() * source.image.film.planes.size();
    if (values > most_values)
        throw UsageError(
            fmt::format("{:.0f} million values, more than a browser holds (134); "
                        "expected --channels or --window to choose some",
                        static_cast<double>(values) / 1e6));
}

std::vector<page::ViewSource> read_sources(const ViewArguments& arguments) {
    std::optional<Window> part;
    if (!arguments.window.empty()) part = parse_window("--window", arguments.window);
    std::vector<ComparableImage> images;
    for (const std::string& file : arguments.images)
        images.push_back(read_comparable(file, arguments.selection, part));
    std::vector<page::ViewSource> sources = named_sources(std::move(images));
    keep_channels(arguments.channels, sources);
    keep_window(arguments.window, sources);
    return sources;
}

ExitCode run_view(const ViewArguments& arguments) {
    if (arguments.images.size() > 2)
        throw UsageError(
            fmt::format("found {} images, expected one or two", arguments.images.size()));
    CommandFiles files;
    check_output_kinds({{"-o", ".html", arguments.output}});
    files.add_output("-o", arguments.output);
    files.check_writable();
    const std::vector<page::ViewSource> sources = read_sources(arguments);
    files.check();
    write_view(arguments.output, sources);
    return ExitCode::ok;
}

}  // namespace

void write_view(const std::filesystem::path& output, const std::vector<page::ViewSource>& sources) {
    check_values(sources);
    write_page(output, page::view_html(sources), "--channels and --window choose less");
}

void write_page(const std::filesystem::path& output, const std::string& page, const char* less) {
    const double size = static_cast<double>(page.size()) / mebibyte;
    if (page.size() > largest_page)
        throw UsageError(
            fmt::format("a page of {:.0f} MB, more than browsers take (256); {}", size, less));
    if (page.size() > large_page)
        say(fmt::format("quadrel: warning: a page of {:.0f} MB; {}", size, less));
    AtomicFile file(output);
    file.write(page.data(), page.size());
    file.commit();
    say_written(output);
}

std::vector<page::ViewSource> named_sources(std::vector<ComparableImage> images) {
    std::set<std::filesystem::path> names;
    for (const ComparableImage& image : images) names.insert(image.file.filename());
    std::vector<page::ViewSource> sources;
    for (ComparableImage& image : images) {
        const std::filesystem::path name =
            names.size() == images.size() ? image.file.filename() : image.file;
        sources.push_back({name.string(), std::move(image)});
    }
    return sources;
}

void add_view(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "view", "make an HTML page that shows every value of an image, or of two side by side");
    const auto a = std::make_shared<ViewArguments>();
    verb->add_option("images", a->images, "an image of any format, or two: reference and test")
        ->required();
    verb->add_option("-o,--output", a->output, "page to write, which needs nothing else")
        ->type_name("OUT.html")
        ->required();
    verb->add_option("--channels", a->channels, "these comma-separated channels and groups only");
    verb->add_option("--window", a->window,
                     "these pixels only: half-open, from the top-left of the frame")
        ->type_name("X0,Y0,X1,Y1");
    add_selection_options(*verb, a->selection, "", "every EXR");
    add_quiet_option(*verb);
    verb->callback([a, &action] { action = [a] { return run_view(*a); }; });
}

}  // namespace quadrel::cli
