// An open file, read at any place by any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace quadrel {

/// The same file from when it is made on, whatever is renamed onto its name meanwhile.
class FileBytes {
  public:
    /// Throws InputError for what is missing, no file or not to be read, with `key` for where a
    /// scene names it, and what was `expected`. Counts as reading it.
    explicit FileBytes(const std::filesystem::path& file, const std::string& key = "",
                       const std::string& expected = "a file");
    ~FileBytes();
    FileBytes(const FileBytes&) = delete;
    FileBytes& operator=(const FileBytes&) = delete;

    const std::filesystem::path& file() const { return file_; }
    std::uint64_t size() const { return size_; }

    /// Copies up to `count` bytes from `position` on and says how many there were; fewer only at
    /// the end of the file and where it cannot be read.
    std::size_t read(std::uint64_t position, void* to, std::size_t count) const noexcept;

    /// Reads all of it now, so that nothing is read a second time. Throws InputError if that fails.
    void keep(const std::string& key);
    bool kept() const { return kept_; }
    /// For fstat.
    int descriptor() const { return descriptor_; }

  private:
    std::filesystem::path file_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    std::vector<char> bytes_;
    bool kept_ = false;
};

}  // namespace quadrel
