// Running the built executable with standard error on a terminal.
#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <string>

#include "cli/process.hpp"

namespace quadrel::cli_tests {

/// As run(); `err` is what came out of the terminal.
inline Outcome run_on_terminal(const std::vector<std::string>& arguments,
                               const std::filesystem::path& folder) {
    const int master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    Outcome outcome;
    if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) return outcome;
    const std::string slave = ptsname(master);
    const pid_t child = fork();
    if (child == 0) {
        dup2(open(slave.c_str(), O_RDWR | O_NOCTTY), STDERR_FILENO);
        dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
        become_quadrel(arguments, folder);
    }
    const int kept = open(slave.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);  // or its end loses text
    outcome.code = wait_for(child);
    fcntl(master, F_SETFL, O_NONBLOCK);
    char buffer[4096];
    for (ssize_t n; (n = read(master, buffer, sizeof buffer)) > 0;)
        outcome.err.append(buffer, static_cast<std::size_t>(n));
    close(kept);
    close(master);
    return outcome;
}

}  // namespace quadrel::cli_tests
