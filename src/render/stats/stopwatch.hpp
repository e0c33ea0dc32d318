// Times of phases.
#pragma once

#include <chrono>
#include <ctime>

#include "quadrel/stats.hpp"

namespace quadrel {

class Stopwatch {
  public:
    /// Time since the last lap, or the beginning.
    PhaseTime lap() {
        const PhaseTime now = so_far();
        const PhaseTime lap{now.wall_ms - last_.wall_ms, now.cpu_ms - last_.cpu_ms};
        last_ = now;
        return lap;
    }

  private:
    static PhaseTime so_far() {
        const std::chrono::duration<double, std::milli> wall =
            std::chrono::steady_clock::now().time_since_epoch();
        timespec cpu{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
        return {wall.count(),
                1e3 * static_cast<double>(cpu.tv_sec) + 1e-6 * static_cast<double>(cpu.tv_nsec)};
    }

    PhaseTime last_ = so_far();
};

}  // namespace quadrel
