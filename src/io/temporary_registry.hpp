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

}  // namespace quadrel
