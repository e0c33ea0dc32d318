// Names of files that are open already, under whatever name.
#pragma once

#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace quadrel {

/// The descriptor that /dev/stdout, /dev/stderr, /dev/fd/N or /proc/self/fd/N stands for.
inline std::optional<int> named_descriptor(const std::filesystem::path& file) {
    const std::string name = file.string();
    if (name == "/dev/stdout") return 1;
    if (name == "/dev/stderr") return 2;
    for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
        if (!name.starts_with(folder)) continue;
        const char *const first = name.data() + folder.size(), *const end =
                                                                   name.data() + name.size();
        int number = -1;
        const auto read = std::from_chars(first, end, number);
        if (read.ec == std::errc() && read.ptr == end && number >= 0) return number;
    }
    return std::nullopt;
}

}  // namespace quadrel
