// The command line: parsing, and exceptions to exit codes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <new>
#include <string_view>

#include "cli/common/console.hpp"
#include "cli/common/examples.hpp"
#include "cli/common/usage.hpp"
#include "cli/explain/exit_codes.hpp"
#include "cli/verbs.hpp"
#include "file/temporary_registry.hpp"
#include "text/printable.hpp"

namespace quadrel::cli {
namespace {

/// Exactly one line.
int complain(std::string message, ExitCode code) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    constexpr std::size_t most = 6000;  // a path alone may have 4096
    say("quadrel: " + shortened(message, most));
    return static_cast<int>(code);
}

int run(const Action& action, const SpelledVerb& verb) {
    try {
        const ExitCode code = action();
        flush_output();
        return static_cast<int>(code);
    } catch (const UsageError& error) {
        return complain(with_help(error.what(), verb), ExitCode::usage);
    } catch (const InputError& error) {
        return complain(error.what(), ExitCode::input);
    } catch (const OutputError& error) {
        return complain(error.what(), ExitCode::output);
    } catch (const std::bad_alloc&) {
        return complain("out of memory", ExitCode::try_again);
    } catch (const std::exception& error) {
        return complain(std::string("unexpected: ") + error.what(), ExitCode::internal);
    }
}

struct Verb {
    std::string_view name;
    void (*add)(CLI::App&, Action&);
};

constexpr Verb verbs[] = {
    {"render", add_render}, {"compare", add_compare}, {"list", add_list},
    {"info", add_info},     {"probe", add_probe},     {"sheet", add_sheet},
    {"mips", add_mips},     {"bake", add_bake},       {"explain", add_explain},
    {"sweep", add_sweep},   {"advise", add_advise},   {"errors", add_errors},
    {"export", add_export}, {"view", add_view}};

/// All verbs, since help and a mistake name them; but where the command line begins with one, that
/// alone: to describe the options of all takes most of the time of starting.
void add_verbs(CLI::App& app, Action& action, const std::vector<std::string>& arguments) {
    const auto named = std::find_if(std::begin(verbs), std::end(verbs), [&](const Verb& verb) {
        return !arguments.empty() && verb.name == arguments.front();
    });
    const bool version = arguments == std::vector<std::string>{"--version"};
    if (named != std::end(verbs))
        named->add(app, action);
    else if (!version)
        for (const Verb& verb : verbs) verb.add(app, action);
    add_examples(app);
}

/// Parses, and returns what to do then: the verb, or to print help.
Action parse(CLI::App& app, const Action& action, const SpelledVerb& verb,
             const std::vector<std::string>& arguments) {
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::Success& success) {
        app.exit(success);
        return [] { return ExitCode::ok; };
    } catch (const CLI::ParseError& error) {
        refuse_empty_arguments(*verb.app);
        throw UsageError(usage_message(error, verb, arguments));
    }
    refuse_empty_arguments(*verb.app);
    return action;
}

int parse_and_run(int argc, char** argv) {
    CLI::App app("CPU reference rasterizer for relief mapping", "quadrel");
    app.set_version_flag("-V,--version", "quadrel " QUADREL_VERSION);
    app.require_subcommand(1);
    app.footer(exit_code_help());
    Action action;
    const std::vector<std::string> arguments =
        with_help_words({argv + std::min(argc, 1), argv + argc});
    add_verbs(app, action, arguments);
    const SpelledVerb verb = spelled_verb(app, arguments);
    if (verb.unknown) return complain(unknown_verb_message(verb), ExitCode::usage);
    return run([&] { return parse(app, action, verb, arguments)(); }, verb);
}

}  // namespace
}  // namespace quadrel::cli

int main(int argc, char** argv) {
    quadrel::cli::occupy_standard_descriptors();
    quadrel::install_signal_cleanup();
    return quadrel::cli::parse_and_run(argc, argv);
}
