// The files that a command reads, whatever reads them and by whatever name a file names another.
#pragma once

#include <filesystem>
#include <vector>

#include "file/file_identity.hpp"

namespace quadrel {

/// An input by the name it was read under.
struct InputFile {
    std::filesystem::path name;
    FileIdentity identity;
};

/// Keeps what note_input() is told while it lives. One at a time; of several the youngest.
class InputRecord {
  public:
    InputRecord();
    ~InputRecord();
    InputRecord(const InputRecord&) = delete;
    InputRecord& operator=(const InputRecord&) = delete;

    /// In the order in which they were noted first.
    std::vector<InputFile> files() const;

  private:
    friend void note_input(const std::filesystem::path& file);
    void add(const std::filesystem::path& file);

    InputRecord* outer_;
    std::vector<InputFile> files_;
};

/// Called by whatever is about to read a file, or knows that it will be read. May be called from
/// any thread.
void note_input(const std::filesystem::path& file);

}  // namespace quadrel
