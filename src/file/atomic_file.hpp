// Output files that are either whole or not there. Bytes go to a temporary name in the target's
// directory (temporary_file.hpp), which is synced and renamed. Only a regular file or a free name
// is renamed onto: anything else (device, fifo, link) is written through, because renaming onto
// /dev/full replaces the device and renaming onto a link cuts it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace quadrel {

class AtomicFile {
  public:
    /// Opens the output. Throws OutputError for a directory, a missing or unwritable folder. What
    /// killed processes of this host have left in that folder goes.
    explicit AtomicFile(const std::filesystem::path& target);
    /// Without commit(): removes the temporary; the final name is untouched.
    ~AtomicFile();
    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Writes at the current position. Throws OutputError (full disk, ...).
    void write(const void* data, std::size_t size);
    /// Bytes from the start; seeking past the end leaves a hole of zeros.
    void seek(std::uint64_t position) { position_ = position; }
    std::uint64_t position() const { return position_; }

    /// Syncs, closes and renames; within an OutputGroup of this thread the file is handed to that,
    /// which renames. Throws OutputError, and then the final name is untouched (a written-through
    /// target may hold a part). Call once.
    void commit();
    /// The same at once, whatever group there is.
    void commit_alone();

  private:
    friend class OutputGroup;
    void open_temporary();
    void open_through();
    void send_ahead();
    void finish();
    void publish();
    void publish_through();
    bool is_through() const { return through_; }
    [[noreturn]] void fail(const char* action) const;
    void close_checked();

    std::filesystem::path target_, temporary_;
    int descriptor_ = -1;
    int lock_ = -1;         ///< keeps the temporary locked while it is closed and not yet renamed
    int slot_ = -1;         ///< in the registry of temporaries
    bool through_ = false;  ///< target cannot be seeked or renamed onto: bytes wait in spool_
    bool appends_ = false;  ///< a descriptor of the caller's: what others have written to it stays
    std::string spool_;
    std::uint64_t position_ = 0;
    std::uint64_t sent_ = 0;  ///< up to where the disk has been told to begin
};

/// Throws the OutputError that AtomicFile would throw now: for finding out before long work. Leaves
/// devices and fifos alone.
void check_writable(const std::filesystem::path& target);

/// `file` from the root on, or as it is where the working directory is gone: for messages.
std::filesystem::path full_name(const std::filesystem::path& file);

}  // namespace quadrel
