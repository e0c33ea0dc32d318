// How long the stage functions take, on demand: a render without a clock reads no time.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

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

/// Where time is read.
struct TimeSource {
    std::uint64_t (*ticks)();  ///< in whatever unit; read around every stage, so it must be quick
    std::int64_t (*wall_ns)();
    std::int64_t (*cpu_ns)();  ///< of the calling thread
};

/// The processor's counter, 10 to 50 ns to read, and the system's clocks, up to 600.
TimeSource processor_time();

/// One thread's clock; it takes a hundredth of the time that the quickest picture takes.
///
/// Stages are timed in ticks, and what a tick is worth in time comes out at the end of each span,
/// over all of it: the system's clocks, which take as long as a short stage, are read twice a span,
/// and the counter needs no steady rate from one span to the next. CPU time is shared out by ticks,
/// too. Of a material's batches the first few are timed and then one in `period`, which the others
/// are taken to be like, lane by lane: these may run as if no one looked, several stages as one. So
/// what a thread had to wait for may be booked on one stage with too great a weight; each is as
/// likely to get it as it is long.
class StageClock {
  public:
    static constexpr std::uint64_t period = 7;  ///< prime: tiles have 16 batches, or 4, or 64

    explicit StageClock(const TimeSource& source = processor_time()) : source_(source) {}

    /// Begins a span of stages: a tile.
    void begin();
    /// Ends it and turns its ticks into time.
    void end();

    /// Before a batch of so many lanes: whether its stages are to be timed, by `start` and `lap`
    /// around each. `material` tells batches that run the same stages.
    bool begin_batch(const void* material, int lanes);
    /// Before a stage runs over a batch that is timed. `id` must live as long as the clock.
    void start(const char* id);
    /// After it.
    void lap(std::uint64_t fetches);

    /// Of the spans that have ended. Exact where all batches were timed.
    StageTimes times() const;

  private:
    struct Moment {
        std::uint64_t ticks = 0;
        std::int64_t wall_ns = 0, cpu_ns = 0;
    };
    struct Row {  ///< of batches that were timed
        const char* id;
        std::uint64_t runs = 0, lanes = 0, fetches = 0;
        std::uint64_t ticks = 0;  ///< of the span that is going on
        double wall_ns = 0, cpu_ns = 0;
    };
    struct Group {
        const void* material;
        std::uint64_t batches = 0, lanes = 0;
        std::uint64_t timed_batches = 0, timed_lanes = 0;
        std::vector<Row> rows;    ///< in the order of their first laps
        std::size_t current = 0;  ///< the row of the stage that was started last
    };

    Moment now() const { return {source_.ticks(), source_.wall_ns(), source_.cpu_ns()}; }
    static Row& find_row(Group& group, const char* id);

    TimeSource source_;
    Moment begin_;
    std::uint64_t start_ = 0;
    int lanes_ = 0;  ///< of the batch
    std::vector<Group> groups_;
    std::size_t current_ = 0;  ///< the group of the last batch
};

/// Adds what another thread measured.
void merge(StageTimes& into, const StageTimes& from);

}  // namespace quadrel
