// quadrel sheet: several renders on one picture to look at.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/console.hpp"
#include "cli/verbs.hpp"
#include "io/atomic_file.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel::cli {
namespace {

struct Arguments {
    std::vector<std::string> files;
    std::string output;
    int columns = 4;
};

ExitCode run_sheet(const Arguments& arguments) {
    check_writable(arguments.output);
    std::vector<SheetEntry> entries;
    for (const std::string& file : arguments.files)
        entries.push_back(
            {std::filesystem::path(file).stem().string(), preview(read_exr(file).film)});
    write_png(arguments.output, contact_sheet(entries, arguments.columns));
    fmt::print(stderr, "{}\n",
               std::filesystem::absolute(arguments.output).lexically_normal().string());
    return ExitCode::ok;
}

}  // namespace

void add_sheet(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("sheet", "put EXR images on one labelled PNG");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("files", a->files, "EXR images, row by row")->required();
    verb->add_option("-o,--output", a->output, "PNG to write")->required();
    verb->add_option("--columns", a->columns, "images in a row")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    verb->callback([a, &action] { action = [a] { return run_sheet(*a); }; });
}

}  // namespace quadrel::cli
