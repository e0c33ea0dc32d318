#include "cli/common/selection_options.hpp"

#include <CLI/CLI.hpp>

namespace quadrel::cli {

void add_selection_options(CLI::App& verb, ImageSelection& selection, const std::string& prefix,
                           const std::string& what) {
    verb.add_option("--" + prefix + "layer", selection.layer, "layer of " + what)
        ->type_name("NAME");
    verb.add_option("--" + prefix + "part", selection.part, "part of " + what + " with several")
        ->type_name("NAME|NUMBER");
}

}  // namespace quadrel::cli
