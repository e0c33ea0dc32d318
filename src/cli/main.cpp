// The command line: parsing, and exceptions to exit codes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <new>

#include "cli/common/console.hpp"
#include "cli/common/usage.hpp"
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

/// All verbs, since help and a mistake name them; but where the command line begins with one, that
/// alone.
std::unique_ptr<CLI::App> program_for(const std::vector<std::string>& arguments, Action& action) {
    if (arguments == std::vector<std::string>{"--version"})
        return make_program(action, VerbsAdded::none);
    if (!arguments.empty() && is_verb(arguments.front()))
        return make_program(action, VerbsAdded::one, arguments.front());
    return make_program(action, VerbsAdded::all);
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
    refuse_empty_values(*verb.app, arguments);
    refuse_empty_arguments(*verb.app);
    return action;
}

int parse_and_run(int argc, char** argv) {
    Action action;
    const std::vector<std::string> arguments =
        with_joined_addresses(with_help_words({argv + std::min(argc, 1), argv + argc}));
    const std::unique_ptr<CLI::App> app = program_for(arguments, action);
    const SpelledVerb verb = spelled_verb(*app, arguments);
    if (verb.unknown) return complain(unknown_verb_message(verb), ExitCode::usage);
    return run([&] { return parse(*app, action, verb, arguments)(); }, verb);
}

}  // namespace
}  // namespace quadrel::cli

int main(int argc, char** argv) {
    quadrel::cli::occupy_standard_descriptors();
    quadrel::install_signal_cleanup();
    return quadrel::cli::parse_and_run(argc, argv);
}
