// Errors of loops that run in parallel.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>

namespace quadrel {

/// Keeps the error that the loop would have met first if it ran in order: what is reported does not
/// depend on threads.
class FirstError {
  public:
    /// Runs step `i` unless an earlier one has failed. May be called from any thread.
    template <class Step>
    void run(std::size_t i, const Step& step) {
        if (i > index_.load(std::memory_order_relaxed)) return;
        try {
            step();
        } catch (...) {
            keep(i, std::current_exception());
        }
    }

    /// Once all steps are through.
    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

  private:
    void keep(std::size_t i, std::exception_ptr error) {
        const std::lock_guard lock(mutex_);
        if (i >= index_) return;
        index_ = i;
        error_ = std::move(error);
    }

    std::atomic<std::size_t> index_{std::numeric_limits<std::size_t>::max()};
    std::exception_ptr error_;
    std::mutex mutex_;
};

}  // namespace quadrel
