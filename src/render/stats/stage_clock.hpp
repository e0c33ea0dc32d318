// How long the stage functions take, on demand: a render without a clock reads no time.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace quadrel {

/// What one stage took, summed over batches and threads.
struct StageTime {
    std::uint64_t batches = 0, lanes = 0;  ///< lanes: helper and padding lanes included
    std::uint64_t fetches = 0;             ///< texture look-ups
    std::int64_t wall_ns = 0;              ///< as the clock on the wall, summed over threads
    std::int64_t cpu_ns = 0;               ///< while the thread ran

    StageTime& operator+=(const StageTime& other);
};

/// By stage id.
using StageTimes = std::map<std::string, StageTime>;

/// The sum over stages.
StageTime total(const StageTimes& times);

/// One thread's clock. A lap costs about 0.3 us, a stage over a batch some 1 to 100 us.
class StageClock {
  public:
    void start();
    /// Books the time since the last lap, or start, on stage `id`.
    void lap(const char* id, int lanes, std::uint64_t fetches);
    const StageTimes& times() const { return times_; }

  private:
    struct Moment {
        std::int64_t wall_ns = 0, cpu_ns = 0;
    };
    static Moment now();

    Moment last_;
    StageTimes times_;
};

/// Adds what another thread measured.
void merge(StageTimes& into, const StageTimes& from);

}  // namespace quadrel
