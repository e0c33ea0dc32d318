// quadrel man: man pages.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/shell/manual.hpp"
#include "cli/verbs.hpp"
#include "file/atomic_file.hpp"
#include "file/output_group.hpp"
#include "text/suggest.hpp"

namespace quadrel::cli {
namespace {

struct ManArguments {
    std::string page, folder;
};

std::vector<ManualPage> all_pages() {
    Action none;
    return manual_pages(*make_program(none, VerbsAdded::all));
}

/// By the page's name, or by that of a verb.
ExitCode print_page(const std::string& name) {
    std::vector<std::string> names;
    for (const ManualPage& page : all_pages()) {
        if (page.name == name || page.name == "quadrel-" + name) {
            print_bytes(page.text);
            return ExitCode::ok;
        }
        names.push_back(page.name);
    }
    throw UsageError("found \"" + name + "\", expected " + one_of("quadrel-" + name, names) +
                     ", or the name of a verb alone");
}

ExitCode write_pages(const std::filesystem::path& folder) {
    const std::vector<ManualPage> pages = all_pages();
    CommandFiles files;
    std::vector<std::filesystem::path> names;
    for (const ManualPage& page : pages) {
        const std::string section = std::to_string(page.section);
        const std::filesystem::path into = folder / ("man" + section);
        std::error_code none;  // what is missing then is told by who writes
        std::filesystem::create_directories(into, none);
        names.push_back(into / (page.name + "." + section));
        files.add_output("-o", names.back());
    }
    files.check_writable();
    files.check();
    OutputGroup outputs;
    for (std::size_t i = 0; i < pages.size(); ++i) {
        AtomicFile file(names[i]);
        file.write(pages[i].text.data(), pages[i].text.size());
        file.commit();
    }
    outputs.commit();
    return ExitCode::ok;
}

ExitCode run_man(const ManArguments& arguments) {
    if (arguments.folder.empty()) return print_page(arguments.page);
    return write_pages(arguments.folder);
}

}  // namespace

void add_man(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("man", "print a man page, or write all of them");
    const auto a = std::make_shared<ManArguments>();
    a->page = "quadrel";
    const auto page =
        verb->add_option("page", a->page, "a verb, scene or channels; none: of the whole program");
    verb->add_option("-o,--output", a->folder,
                     "write all pages into this folder, as man1/quadrel.1")
        ->type_name("DIR")
        ->excludes(page);
    verb->callback([a, &action] { action = [a] { return run_man(*a); }; });
}

}  // namespace quadrel::cli
