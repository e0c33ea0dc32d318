#include "python/unlocked.hpp"

#include <atomic>
#include <chrono>
#include <thread>

namespace quadrel::python {
namespace {

namespace py = pybind11;

std::atomic<int> awaited{0};
/// The thread that ends the interpreter; none until then.
std::atomic<std::thread::id> ending{};

bool others_end_it() {
    const std::thread::id thread = ending;
    return thread != std::thread::id() && thread != std::this_thread::get_id();
}

/// Once it holds the lock again nobody is within this module.
void end_all() {
    constexpr std::chrono::milliseconds pause{2};
    ending = std::this_thread::get_id();
    const py::gil_scoped_release release;
    while (awaited > 0) std::this_thread::sleep_for(pause);
}

}  // namespace

Awaited::Awaited() { ++awaited; }

Awaited::~Awaited() { --awaited; }

Unlocked::Unlocked() {
    if (others_end_it()) return;
    ++awaited;
    state_ = PyEval_SaveThread();
}

Unlocked::~Unlocked() {
    if (state_ == nullptr) return;
    PyEval_RestoreThread(state_);
    --awaited;
}

void stop_if_ending() {
    if (!others_end_it()) return;
    PyErr_SetNone(PyExc_SystemExit);
    throw py::error_already_set();
}

void await_at_exit() {
    py::module_::import("atexit").attr("register")(py::cpp_function(end_all));
    // The child of a fork has none of the other threads.
    py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") =
                                                           py::cpp_function([] { awaited = 0; }));
}

}  // namespace quadrel::python
