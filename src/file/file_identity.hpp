// Which file a name leads to, so that two names of one file are found out.
#pragma once

#include <sys/types.h>

#include <compare>
#include <filesystem>
#include <optional>
#include <string>

namespace quadrel {

/// A regular file by its device and inode, whatever links lead to it; a name that is still free by
/// its folder's and itself.
struct FileIdentity {
    dev_t device = 0;
    ino_t inode = 0;
    std::string free_name;

    auto operator<=>(const FileIdentity&) const = default;
};

/// Nothing for what writing cannot destroy (devices, pipes, sockets, folders), and for names in
/// folders that do not exist. Links that lead to a free name are followed to it.
std::optional<FileIdentity> identity_of(const std::filesystem::path& file);

}  // namespace quadrel
