// Counts finished work and tells it, one call at a time and at most a thousand times.
#pragma once

#include <algorithm>
#include <functional>
#include <mutex>
#include <utility>

namespace quadrel {

class Progress {
  public:
    explicit Progress(std::function<void(double)> tell) : tell_(std::move(tell)) {}

    /// Adds a part of the whole.
    void add(double part) {
        if (!tell_) return;
        const std::lock_guard lock(mutex_);
        done_ = std::min(done_ + part, 1.0);
        if (done_ - told_ < 1e-3) return;
        told_ = done_;
        tell_(done_);
    }

    /// Tells that all is done.
    void finish() {
        if (tell_) tell_(1.0);
    }

  private:
    std::function<void(double)> tell_;
    std::mutex mutex_;
    double done_ = 0, told_ = 0;
};

}  // namespace quadrel
