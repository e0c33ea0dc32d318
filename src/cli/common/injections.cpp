#include "cli/common/injections.hpp"

#include <CLI/CLI.hpp>
#include <map>

#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli {

void add_inject_option(CLI::App& verb, std::vector<std::string>& options) {
    verb.add_option("--inject", options,
                    "channels of an EXR take the place of what a stage stores, before later stages "
                    "read it, as hit.uv=gpu.exr; repeatable")
        ->type_name("NAME=FILE")
        ->allow_extra_args(false);
}

std::vector<Injection> read_injections(const std::vector<std::string>& options) {
    std::map<std::string, std::shared_ptr<const Film>> images;
    std::vector<Injection> injections;
    for (const std::string& option : options) {
        const std::size_t equals = option.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == option.size())
            throw UsageError("--inject: found \"" + option +
                             "\", expected NAME=FILE, as hit.uv=gpu.exr");
        const std::string file = option.substr(equals + 1);
        std::shared_ptr<const Film>& image = images[file];
        if (!image) image = std::make_shared<const Film>(read_exr(file).film);
        injections.push_back({option.substr(0, equals), image, file});
    }
    return injections;
}

}  // namespace quadrel::cli
