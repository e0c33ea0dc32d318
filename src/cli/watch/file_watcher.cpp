#include "cli/watch/file_watcher.hpp"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>

namespace quadrel::cli {
namespace {

constexpr std::uint32_t events =
    IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_CREATE;
constexpr std::chrono::milliseconds quiet(50);

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

/// What has been created is empty yet, and will be written, unless it is a link or a folder.
bool is_whole(const inotify_event& event, const std::filesystem::path& place) {
    if ((event.mask & IN_CREATE) == 0 || (event.mask & IN_ISDIR) != 0) return true;
    struct stat status = {};
    return lstat(place.c_str(), &status) == 0 && (S_ISLNK(status.st_mode) || status.st_nlink > 1);
}

}  // namespace

FileWatcher::FileWatcher() : queue_(inotify_init1(IN_CLOEXEC)) {
    if (queue_ < 0) fail("watching files");
}

FileWatcher::~FileWatcher() { close(queue_); }

void FileWatcher::add(const std::vector<std::filesystem::path>& files) {
    for (const std::filesystem::path& file : files) {
        add_path(file, file);
        // What a link leads to changes in a folder of its own.
        std::error_code none;
        const auto target = std::filesystem::canonical(file, none);
        if (!none && target != std::filesystem::absolute(file, none)) add_path(target, file);
    }
}

/// Its name in its folder, and the folder's in the one above, since that may be replaced, too.
void FileWatcher::add_path(std::filesystem::path place, const std::filesystem::path& file) {
    while (place.has_filename()) {
        const std::filesystem::path folder =
            place.has_parent_path() ? place.parent_path() : std::filesystem::path(".");
        const int watch = inotify_add_watch(queue_, folder.c_str(), events);
        if (watch >= 0) {
            folders_[watch].place = folder;
            folders_[watch].files[place.filename().string()].insert(file);
        } else if (errno == ENOSPC || errno == ENOMEM) {
            fail("watching files");
        }
        place = place.parent_path();
    }
}

std::set<std::filesystem::path> FileWatcher::wait() {
    using Clock = std::chrono::steady_clock;
    std::set<std::filesystem::path> changed;
    while (changed.empty()) {
        wait_for_events(queue_, -1);
        read_events(changed);
    }
    // Others in the folder may be written all the time.
    auto until = Clock::now() + quiet;
    for (auto now = Clock::now(); now < until; now = Clock::now()) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - now);
        if (!wait_for_events(queue_, static_cast<int>(left.count()))) break;
        if (read_events(changed)) until = Clock::now() + quiet;
    }
    return changed;
}

bool FileWatcher::read_events(std::set<std::filesystem::path>& changed) {
    alignas(inotify_event) std::array<char, 65536> buffer;
    const ssize_t size = read(queue_, buffer.data(), buffer.size());
    if (size < 0 && errno != EINTR) fail("reading changes");
    bool any = false;
    for (ssize_t at = 0; at < size;) {
        inotify_event event;
        std::memcpy(&event, buffer.data() + at, sizeof event);
        const char* const name = buffer.data() + at + sizeof event;
        const auto folder = folders_.find(event.wd);
        if ((event.mask & IN_Q_OVERFLOW) != 0) {
            add_all(changed);
            any = true;
        } else if (event.len > 0 && folder != folders_.end() &&
                   is_whole(event, folder->second.place / name)) {
            const auto files = folder->second.files.find(name);
            if (files != folder->second.files.end()) {
                changed.insert(files->second.begin(), files->second.end());
                any = true;
            }
        }
        at += static_cast<ssize_t>(sizeof event + event.len);
    }
    return any;
}

void FileWatcher::add_all(std::set<std::filesystem::path>& changed) const {
    for (const auto& [watch, folder] : folders_)
        for (const auto& [name, files] : folder.files) changed.insert(files.begin(), files.end());
}

}  // namespace quadrel::cli
