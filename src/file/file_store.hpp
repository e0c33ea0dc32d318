// Files that are hashed first and decoded later, read but once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "file/file_bytes.hpp"

namespace quadrel {

/// Keeps the bytes of files that it has hashed, as far as they fit in 64 MB together, until they
/// are taken. May be used by several threads at once.
class FileStore {
  public:
    /// As the function of this name; the bytes are kept if they had to be read.
    std::string file_hash(const std::filesystem::path& file, const std::string& key = "");

    struct Contents {
        std::shared_ptr<const FileBytes> bytes;
        std::string hash;
    };
    /// The file as it is now, and the hash of these very bytes. Kept ones are given away.
    Contents take(const std::filesystem::path& file, const std::string& key = "");

    /// Keeps nothing any more.
    void forget();

  private:
    Contents read(const std::filesystem::path& file, const std::string& key);

    std::mutex mutex_;
    std::uint64_t room_ = std::uint64_t(64) << 20;
    std::map<std::filesystem::path, Contents> kept_;
};

}  // namespace quadrel
