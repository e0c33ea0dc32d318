#include "export/scene/output_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "file/temporary_file.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

std::filesystem::path folder_at(const std::filesystem::path& name) {
    std::error_code error;
    std::filesystem::path folder =
        std::filesystem::weakly_canonical(std::filesystem::absolute(name), error);
    if (error) folder = name.lexically_normal();
    return folder.has_filename() ? folder : folder.parent_path();
}

OutputFolder::OutputFolder(const std::filesystem::path& target) : target_(folder_at(target)) {
    const std::filesystem::path beside = target_.parent_path();
    remove_abandoned_once(beside);
    do {
        temporary_ = beside / temporary_name();
        lock_ = create_locked_folder(temporary_);
    } while (lock_ < 0 && errno == EEXIST);
    if (lock_ < 0) fail("cannot be made");
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(temporary_, ignored);
    if (lock_ >= 0) close(lock_);
}

void OutputFolder::fail(const char* action) const {
    throw OutputError(target_.string(), std::string(action) + ": " + std::strerror(errno));
}

void OutputFolder::commit() {
    if (syncfs(lock_) != 0) fail("cannot be written");
    // A free name, or an empty folder.
    if (std::rename(temporary_.c_str(), target_.c_str()) == 0) return;
    if (errno != ENOTEMPTY && errno != EEXIST) fail("cannot be written");
    replace();
}

/// Both change places, so that one of them is always whole; what was there goes with the
/// temporary name.
void OutputFolder::replace() {
    if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0)
        return;
    // File systems that exchange nothing.
    const std::filesystem::path old = temporary_.string() + ".old";
    if (std::rename(target_.c_str(), old.c_str()) != 0) fail("cannot be replaced");
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) {
        const int error = errno;
        std::rename(old.c_str(), target_.c_str());
        errno = error;
        fail("cannot be replaced");
    }
    temporary_ = old;
}

}  // namespace quadrel
