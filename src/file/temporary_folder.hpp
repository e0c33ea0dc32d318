// A folder of one's own for as long as it is needed.
#pragma once

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "quadrel/error.hpp"

namespace quadrel {

/// Under the system's temporary one, its name begins with `name`; goes with all that is in it.
/// Throws OutputError.
class TemporaryFolder {
  public:
    explicit TemporaryFolder(const std::string& name = "quadrel") {
        std::string path = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
        if (mkdtemp(path.data()) == nullptr) throw OutputError(path, std::strerror(errno));
        path_ = path;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace quadrel
