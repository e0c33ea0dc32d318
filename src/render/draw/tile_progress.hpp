// How far drawing is.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>

namespace quadrel {

/// Tells who asked how much is done; by any thread.
class TileProgress {
  public:
    TileProgress(const std::function<void(double)>& report, std::size_t total)
        : report_(report), total_(total) {}

    void advance() {
        if (!report_) return;
        const std::lock_guard lock(mutex_);
        report_(static_cast<double>(++done_) / static_cast<double>(total_));
    }

  private:
    const std::function<void(double)>& report_;
    std::size_t total_, done_ = 0;
    std::mutex mutex_;
};

}  // namespace quadrel
