// The temporary files of this process, readable from a signal handler.
#pragma once

namespace quadrel {

/// Remembers a path before the file is made. Returns its slot, or -1 when the path is too long or
/// no slot is free (the file is then not removed on a signal).
int register_temporary(const char* path);

/// Forgets the path of a slot; -1 does nothing.
void forget_temporary(int slot);

/// Removes every remembered file. Async-signal-safe.
void remove_temporaries();

/// Makes SIGINT, SIGTERM and SIGHUP remove the temporaries of unfinished outputs and end the
/// process with 128 + the signal's number (130, 143, 129); a closed pipe becomes a write error
/// instead of SIGPIPE. For programs; the library itself never calls it.
void install_signal_cleanup();

/// While one lives, such a signal waits; the last one's end obeys it.
class SignalHold {
  public:
    SignalHold();
    ~SignalHold();
    SignalHold(const SignalHold&) = delete;
    SignalHold& operator=(const SignalHold&) = delete;
};

}  // namespace quadrel
