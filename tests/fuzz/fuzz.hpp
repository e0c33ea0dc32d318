// What the fuzz targets share: bytes become a file in memory, a reader reads it, and the only
// exception that may come back is an InputError of one printable line.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "quadrel/error.hpp"

namespace quadrel::fuzz {

/// A folder of this process, in memory where the system has such a place; removed at exit.
class Folder {
  public:
    Folder() {
        const bool in_memory = std::filesystem::is_directory("/dev/shm");
        std::filesystem::path base =
            in_memory ? "/dev/shm" : std::filesystem::temp_directory_path();
        std::string pattern = (base / "quadrel-fuzz-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) std::abort();
        path_ = pattern;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path write(const std::filesystem::path& name, const std::string& bytes) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

inline const Folder& folder() {
    static const Folder folder;
    return folder;
}

/// Empty files under the names of this project's own, so that seeds that name them are read on.
inline void imitate_data() {
    for (const char* kind : {"textures", "meshes"})
        for (const auto& entry : std::filesystem::directory_iterator(QUADREL_SOURCE_DATA_DIR +
                                                                     ("/" + std::string(kind))))
            folder().write(kind / entry.path().filename(), "");
}

/// Ends the process unless the message is one line without control characters.
inline void require_printable(const InputError& error) {
    const std::string text = error.what();
    const bool printable = std::none_of(text.begin(), text.end(),
                                        [](unsigned char c) { return c < ' ' || c == 0x7f; });
    if (!printable) std::abort();
}

/// Lets `read` read a file of these bytes. Any exception but an InputError leaves, and libFuzzer
/// calls it a crash.
template <class Read>
int read_as(const std::filesystem::path& name, const std::uint8_t* data, std::size_t size,
            const Read& read) {
    const auto file = folder().write(name, std::string(reinterpret_cast<const char*>(data), size));
    try {
        read(file);
    } catch (const InputError& error) {
        require_printable(error);
    }
    return 0;
}

}  // namespace quadrel::fuzz
