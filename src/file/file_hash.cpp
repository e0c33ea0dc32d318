#include "file/file_hash.hpp"

#include <sys/stat.h>

#include <ctime>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "file/read_file.hpp"
#include "text/hash.hpp"

namespace quadrel {

namespace {

using Time = std::pair<std::time_t, long>;

/// What changes when a file is written.
struct FileState {
    dev_t device;
    ino_t inode;
    off_t size;
    Time modified, changed;

    bool operator==(const FileState&) const = default;
};

std::optional<FileState> state_of(const std::filesystem::path& file) {
    struct stat status = {};
    if (stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return FileState{status.st_dev,
                     status.st_ino,
                     status.st_size,
                     {status.st_mtim.tv_sec, status.st_mtim.tv_nsec},
                     {status.st_ctim.tv_sec, status.st_ctim.tv_nsec}};
}

/// Whether a later change would show: of two changes within a tick of the file system's clock the
/// second does not. Where that counts seconds, times have no fraction.
bool is_settled(const FileState& state) {
    constexpr double tick = 0.1, coarse_tick = 2;  // more than any file system's
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    const auto [seconds, nanoseconds] = state.changed;
    const double age = static_cast<double>(now.tv_sec - seconds) +
                       1e-9 * static_cast<double>(now.tv_nsec - nanoseconds);
    return age > (nanoseconds == 0 ? coarse_tick : tick);
}

class KnownHashes {
  public:
    std::optional<std::string> find(const std::string& name, const FileState& state) {
        const std::lock_guard lock(mutex_);
        const auto found = known_.find(name);
        if (found == known_.end() || found->second.first != state) return std::nullopt;
        return found->second.second;
    }

    void keep(const std::string& name, const FileState& state, const std::string& hash) {
        constexpr std::size_t most = 10000;
        const std::lock_guard lock(mutex_);
        if (known_.size() >= most) known_.clear();
        known_.insert_or_assign(name, std::pair{state, hash});
    }

  private:
    std::mutex mutex_;
    std::map<std::string, std::pair<FileState, std::string>> known_;
};

std::string hash_bytes(const std::filesystem::path& file, const std::string& key) {
    std::ifstream in(file, std::ios::binary);
    Sha256 hash;
    std::string block(std::size_t(1) << 18, '\0');
    while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0)
        hash.update({block.data(), static_cast<std::size_t>(in.gcount())});
    if (!in.is_open() || in.bad())
        throw InputError(file.string(), key, "a file that cannot be read", "a readable one");
    return hash.hex();
}

}  // namespace

std::string file_hash(const std::filesystem::path& file, const std::string& key) {
    static KnownHashes known;
    if (const char* reason = reason_not_to_read(file))
        throw InputError(file.string(), key, reason, "a file");
    const std::optional<FileState> before = state_of(file);
    const bool settled = before && is_settled(*before);
    if (settled)
        if (const auto hash = known.find(file.string(), *before)) return *hash;
    const std::string hash = hash_bytes(file, key);
    if (settled && state_of(file) == before) known.keep(file.string(), *before, hash);
    return hash;
}

}  // namespace quadrel
