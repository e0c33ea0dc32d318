#include "interruption.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <mutex>
#include <set>
#include <system_error>
#include <thread>

namespace quadrel::peers {
namespace {

struct Folders {
    std::mutex mutex;
    std::set<std::filesystem::path> paths;
};

Folders& folders() {
    static Folders all;
    return all;
}

/// In a thread of its own, where everything may be called.
[[noreturn]] void obey(const sigset_t& signals) {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    const std::lock_guard lock(folders().mutex);  // until the end: no folder is made any more
    for (const std::filesystem::path& path : folders().paths) {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    _exit(128 + signal);
}

}  // namespace

void watch_for_interruption() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    // All threads inherit it, and none but the one below gets these signals.
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread([signals] { obey(signals); }).detach();
}

void remove_if_interrupted(const std::filesystem::path& folder) {
    const std::lock_guard lock(folders().mutex);
    folders().paths.insert(folder);
}

void forget_if_interrupted(const std::filesystem::path& folder) {
    const std::lock_guard lock(folders().mutex);
    folders().paths.erase(folder);
}

}  // namespace quadrel::peers
