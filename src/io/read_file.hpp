// A whole file in memory.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "quadrel/error.hpp"

namespace quadrel {

/// The file's bytes. Throws InputError if it is missing or cannot be read.
inline std::string read_whole_file(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        throw InputError(file.string(), "", "no such file", "a file");
    if (std::filesystem::is_directory(file, error))
        throw InputError(file.string(), "", "a directory", "a file");
    std::ifstream stream(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (!stream.is_open() || stream.bad())
        throw InputError(file.string(), "", "a file that cannot be read", "a readable one");
    return bytes;
}

}  // namespace quadrel
