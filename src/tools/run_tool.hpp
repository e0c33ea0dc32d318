// What the programs beside the command line have in common: a command line that is read, errors as
// one line, and exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <iostream>

#include "quadrel/error.hpp"

namespace quadrel {

/// Parses, then runs: `run()` says whether all is well. Its errors are said on standard error,
/// after the program's name. What a system or a driver refuses counts as bad input.
template <class Run>
int run_tool(CLI::App& app, int argc, char** argv, const Run& run) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
    }
    const auto fail = [&](const std::exception& error, ExitCode code) {
        std::cerr << app.get_name() << ": " << error.what() << '\n';
        return static_cast<int>(code);
    };
    try {
        return static_cast<int>(run() ? ExitCode::ok : ExitCode::difference);
    } catch (const UsageError& error) {
        return fail(error, ExitCode::usage);
    } catch (const OutputError& error) {
        return fail(error, ExitCode::output);
    } catch (const std::runtime_error& error) {
        return fail(error, ExitCode::input);
    } catch (const std::exception& error) {
        return fail(error, ExitCode::internal);
    }
}

}  // namespace quadrel
