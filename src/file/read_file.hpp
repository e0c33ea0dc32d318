// A whole file in memory.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "file/input_record.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

/// Why `file` cannot be an input that is read more than once, or null: a device may go on for ever,
/// and a pipe gives its bytes only once. Whatever asks is going to read it: it counts as an input
/// of the command.
inline const char* reason_not_to_read(const std::filesystem::path& file) {
    note_input(file);
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (error == std::errc::permission_denied) return "no permission to look into its folder";
    if (!std::filesystem::exists(status)) return "no such file";
    if (std::filesystem::is_directory(status)) return "a directory";
    if (std::filesystem::is_fifo(status)) return "a pipe";
    return std::filesystem::is_regular_file(status) ? nullptr : "a device or socket";
}

/// The bytes of a file or pipe. Throws InputError if it is missing or cannot be read.
inline std::string read_whole_file(const std::filesystem::path& file) {
    std::error_code error;
    const char* const reason = reason_not_to_read(file);
    if (reason != nullptr && !std::filesystem::is_fifo(file, error))
        throw InputError(file.string(), "", reason, "a file");
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes;
    if (stream.peek() != std::ifstream::traits_type::eof()) bytes << stream.rdbuf();
    if (!stream.is_open() || stream.bad())
        throw InputError(file.string(), "", "a file that cannot be read", "a readable one");
    return std::move(bytes).str();
}

}  // namespace quadrel
