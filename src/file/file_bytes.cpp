#include "file/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "file/read_file.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

FileBytes::FileBytes(const std::filesystem::path& file, const std::string& key,
                     const std::string& expected)
    : file_(file) {
    const auto refuse = [&](const char* found) {
        throw InputError(file.string(), key, found, expected);
    };
    if (const char* const reason = reason_not_to_read(file)) refuse(reason);
    descriptor_ = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0)
        refuse(errno == EACCES ? "no permission to read" : "a file that cannot be opened");
    struct stat status = {};
    if (fstat(descriptor_, &status) == 0) size_ = static_cast<std::uint64_t>(status.st_size);
}

FileBytes::~FileBytes() {
    if (descriptor_ >= 0) close(descriptor_);
}

std::size_t FileBytes::read(std::uint64_t position, void* to, std::size_t count) const noexcept {
    if (kept_) {
        const auto at = static_cast<std::size_t>(std::min<std::uint64_t>(position, bytes_.size()));
        count = std::min(count, bytes_.size() - at);
        if (count > 0) std::memcpy(to, bytes_.data() + at, count);
        return count;
    }
    std::size_t done = 0;
    while (done < count) {
        const ssize_t got = pread(descriptor_, static_cast<char*>(to) + done, count - done,
                                  static_cast<off_t>(position + done));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

void FileBytes::keep(const std::string& key) {
    std::vector<char> bytes(static_cast<std::size_t>(size_));
    if (read(0, bytes.data(), bytes.size()) != bytes.size())
        throw InputError(file_.string(), key, "a file that cannot be read", "a readable one");
    bytes_ = std::move(bytes);
    kept_ = true;
}

}  // namespace quadrel
