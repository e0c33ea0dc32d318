// Long work that Python can stop: it runs on a thread of its own, without the interpreter's lock,
// while the calling thread looks for signals and calls Python's functions.
#pragma once

#include <pybind11/pybind11.h>

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>

namespace quadrel::python {

/// Ends work that nobody wants any more.
struct Interrupted : std::exception {
    const char* what() const noexcept override { return "interrupted"; }
};

/// Between the work and the thread that waits for it.
class Work {
  public:
    /// Of the work, on any thread: how much of it is done, 0 to 1. Throws Interrupted where it is
    /// to end.
    void report(double share);
    /// Of the work: the same without news, for parts whose share of the whole nobody knows.
    void stop_if_interrupted();

    /// Of the thread that waits, until the work has ended or a short time has passed: what was
    /// reported since the last call.
    std::optional<double> wait();
    void interrupt();
    void end();
    bool ended();

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<double> share_;
    bool interrupted_ = false, ended_ = false;
};

/// Runs `run` to its end. `progress` is None or is called with 0 to 1, on the calling thread, the
/// last time with 1. Throws what `run` threw; what `progress` raised and the KeyboardInterrupt of a
/// signal end the work before they are thrown.
void run_interruptibly(const pybind11::object& progress, const std::function<void(Work&)>& run);

}  // namespace quadrel::python
