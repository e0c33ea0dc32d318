#include "cli/common/plugins.hpp"

#include <CLI/CLI.hpp>

#include "quadrel/relief/registry.hpp"

namespace quadrel::cli {

void add_plugin_option(CLI::App& verb, std::vector<std::string>& files) {
    verb.add_option("--plugin", files,
                    "load stages built by quadrel_add_stages; scenes name them by id; repeatable")
        ->type_name("FILE")
        ->allow_extra_args(false);
}

void load_plugins(const std::vector<std::string>& files) {
    for (const std::string& file : files) load_plugin(file);
}

}  // namespace quadrel::cli
