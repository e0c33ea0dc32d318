#include "render/stats/stage_clock.hpp"

#include <algorithm>
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
    for (Group& group : groups_)
        for (Row& row : group.rows) {
            const double share = ticks > 0 ? static_cast<double>(row.ticks) / ticks : 0;
            row.wall_ns += share * wall;
            row.cpu_ns += share * cpu;
            row.ticks = 0;
        }
}

bool StageClock::begin_batch(const void* material, int lanes) {
    if (groups_.empty() || groups_[current_].material != material) {
        const auto found = std::ranges::find(groups_, material, &Group::material);
        current_ = static_cast<std::size_t>(found - groups_.begin());
        if (found == groups_.end()) groups_.push_back({.material = material, .rows = {}});
    }
    Group& group = groups_[current_];
    const bool is_timed = group.batches < period || group.batches % period == 0;
    ++group.batches;
    group.lanes += static_cast<std::uint64_t>(lanes);
    if (!is_timed) return false;
    ++group.timed_batches;
    group.timed_lanes += static_cast<std::uint64_t>(lanes);
    lanes_ = lanes;
    return true;
}

/// Batches of a material run the same stages in the same order: mostly the row after the last one.
StageClock::Row& StageClock::find_row(Group& group, const char* id) {
    for (std::size_t i = 1; i <= group.rows.size(); ++i) {
        const std::size_t candidate = (group.current + i) % group.rows.size();
        if (group.rows[candidate].id != id) continue;
        group.current = candidate;
        return group.rows[candidate];
    }
    group.current = group.rows.size();
    return group.rows.emplace_back(Row{.id = id});
}

void StageClock::start(const char* id) {
    find_row(groups_[current_], id);
    start_ = source_.ticks();
}

void StageClock::lap(std::uint64_t fetches) {
    Group& group = groups_[current_];
    Row& row = group.rows[group.current];
    row.ticks += elapsed(start_, source_.ticks());
    ++row.runs;
    row.lanes += static_cast<std::uint64_t>(lanes_);
    row.fetches += fetches;
}

StageTimes StageClock::times() const {
    StageTimes times;
    for (const Group& group : groups_) {
        const double by_batch = double(group.batches) / double(group.timed_batches);
        const double by_lane = double(group.lanes) / double(group.timed_lanes);
        const auto scaled = [](double factor, auto count) {
            return static_cast<std::uint64_t>(std::llround(factor * static_cast<double>(count)));
        };
        for (const Row& row : group.rows)
            times[row.id] += {scaled(by_batch, row.runs), scaled(by_lane, row.lanes),
                              scaled(by_lane, row.fetches), std::llround(by_lane * row.wall_ns),
                              std::llround(by_lane * row.cpu_ns)};
    }
    return times;
}

void merge(StageTimes& into, const StageTimes& from) {
    for (const auto& [id, time] : from) into[id] += time;
}

}  // namespace quadrel
