// Which processors the program may use, and the least of what was measured in turns.
#pragma once

#include <algorithm>
#include <limits>

#include "picture.hpp"
#include "support/clock.hpp"

namespace quadrel::peers {

/// The least wall and CPU time of several frames.
class LeastTime {
  public:
    void add(const Time& time) {
        least_.wall = std::min(least_.wall, time.wall);
        least_.cpu = std::min(least_.cpu, time.cpu);
    }
    /// CPU time of one thread, which holds no waiting; wall time of several.
    double of(int threads) const { return threads == 1 ? least_.cpu : least_.wall; }
    const Time& value() const { return least_; }

  private:
    Time least_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};

/// Milliseconds that `work` takes; CPU time of the whole process.
template <class Work>
Time time_of(const Work& work) {
    const double wall = bench::seconds(CLOCK_MONOTONIC);
    const double cpu = bench::timed(CLOCK_PROCESS_CPUTIME_ID, work);
    return {1e3 * (bench::seconds(CLOCK_MONOTONIC) - wall), 1e3 * cpu};
}

/// Keeps the calling thread, and those that it makes from now on, to the first `count` of the
/// processors that the process could use at first.
void keep_to(int count);

/// How many processors the process could use at first.
int processors();

}  // namespace quadrel::peers
