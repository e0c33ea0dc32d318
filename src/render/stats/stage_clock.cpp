#include "render/stats/stage_clock.hpp"

#include <ctime>

namespace quadrel {
namespace {

std::int64_t nanoseconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return std::int64_t(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
}

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

StageClock::Moment StageClock::now() {
    return {nanoseconds(CLOCK_MONOTONIC), nanoseconds(CLOCK_THREAD_CPUTIME_ID)};
}

void StageClock::start() { last_ = now(); }

void StageClock::lap(const char* id, int lanes, std::uint64_t fetches) {
    const Moment moment = now();
    times_[id] += {1, static_cast<std::uint64_t>(lanes), fetches, moment.wall_ns - last_.wall_ns,
                   moment.cpu_ns - last_.cpu_ns};
    last_ = now();  // without the booking itself
}

void merge(StageTimes& into, const StageTimes& from) {
    for (const auto& [id, time] : from) into[id] += time;
}

}  // namespace quadrel
