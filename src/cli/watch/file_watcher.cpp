#include "cli/watch/file_watcher.hpp"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace quadrel::cli {
namespace {

constexpr std::uint32_t events =
    IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_CREATE;
constexpr int quiet_ms = 50;

[[noreturn]] void fail(const char* what) {
    throw std::system_error(errno, std::generic_category(), what);
}

/// Whether something is there to be read within the time; -1: however long it takes.
bool wait_for_events(int queue, int milliseconds) {
    pollfd state{queue, POLLIN, 0};
    while (true) {
        const int ready = poll(&state, 1, milliseconds);
        if (ready >= 0) return ready == 1;
        if (errno != EINTR) fail("waiting for changes");
    }
}

}  // namespace

FileWatcher::FileWatcher() : queue_(inotify_init1(IN_CLOEXEC)) {
    if (queue_ < 0) fail("watching files");
}

FileWatcher::~FileWatcher() { close(queue_); }

void FileWatcher::add(const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) {
        const std::filesystem::path folder =
            file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
        const int watch = inotify_add_watch(queue_, folder.c_str(), events);
        if (watch >= 0)
            names_[watch][file.filename().string()] = file;
        else if (errno == ENOSPC || errno == ENOMEM)
            fail("watching files");
    }
}

std::set<std::filesystem::path> FileWatcher::wait() {
    std::set<std::filesystem::path> changed;
    while (changed.empty()) {
        wait_for_events(queue_, -1);
        do read_events(changed);
        while (wait_for_events(queue_, quiet_ms));
    }
    return changed;
}

void FileWatcher::read_events(std::set<std::filesystem::path>& changed) {
    alignas(inotify_event) std::array<char, 65536> buffer;
    const ssize_t size = read(queue_, buffer.data(), buffer.size());
    if (size < 0 && errno != EINTR) fail("reading changes");
    for (ssize_t at = 0; at < size;) {
        inotify_event event;
        std::memcpy(&event, buffer.data() + at, sizeof event);
        const char* const name = buffer.data() + at + sizeof event;
        const auto watch = names_.find(event.wd);
        if (event.len > 0 && watch != names_.end()) {
            const auto file = watch->second.find(name);
            if (file != watch->second.end()) changed.insert(file->second);
        }
        at += static_cast<ssize_t>(sizeof event + event.len);
    }
}

}  // namespace quadrel::cli
