// Output files that are either whole or not there. Bytes go to a temporary name in the target's
// directory, which is synced and renamed. Only a regular file or a free name is renamed onto:
// anything else (device, fifo, link) is written through, because renaming onto /dev/full replaces
// the device and renaming onto a link cuts it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace quadrel {

class AtomicFile {
  public:
    /// Opens the output. Throws OutputError for a directory, a missing or unwritable folder.
    explicit AtomicFile(const std::filesystem::path& target);
    /// Without commit(): removes the temporary; the final name is untouched.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Writes at the current position. Throws OutputError (full disk, ...).
    void write(const void* data, std::size_t size);
    /// Bytes from the start; seeking past the end leaves a hole of zeros.
    void seek(std::uint64_t position) { position_ = position; }
    std::uint64_t position() const { return position_; }

    /// Syncs, closes and renames. Throws OutputError, and then the final name is untouched (a
    /// written-through target may hold a part). Call once.
    void commit();

  private:
    void open_temporary();
    void open_through();
    void commit_temporary();
    void commit_through();
    [[noreturn]] void fail(const char* action) const;
    void close_checked();

    std::filesystem::path target_, temporary_;
    int descriptor_ = -1;
    int slot_ = -1;         ///< in the registry of temporaries
    bool through_ = false;  ///< target cannot be seeked or renamed onto: bytes wait in spool_
    std::string spool_;
    std::uint64_t position_ = 0;
};

/// Throws the OutputError that AtomicFile would throw now: for finding out before long work. Leaves
/// devices and fifos alone.
void check_writable(const std::filesystem::path& target);

/// Makes SIGINT, SIGTERM and SIGHUP remove the temporaries of unfinished outputs and end the
/// process with 128 + the signal's number (130, 143, 129); a closed pipe becomes a write error
/// instead of SIGPIPE. For programs; the library itself never calls it.
void install_signal_cleanup();

}  // namespace quadrel
