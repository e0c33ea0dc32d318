// Clocks, and what repeated measurements on a shared machine come down to.
#pragma once

#include <algorithm>
#include <ctime>
#include <limits>

namespace quadrel::bench {

inline double seconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Seconds that `work` takes on `clock`.
template <class Work>
double timed(clockid_t clock, const Work& work) {
    const double start = seconds(clock);
    work();
    return seconds(clock) - start;
}

/// The least of what it was given: what other programs add is never negative.
class Least {
  public:
    void add(double value) { value_ = std::min(value_, value); }
    double value() const { return value_; }

  private:
    double value_ = std::numeric_limits<double>::infinity();
};

}  // namespace quadrel::bench
