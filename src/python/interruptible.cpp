#include "python/interruptible.hpp"

#include <chrono>
#include <thread>

#include "python/unlocked.hpp"

namespace quadrel::python {
namespace {

namespace py = pybind11;

/// How long a signal may wait.
constexpr std::chrono::milliseconds patience{50};

/// What Python has to be told and asked, with its lock.
void attend(const py::object& progress, std::optional<double> share) {
    if (share && !progress.is_none()) progress(*share);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    stop_if_ending();
}

/// Waits for the work's end, and returns what Python raised meanwhile.
std::exception_ptr attend_until_end(const py::object& progress, Work& work) {
    std::exception_ptr raised;
    for (bool ended = false; !ended;) {
        std::optional<double> share;
        {
            const py::gil_scoped_release release;
            share = work.wait();
            ended = work.ended();
        }
        if (raised) continue;
        try {
            attend(progress, share);
        } catch (...) {
            raised = std::current_exception();
            work.interrupt();
        }
    }
    return raised;
}

}  // namespace

void Work::report(double share) {
    const std::lock_guard lock(mutex_);
    if (interrupted_) throw Interrupted();
    share_ = share;
}

void Work::stop_if_interrupted() {
    const std::lock_guard lock(mutex_);
    if (interrupted_) throw Interrupted();
}

std::optional<double> Work::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, patience, [this] { return ended_; });
    return std::exchange(share_, std::nullopt);
}

void Work::interrupt() {
    const std::lock_guard lock(mutex_);
    interrupted_ = true;
}

void Work::end() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
}

bool Work::ended() {
    const std::lock_guard lock(mutex_);
    return ended_;
}

void run_interruptibly(const py::object& progress, const std::function<void(Work&)>& run) {
    stop_if_ending();
    const Awaited awaited;
    Work work;
    std::exception_ptr failed;
    std::thread thread([&] {
        try {
            run(work);
        } catch (...) {
            failed = std::current_exception();
        }
        work.end();
    });
    const std::exception_ptr raised = attend_until_end(progress, work);
    {
        const py::gil_scoped_release release;
        thread.join();
    }
    if (raised) std::rethrow_exception(raised);
    if (failed) std::rethrow_exception(failed);
    if (!progress.is_none()) progress(1.0);
}

}  // namespace quadrel::python
