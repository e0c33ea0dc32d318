// Counts finished work and tells it, one call at a time and at most a thousand times; and ends work
// that takes too long.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>
#include <utility>

#include "quadrel/bake/bake.hpp"

namespace quadrel {

class Progress {
  public:
    /// The time counts from here.
    Progress(std::function<void(double)> tell, double seconds_limit)
        : tell_(std::move(tell)), start_(Clock::now()), limit_(seconds_limit) {}

    /// Adds a part of the whole, and checks the time.
    void add(double part) {
        {
            const std::lock_guard lock(mutex_);
            done_ = std::min(done_ + part, 1.0);
            if (tell_ && done_ - told_ >= 1e-3) {
                told_ = done_;
                tell_(done_);
            }
        }
        check_time();
    }

    /// Throws BakeStopped once the time is over; to be called where work goes on for long.
    void check_time() {
        if (std::chrono::duration<double>(Clock::now() - start_).count() < limit_) return;
        const std::lock_guard lock(mutex_);
        constexpr double all = 1 - 1e-9;
        if (done_ < all) throw BakeStopped(done_);
    }

    /// Tells that all is done.
    void finish() {
        if (tell_) tell_(1.0);
    }

  private:
    using Clock = std::chrono::steady_clock;

    std::function<void(double)> tell_;
    Clock::time_point start_;
    double limit_;
    std::mutex mutex_;
    double done_ = 0, told_ = 0;
};

}  // namespace quadrel
