// SHA-256 of files. Of a file that is as it was when this process hashed it, the hash is known.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "file/file_bytes.hpp"

namespace quadrel {

/// The hash of the file's bytes, in hexadecimal. Counts as reading it. Throws InputError, with
/// `key` for where a scene names it, for what is missing, no file or cannot be read.
///
/// A file is taken for unchanged by device, inode, size and both times; not if it was changed just
/// before it was read, since a second change would not show.
std::string file_hash(const std::filesystem::path& file, const std::string& key = "");

/// The same of a file that is open.
std::string file_hash(const FileBytes& file, const std::string& key = "");

/// The hash if it is known.
std::optional<std::string> known_file_hash(const std::filesystem::path& file);

}  // namespace quadrel
