#include "cli/common/quiet.hpp"

#include <CLI/CLI.hpp>

#include "cli/common/console.hpp"

namespace quadrel::cli {
namespace {

bool quiet = false;

}  // namespace

void add_quiet_option(CLI::App& verb) {
    verb.add_flag("--quiet", quiet, "no notes, progress or names of what was written: for scripts");
}

bool is_quiet() { return quiet; }

void tell(std::string_view line) {
    if (!quiet) say(line);
}

}  // namespace quadrel::cli
