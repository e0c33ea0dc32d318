// Waiting until a started program is one that signals can end in an orderly way.
#pragma once

#include <chrono>
#include <fstream>
#include <sstream>

#include "cli/process.hpp"

namespace quadrel::cli_tests {

using Clock = std::chrono::steady_clock;

/// Whether the process handles SIGTERM by now: before, every program dies of it without a trace.
inline bool handles_signals(pid_t process) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);) {
        if (line.compare(0, 7, "SigCgt:") != 0) continue;
        std::uint64_t caught = 0;
        std::istringstream(line.substr(7)) >> std::hex >> caught;
        return (caught >> (SIGTERM - 1) & 1) != 0;
    }
    return false;
}

inline void wait_for_handlers(pid_t process) {
    while (!handles_signals(process)) {
        siginfo_t ended{};
        waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOHANG | WNOWAIT);
        if (ended.si_pid == process) return;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

}  // namespace quadrel::cli_tests
