// Running a program of the build by a shell.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace quadrel::tools_tests {

struct Outcome {
    int code = -1;  ///< exit code, or 1000 where a signal ended it
    std::string out;
};

/// Runs `command` to its end; `out` is its standard output.
inline Outcome run_command(const std::string& command) {
    Outcome outcome;
    FILE* const pipe = popen(command.c_str(), "r");
    char bytes[4096];
    for (std::size_t got; (got = fread(bytes, 1, sizeof bytes, pipe)) > 0;)
        outcome.out.append(bytes, got);
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 1000;
    return outcome;
}

}  // namespace quadrel::tools_tests
