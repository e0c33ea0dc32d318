#include "bake/store/disk_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>

#include "bake/store/cache_entry.hpp"
#include "file/atomic_file.hpp"
#include "file/read_file.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

namespace {

using Clock = std::filesystem::file_time_type::clock;

constexpr const char* suffix = ".baked";

std::optional<std::filesystem::path> user_folder() {
    const auto absolute = [](const char* variable) {
        const char* const value = std::getenv(variable);
        const std::filesystem::path path = value == nullptr ? "" : value;
        return path.is_absolute() ? path : std::filesystem::path();
    };
    // A relative XDG_CACHE_HOME is to be ignored (XDG Base Directory Specification).
    std::filesystem::path base = absolute("XDG_CACHE_HOME");
    if (base.empty()) {
        base = absolute("HOME");
        if (base.empty()) return std::nullopt;
        base /= ".cache";
    }
    return base / "quadrel" / "baked";
}

std::uintmax_t user_limit() {
    const char* const value = std::getenv("QUADREL_CACHE_MIB");
    if (value == nullptr || *value == '\0') return std::uintmax_t{1} << 30;
    const std::string_view text(value);
    std::uint32_t mebibytes = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), mebibytes);
    if (error != std::errc() || end != text.data() + text.size())
        throw UsageError(
            fmt::format("QUADREL_CACHE_MIB is \"{}\"; expected a number of MiB", text));
    return std::uintmax_t{mebibytes} << 20;
}

struct StoredFile {
    std::filesystem::path path;
    Clock::time_point used;
    std::uintmax_t bytes;
};

/// Entries, and what writers that were killed have left; nothing else in the folder is ours.
bool is_ours(const std::filesystem::path& file, Clock::time_point used) {
    const std::string name = file.filename().string();
    if (name.ends_with(suffix)) return true;
    const bool left = name.starts_with(".quadrel-") && name.ends_with(".tmp");
    return left && Clock::now() - used > std::chrono::hours(24);
}

std::vector<StoredFile> stored_files(const std::filesystem::path& folder) {
    std::vector<StoredFile> files;
    std::error_code error;
    for (std::filesystem::directory_iterator i(folder, error), end; !error && i != end;
         i.increment(error)) {
        std::error_code gone;
        const auto used = i->last_write_time(gone);
        const auto bytes = gone ? 0 : i->file_size(gone);
        if (!gone && i->is_regular_file(gone) && is_ours(i->path(), used))
            files.push_back({i->path(), used, bytes});
    }
    return files;
}

/// Why there is no such folder, if there is none.
std::optional<std::string> make_folder(const std::filesystem::path& folder) {
    std::error_code error, ignored;
    std::filesystem::create_directories(folder, error);
    if (std::filesystem::is_directory(folder, ignored)) return std::nullopt;
    return fmt::format("cannot create the folder {}: {}", folder.string(),
                       error ? error.message() : "something else is there");
}

}  // namespace

std::optional<DiskCache> DiskCache::of_user() {
    const std::uintmax_t limit = user_limit();
    const auto folder = user_folder();
    if (!folder || limit == 0) return std::nullopt;
    return DiskCache(*folder, limit);
}

bool DiskCache::is_switched_off() { return user_limit() == 0; }

std::filesystem::path DiskCache::file_of(const std::string& id) const {
    return folder_ / (id + suffix);
}

std::shared_ptr<const Texture> DiskCache::load(const std::string& id) const {
    const std::filesystem::path file = file_of(id);
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) {
        // Writing would wait for a pipe's reader, and follow a link.
        const auto status = std::filesystem::symlink_status(file, error);
        if (std::filesystem::exists(status) && !std::filesystem::is_directory(status))
            std::filesystem::remove(file, error);
        return nullptr;
    }
    std::string bytes;
    try {
        bytes = read_whole_file(file);
    } catch (const InputError&) {
        return nullptr;
    }
    auto map = decode_entry(bytes, id);
    if (map == nullptr) {
        std::filesystem::remove(file, error);
    } else {
        std::filesystem::last_write_time(file, Clock::now(), error);
    }
    return map;
}

std::optional<std::string> DiskCache::store(const Texture& map) const {
    const std::string bytes = encode_entry(map);
    if (bytes.size() > most_bytes_)
        return fmt::format("the map has {} bytes, and QUADREL_CACHE_MIB allows {}", bytes.size(),
                           most_bytes_);
    if (auto problem = make_folder(folder_)) return problem;
    try {
        AtomicFile file(file_of(map.id()));
        file.write(bytes.data(), bytes.size());
        file.commit_alone();
    } catch (const OutputError& failure) {
        return failure.reason;
    }
    remove_oldest();
    return std::nullopt;
}

std::optional<std::string> DiskCache::reason_not_to_write(const std::string& id) const {
    if (auto problem = make_folder(folder_)) return problem;
    try {
        check_writable(file_of(id));
    } catch (const OutputError& failure) {
        return failure.reason;
    }
    return std::nullopt;
}

void DiskCache::remove_oldest() const {
    std::vector<StoredFile> files = stored_files(folder_);
    std::sort(files.begin(), files.end(),
              [](const StoredFile& a, const StoredFile& b) { return a.used < b.used; });
    std::uintmax_t total = 0;
    for (const StoredFile& file : files) total += file.bytes;
    for (std::size_t i = 0; i < files.size() && total > most_bytes_; ++i) {
        std::error_code error;
        std::filesystem::remove(files[i].path, error);
        total -= files[i].bytes;
    }
}

}  // namespace quadrel
