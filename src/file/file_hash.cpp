#include "file/file_hash.hpp"

#include <sys/stat.h>

#include <ctime>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "file/input_record.hpp"
#include "quadrel/error.hpp"
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

std::optional<FileState> state_of(const struct stat& status) {
    if (!S_ISREG(status.st_mode)) return std::nullopt;
    return FileState{status.st_dev,
                     status.st_ino,
                     status.st_size,
                     {status.st_mtim.tv_sec, status.st_mtim.tv_nsec},
                     {status.st_ctim.tv_sec, status.st_ctim.tv_nsec}};
}

std::optional<FileState> state_of(const std::filesystem::path& file) {
    struct stat status = {};
    return stat(file.c_str(), &status) == 0 ? state_of(status) : std::nullopt;
}

std::optional<FileState> state_of(const FileBytes& file) {
    struct stat status = {};
    return fstat(file.descriptor(), &status) == 0 ? state_of(status) : std::nullopt;
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

KnownHashes& known_hashes() {
    static KnownHashes known;
    return known;
}

std::string hash_bytes(const FileBytes& file, const std::string& key) {
    Sha256 hash;
    std::string block(std::size_t(1) << 18, '\0');
    std::uint64_t position = 0;
    while (const std::size_t count = file.read(position, block.data(), block.size())) {
        hash.update({block.data(), count});
        position += count;
    }
    if (position < file.size())
        throw InputError(file.file().string(), key, "a file that cannot be read", "a readable one");
    return hash.hex();
}

}  // namespace

std::optional<std::string> known_file_hash(const std::filesystem::path& file) {
    const std::optional<FileState> state = state_of(file);
    if (!state || !is_settled(*state)) return std::nullopt;
    return known_hashes().find(file.string(), *state);
}

std::string file_hash(const FileBytes& file, const std::string& key) {
    const std::optional<FileState> before = state_of(file);
    std::string hash = hash_bytes(file, key);
    if (before && is_settled(*before) && state_of(file) == before)
        known_hashes().keep(file.file().string(), *before, hash);
    return hash;
}

std::string file_hash(const std::filesystem::path& file, const std::string& key) {
    if (auto hash = known_file_hash(file)) {
        note_input(file);
        return *std::move(hash);
    }
    return file_hash(FileBytes(file, key), key);
}

}  // namespace quadrel
