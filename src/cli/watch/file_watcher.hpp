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

    /// Blocks until one of them has been written, replaced or removed, and nothing more comes of
    /// them for a moment: programs write files in several steps. Returns which, by the names they
    /// were added under; all where there was more than the system keeps.
    std::set<std::filesystem::path> wait();

  private:
    void add_path(std::filesystem::path place, const std::filesystem::path& file);
    /// Whether one of the files was among what was read.
    bool read_events(std::set<std::filesystem::path>& changed);
    void add_all(std::set<std::filesystem::path>& changed) const;

    struct Folder {
        std::filesystem::path place;
        /// By name in the folder: itself, or those below it.
        std::map<std::string, std::set<std::filesystem::path>> files;
    };

    int queue_;
    std::map<int, Folder> folders_;  ///< by watch
};

}  // namespace quadrel::cli
