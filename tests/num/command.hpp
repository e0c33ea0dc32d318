// Runs a command and gives what it printed.
#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>

namespace quadrel::num_tests {

/// Throws std::runtime_error when the command cannot be run or fails.
inline std::string output_of(const std::string& command) {
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
    std::string output;
    char buffer[4096];
    while (const std::size_t count = fread(buffer, 1, sizeof buffer, pipe)) {
        output.append(buffer, count);
    }
    if (pclose(pipe) != 0) throw std::runtime_error(command + " failed");
    return output;
}

}  // namespace quadrel::num_tests
