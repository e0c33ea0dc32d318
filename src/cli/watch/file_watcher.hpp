// Waiting for files to change, by inotify.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <vector>

namespace quadrel::cli {

/// Folders are watched, not files: editors put a new file in the place of the old one.
class FileWatcher {
  public:
    /// Throws std::system_error where the system has no more watches to give.
    FileWatcher();
    ~FileWatcher();
    FileWatcher(const FileWatcher&) = delete;
    FileWatcher& operator=(const FileWatcher&) = delete;

    /// These from now on, whatever was watched before stays so. Those whose folder is missing are
    /// left out.
    void add(const std::vector<std::filesystem::path>& files);

    /// Blocks until one of them has been written, replaced or removed, and nothing more comes for
    /// a moment: programs write files in several steps. Returns which, by the names they were
    /// added under.
    std::set<std::filesystem::path> wait();

  private:
    void read_events(std::set<std::filesystem::path>& changed);

    int queue_;
    /// By watch and name in its folder.
    std::map<int, std::map<std::string, std::filesystem::path>> names_;
};

}  // namespace quadrel::cli
