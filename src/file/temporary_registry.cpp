#include "file/temporary_registry.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>

namespace quadrel {
namespace {

// A handler may run between any two instructions of any thread: plain arrays, each guarded by an
// atomic state, and no allocation or lock.
enum State : int { vacant, being_filled, filled };
struct Slot {
    std::atomic<int> state{vacant};
    char path[PATH_MAX] = {};
};
constexpr int slot_count = 64;
std::array<Slot, slot_count> slots;
static_assert(std::atomic<int>::is_always_lock_free);

// The number of holds, or less than 0 once a signal ends the process.
std::atomic<int> holds{0};
std::atomic<int> waiting{0};
constexpr int ending = INT_MIN / 2;

void clean_up_and_exit(int signal) {
    remove_temporaries();
    _exit(128 + signal);
}

void handle(int signal) {
    waiting.store(signal);
    int none = 0;
    if (holds.compare_exchange_strong(none, ending)) clean_up_and_exit(signal);
}

}  // namespace

int register_temporary(const char* path) {
    const std::size_t size = std::strlen(path) + 1;
    if (size > PATH_MAX) return -1;
    for (int i = 0; i < slot_count; ++i) {
        int expected = vacant;
        if (!slots[i].state.compare_exchange_strong(expected, being_filled)) continue;
        std::memcpy(slots[i].path, path, size);
        slots[i].state.store(filled);
        return i;
    }
    return -1;
}

void forget_temporary(int slot) {
    if (slot >= 0) slots[slot].state.store(vacant);
}

void remove_temporaries() {
    for (Slot& slot : slots)
        if (slot.state.load() == filled) unlink(slot.path);
}

SignalHold::SignalHold() {
    // Another thread removes the temporaries: there is nothing left to do.
    if (holds.fetch_add(1) < 0)
        while (true) pause();
}

SignalHold::~SignalHold() {
    if (holds.fetch_sub(1) > 1) return;
    if (const int signal = waiting.load(); signal != 0) clean_up_and_exit(signal);
}

void install_signal_cleanup() {
    struct sigaction action = {};
    action.sa_handler = handle;
    sigfillset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction old = {};
        // A signal that the parent had ignored (nohup) stays ignored.
        if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler == SIG_IGN) continue;
        sigaction(signal, &action, nullptr);
    }
    // Writing fails instead, and is reported: a pipe without a reader, a limit on file sizes.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace quadrel
