// Work without the interpreter's lock. When the interpreter ends, threads that want its lock again
// are ended where they stand, which C++ does not survive: so its end waits for them.
#pragma once

#include <pybind11/pybind11.h>

namespace quadrel::python {

/// Counts a thread for which the interpreter's end waits. With the interpreter's lock.
class Awaited {
  public:
    Awaited();
    ~Awaited();
    Awaited(const Awaited&) = delete;
    Awaited& operator=(const Awaited&) = delete;
};

/// Without the interpreter's lock while it lives. Where the interpreter is ending it keeps it.
class Unlocked {
  public:
    Unlocked();
    ~Unlocked();
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

  private:
    PyThreadState* state_ = nullptr;
};

/// Throws SystemExit, which ends a thread in silence, where the interpreter is ending and this is
/// not the thread that ends it.
void stop_if_ending();

/// From now on the interpreter's end stops what runs, and waits for it.
void await_at_exit();

}  // namespace quadrel::python
