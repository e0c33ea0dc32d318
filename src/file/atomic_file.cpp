#include "file/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "file/named_descriptor.hpp"
#include "file/output_group.hpp"
#include "file/temporary_file.hpp"
#include "file/temporary_registry.hpp"
#include "quadrel/check.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

/// Whether a rename may replace this name: a regular file, or nothing.
bool replaceable(const std::filesystem::path& target) {
    struct stat status = {};
    if (lstat(target.c_str(), &status) != 0) return errno == ENOENT;
    return S_ISREG(status.st_mode);
}

/// The finished file keeps the permissions of the file that it replaces, where it can.
void keep_mode(int descriptor, const std::filesystem::path& target) {
    struct stat status = {};
    if (lstat(target.c_str(), &status) != 0) return;
    if (fchmod(descriptor, status.st_mode & 07777) != 0) errno = 0;
}

/// A rename is durable once its folder is synced; file systems that cannot do so say EINVAL.
void sync_folder(const std::filesystem::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    fsync(descriptor);
    close(descriptor);
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target) {
    if (target.empty()) throw OutputError("", "empty file name");
    std::error_code error;
    target_ = std::filesystem::absolute(target, error);
    if (error) throw OutputError(target, "the working directory is gone");
    if (!target_.has_filename()) throw OutputError(target_, "is a directory");
    if (std::filesystem::is_directory(target_, error)) throw OutputError(target_, "is a directory");
    through_ = !replaceable(target_);
    through_ ? open_through() : open_temporary();
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)),
      lock_(std::exchange(other.lock_, -1)),
      slot_(std::exchange(other.slot_, -1)),
      through_(other.through_),
      appends_(other.appends_),
      spool_(std::move(other.spool_)),
      position_(other.position_),
      sent_(other.sent_) {}

AtomicFile::~AtomicFile() {
    if (!temporary_.empty()) unlink(temporary_.c_str());
    if (descriptor_ >= 0) close(descriptor_);
    if (lock_ >= 0) close(lock_);
    forget_temporary(slot_);
}

void check_writable(const std::filesystem::path& target) {
    std::error_code ignored;
    const bool directory = std::filesystem::is_directory(target, ignored);
    if (directory || replaceable(target)) AtomicFile probe(target);
}

std::filesystem::path full_name(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::path full = std::filesystem::absolute(file, error);
    return error ? file : full.lexically_normal();
}

void AtomicFile::open_temporary() {
    // rename() needs no permission on the file that it replaces; an existing read-only file is
    // nevertheless meant to stay.
    if (access(target_.c_str(), F_OK) == 0 && access(target_.c_str(), W_OK) != 0) fail("open");
    remove_abandoned_once(target_.parent_path());
    constexpr int most_tries = 100;
    for (int tries = 0; tries < most_tries; ++tries) {
        // Not derived from the target's name, which may already be as long as names can be.
        const std::filesystem::path name = target_.parent_path() / temporary_name();
        slot_ = register_temporary(name.c_str());
        descriptor_ = create_locked(name);
        if (descriptor_ >= 0) {
            temporary_ = name;
            return;
        }
        const int error = errno;
        forget_temporary(std::exchange(slot_, -1));
        errno = error;
        if (error != EEXIST) break;
    }
    fail("create a file beside it");
}

void AtomicFile::open_through() {
    const std::optional<int> named = named_descriptor(target_);
    appends_ = named.has_value();
    descriptor_ = named ? fcntl(*named, F_DUPFD_CLOEXEC, 3)
                        : open(target_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("open");
}

void AtomicFile::write(const void* data, std::size_t size) {
    const char* bytes = static_cast<const char*>(data);
    if (through_) {
        if (spool_.size() < position_ + size) spool_.resize(position_ + size);
        std::memcpy(spool_.data() + position_, bytes, size);
        position_ += size;
        return;
    }
    while (size > 0) {
        const ssize_t written = pwrite(descriptor_, bytes, size, static_cast<off_t>(position_));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("write");
        bytes += written;
        size -= static_cast<std::size_t>(written);
        position_ += static_cast<std::uint64_t>(written);
    }
    send_ahead();
}

/// Lets the disk begin while more is made, so that there is little to wait for in the end.
void AtomicFile::send_ahead() {
#ifdef SYNC_FILE_RANGE_WRITE
    constexpr std::uint64_t worth = std::uint64_t(2) << 20;
    if (position_ < sent_ + worth) return;
    const int error = errno;
    sync_file_range(descriptor_, static_cast<off_t>(sent_), static_cast<off_t>(position_ - sent_),
                    SYNC_FILE_RANGE_WRITE);
    errno = error;
    sent_ = position_;
#endif
}

void AtomicFile::commit() {
    OutputGroup* const group = OutputGroup::current();
    if (group == nullptr) return commit_alone();
    finish();
    group->files_.push_back(std::move(*this));
}

void AtomicFile::commit_alone() {
    finish();
    publish();
}

void AtomicFile::finish() {
    QUADREL_CHECK(descriptor_ >= 0, descriptor_);
    if (through_) return;
    keep_mode(descriptor_, target_);
    if (fsync(descriptor_) != 0) fail("sync");
    // A lock belongs to all duplicates of a descriptor.
    lock_ = fcntl(descriptor_, F_DUPFD_CLOEXEC, 3);
    close_checked();
}

void AtomicFile::publish() {
    if (through_) return publish_through();
    if (!replaceable(target_)) throw OutputError(target_, "is no longer a regular file");
    if (rename(temporary_.c_str(), target_.c_str()) != 0) fail("rename");
    temporary_.clear();
    forget_temporary(std::exchange(slot_, -1));
    sync_folder(target_.parent_path());
}

void AtomicFile::publish_through() {
    struct stat status = {};
    const bool regular = fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
    if (regular && !appends_ && ftruncate(descriptor_, 0) != 0) fail("truncate");
    std::size_t done = 0;
    while (done < spool_.size()) {
        const ssize_t written = ::write(descriptor_, spool_.data() + done, spool_.size() - done);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("write");
        done += static_cast<std::size_t>(written);
    }
    if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail("sync");
    close_checked();
}

void AtomicFile::close_checked() {
    const int closed = close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 && errno != EINTR) fail("close");
}

void AtomicFile::fail(const char* action) const {
    const int error = errno;
    throw OutputError(target_, fmt::format("cannot {}: {}", action, std::strerror(error)));
}

}  // namespace quadrel
