// Folders that are either whole or not there: filled beside their place under a name of their own
// (file/temporary_file.hpp), and renamed.
#pragma once

#include <filesystem>
#include <memory>

#include "file/temporary_registry.hpp"

namespace quadrel {

/// Signals that end the process wait while it lives.
class OutputFolder {
  public:
    /// Throws OutputError where no folder can be made beside `target`.
    explicit OutputFolder(const std::filesystem::path& target);
    /// Without commit(): what `target` was stays.
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// To be filled.
    const std::filesystem::path& path() const { return temporary_; }
    /// Syncs it and puts it in its place; a folder that stands there goes, with all that is in it.
    /// Throws OutputError.
    void commit();

  private:
    void replace();
    [[noreturn]] void fail(const char* action) const;

    SignalHold hold_;
    std::filesystem::path target_, temporary_;
    int lock_ = -1;
};

/// The folder that `name` leads to, whether it is there or not: from the root on, links followed,
/// nothing behind its own name.
std::filesystem::path folder_at(const std::filesystem::path& name);

}  // namespace quadrel
