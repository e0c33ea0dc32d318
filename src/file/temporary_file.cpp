#include "file/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <set>

#include "quadrel/check.hpp"

namespace quadrel {

namespace {

constexpr std::string_view start = ".quadrel-", suffix = ".tmp";
constexpr std::size_t random_digits = 16;

/// FNV-1a.
std::uint32_t checksum(std::string_view text) {
    std::uint32_t sum = 2166136261u;
    for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 16777619u;
    return sum;
}

/// Letters, digits and '-' of the host's name, and the checksum of its machine id, if it has one.
std::string make_host() {
    char name[256] = {};
    if (gethostname(name, sizeof name - 1) != 0) name[0] = '\0';
    std::string host = std::string(name).substr(0, 40);
    const auto plain = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    std::replace_if(
        host.begin(), host.end(), [&](char c) { return !plain(c); }, '-');
    std::string machine;
    std::ifstream("/etc/machine-id") >> machine;
    return fmt::format("{}-{:08x}", host, checksum(machine));
}

const std::string& start_of_this_host() {
    static const std::string text = fmt::format("{}{}-", start, make_host());
    return text;
}

bool all_of(std::string_view text, std::string_view allowed) {
    return !text.empty() && text.find_first_not_of(allowed) == text.npos;
}

/// Closes what it holds.
struct Descriptor {
    explicit Descriptor(int value) : descriptor(value) {}
    ~Descriptor() {
        if (descriptor >= 0) close(descriptor);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int descriptor;
};

/// The lock is held until the name is gone: a writer that has just created the file, and has not
/// locked it yet, finds it locked or without its name, and takes another.
void remove_unless_locked(const std::filesystem::path& file) {
    struct stat status = {};
    if (lstat(file.c_str(), &status) != 0 || status.st_uid != geteuid()) return;
    const bool is_folder = S_ISDIR(status.st_mode);
    if (!is_folder && !S_ISREG(status.st_mode)) return;
    // Open for writing, which locks need on network file systems; folders cannot be.
    const int mode = is_folder ? O_RDONLY | O_DIRECTORY : O_RDWR;
    const Descriptor opened(open(file.c_str(), mode | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (opened.descriptor < 0 || try_lock(opened.descriptor) != Lock::held) return;
    // Its writer may have renamed it just before: then this is the output.
    if (!leads_to(file, opened.descriptor)) return;
    std::error_code ignored;
    std::filesystem::remove_all(file, ignored);
}

/// `descriptor` of what was made just now under `name`, locked; -1 with errno EEXIST, and the name
/// free again, where somebody else locks it or has removed it.
int locked(const std::filesystem::path& name, int descriptor) {
    if (descriptor >= 0 && try_lock(descriptor) != Lock::taken && leads_to(name, descriptor))
        return descriptor;
    if (descriptor >= 0) close(descriptor);
    std::remove(name.c_str());
    errno = EEXIST;
    return -1;
}

}  // namespace

std::string temporary_name() {
    std::uint64_t random = 0;
    const ssize_t size = getrandom(&random, sizeof random, 0);
    QUADREL_CHECK(size == ssize_t{sizeof random}, size);
    return fmt::format("{}{}-{:016x}{}", start_of_this_host(), getpid(), random, suffix);
}

bool is_temporary_of_this_host(std::string_view name) {
    if (!name.starts_with(start_of_this_host()) || !name.ends_with(suffix)) return false;
    name.remove_prefix(start_of_this_host().size());
    name.remove_suffix(std::min(name.size(), suffix.size()));
    const std::size_t dash = name.find('-');
    if (dash == name.npos) return false;
    const std::string_view process = name.substr(0, dash), random = name.substr(dash + 1);
    return all_of(process, "0123456789") && random.size() == random_digits &&
           all_of(random, "0123456789abcdef");
}

Lock try_lock(int descriptor) {
    int result = 0;
    do {
        result = flock(descriptor, LOCK_EX | LOCK_NB);
    } while (result != 0 && errno == EINTR);
    if (result == 0) return Lock::held;
    return errno == EWOULDBLOCK ? Lock::taken : Lock::unsupported;
}

bool leads_to(const std::filesystem::path& name, int descriptor) {
    struct stat named = {}, opened = {};
    return lstat(name.c_str(), &named) == 0 && fstat(descriptor, &opened) == 0 &&
           named.st_dev == opened.st_dev && named.st_ino == opened.st_ino;
}

int create_locked(const std::filesystem::path& name) {
    const int descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return descriptor < 0 ? -1 : locked(name, descriptor);
}

int create_locked_folder(const std::filesystem::path& name) {
    if (mkdir(name.c_str(), 0777) != 0) return -1;
    return locked(name, open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

void remove_abandoned(const std::filesystem::path& folder) {
    std::error_code error;
    for (std::filesystem::directory_iterator i(folder, error), end; !error && i != end;
         i.increment(error)) {
        if (is_temporary_of_this_host(i->path().filename().string()))
            remove_unless_locked(i->path());
    }
}

void remove_abandoned_once(const std::filesystem::path& folder) {
    static std::mutex mutex;
    static std::set<std::filesystem::path> done;
    {
        const std::lock_guard lock(mutex);
        if (!done.insert(folder).second) return;
    }
    remove_abandoned(folder);
}

}  // namespace quadrel
