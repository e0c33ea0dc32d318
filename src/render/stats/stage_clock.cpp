#include "render/stats/stage_clock.hpp"

#include <cmath>
#include <ctime>

namespace quadrel {
namespace {

template <clockid_t clock>
std::int64_t nanoseconds() {
    timespec time{};
    clock_gettime(clock, &time);
    return std::int64_t(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

std::uint64_t processor_ticks() {
#if defined(__x86_64__) || defined(__i386__)
    return __builtin_ia32_rdtsc();
#elif defined(__aarch64__)
    std::uint64_t ticks = 0;
    asm volatile("mrs %0, cntvct_el0" : "=r"(ticks));
    return ticks;
#else
    return static_cast<std::uint64_t>(nanoseconds<CLOCK_MONOTONIC>());
#endif
}

/// From one reading to the next. The counters of two processors need not agree: a thread that moved
/// may find the later reading the smaller.
std::uint64_t elapsed(std::uint64_t from, std::uint64_t to) { return to > from ? to - from : 0; }

}  // namespace

StageTime& StageTime::operator+=(const StageTime& other) {
    batches += other.batches;
    lanes += other.lanes;
    fetches += other.fetches;
    wall_ns += other.wall_ns;
    cpu_ns += other.cpu_ns;
    return *this;
}

StageTime total(const StageTimes& times) {
    StageTime sum;
    for (const auto& [id, time] : times) sum += time;
    return sum;
}

TimeSource processor_time() {
    return {processor_ticks, nanoseconds<CLOCK_MONOTONIC>, nanoseconds<CLOCK_THREAD_CPUTIME_ID>};
}

void StageClock::begin() { begin_ = now(); }

void StageClock::end() {
    const Moment moment = now();
    const auto ticks = static_cast<double>(elapsed(begin_.ticks, moment.ticks));
    const double wall = static_cast<double>(moment.wall_ns - begin_.wall_ns);
    const double cpu = static_cast<double>(moment.cpu_ns - begin_.cpu_ns);
    for (Row& row : rows_) {
        const double share = ticks > 0 ? static_cast<double>(row.ticks) / ticks : 0;
        row.wall_ns += share * wall;
        row.cpu_ns += share * cpu;
        row.ticks = 0;
    }
}

/// Batches of a material run the same stages in the same order: mostly the row after the last one.
std::size_t StageClock::find_row(const char* id) {
    for (std::size_t i = 1; i <= rows_.size(); ++i) {
        const std::size_t candidate = (current_ + i) % rows_.size();
        if (rows_[candidate].id == id) return candidate;
    }
    rows_.push_back({id});
    return rows_.size() - 1;
}

void StageClock::start(const char* id) {
    current_ = find_row(id);
    if (rows_[current_].is_timed()) start_ = source_.ticks();
}

void StageClock::lap(int lanes, std::uint64_t fetches) {
    Row& row = rows_[current_];
    if (row.is_timed()) {
        row.ticks += elapsed(start_, source_.ticks());
        ++row.timed;
    }
    ++row.batches;
    row.lanes += static_cast<std::uint64_t>(lanes);
    row.fetches += fetches;
}

StageTimes StageClock::times() const {
    StageTimes times;
    for (const Row& row : rows_) {
        const double weight = static_cast<double>(row.batches) / static_cast<double>(row.timed);
        times[row.id] += {row.batches, row.lanes, row.fetches, std::llround(weight * row.wall_ns),
                          std::llround(weight * row.cpu_ns)};
    }
    return times;
}

void merge(StageTimes& into, const StageTimes& from) {
    for (const auto& [id, time] : from) into[id] += time;
}

}  // namespace quadrel
