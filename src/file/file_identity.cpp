#include "file/file_identity.hpp"

#include <sys/stat.h>

namespace quadrel {

namespace {

std::filesystem::path folder_of(const std::filesystem::path& file) {
    const std::filesystem::path parent = file.parent_path();
    return parent.empty() ? std::filesystem::path(".") : parent;
}

std::optional<FileIdentity> free_name(const std::filesystem::path& file) {
    struct stat folder = {};
    if (!file.has_filename() || stat(folder_of(file).c_str(), &folder) != 0) return std::nullopt;
    return FileIdentity{folder.st_dev, folder.st_ino, file.filename().string()};
}

}  // namespace

std::optional<FileIdentity> identity_of(const std::filesystem::path& file) {
    constexpr int most_links = 40;  // as many as Linux follows
    std::filesystem::path name = file;
    for (int links = 0; links < most_links; ++links) {
        struct stat status = {};
        if (stat(name.c_str(), &status) == 0) {
            if (!S_ISREG(status.st_mode)) return std::nullopt;
            return FileIdentity{status.st_dev, status.st_ino, ""};
        }
        std::error_code error;
        const std::filesystem::path target = std::filesystem::read_symlink(name, error);
        if (error) return free_name(name);
        name = folder_of(name) / target;
    }
    return std::nullopt;
}

}  // namespace quadrel
