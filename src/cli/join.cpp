// quadrel join: parts that render --task has drawn, as one image.
#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/command_files.hpp"
#include "cli/common/compression_option.hpp"
#include "cli/common/console.hpp"
#include "cli/common/hints.hpp"
#include "cli/common/quiet.hpp"
#include "cli/verbs.hpp"
#include "io/parts/join.hpp"

namespace quadrel::cli {
namespace {

struct JoinArguments {
    std::vector<std::string> parts;
    std::string output;
    ExrCompression compression = ExrCompression::zip;
    bool compression_given = false;
};

ExitCode run_join(const JoinArguments& arguments) {
    CommandFiles files;
    files.add_output("-o", arguments.output);
    files.check_writable();
    check_output_kinds({{"-o", ".exr", arguments.output}});
    const JoinedParts parts({arguments.parts.begin(), arguments.parts.end()});
    files.check();
    ProgressBar bar;
    parts.write(arguments.output,
                arguments.compression_given ? arguments.compression : parts.compression(),
                [&bar](double share) { bar.show(share); });
    bar.clear();
    say_written(arguments.output);
    return ExitCode::ok;
}

}  // namespace

void add_join(CLI::App& app, Action& action) {
    CLI::App* verb =
        app.add_subcommand("join", "put the parts that render --task has drawn together");
    const auto a = std::make_shared<JoinArguments>();
    verb->add_option("parts", a->parts, "all parts of one image, in any order")->required();
    verb->add_option("-o,--output", a->output, "EXR to write, as the render of the whole would")
        ->type_name("OUT.exr")
        ->required();
    add_compression_option(*verb, a->compression);
    verb->get_option("--compression")->default_str("that of the parts");
    add_quiet_option(*verb);
    verb->callback([a, verb, &action] {
        a->compression_given = verb->count("--compression") > 0;
        action = [a] { return run_join(*a); };
    });
}

}  // namespace quadrel::cli
