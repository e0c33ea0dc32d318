// What people and pipes see: data on standard output, progress on standard error.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quadrel::cli {

/// Writes text to standard output, line by line printable. Throws OutputError; but a reader that
/// has gone has all that it wants: from then on nothing is written, and that is no error.
void print(std::string_view text);

/// The same with JSON, which stays JSON.
void print_json(std::string_view json);

/// The bytes of a file, as they are.
void print_bytes(const std::string& bytes);

/// Throws OutputError if anything printed did not get out, unless its reader has gone.
void flush_output();

/// Prints notes (Scene::notes) on standard error, each text once in the life of the process.
void say_notes(const std::vector<std::string>& notes);
/// A message for people on standard error, printable and with a line break. One that does not get
/// out is no error.
void say(std::string_view message);

/// Says where an output is now; not with --quiet.
void say_written(const std::filesystem::path& file);

/// Makes descriptors 0 to 2 be open, so that no output gets one of them and with it what is
/// printed: what was closed becomes one that cannot be read, or written.
void occupy_standard_descriptors();

/// A bar on standard error, drawn only if that is a terminal; without colour where NO_COLOR
/// (no-color.org) is set or the terminal is dumb.
class ProgressBar {
  public:
    ProgressBar();
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `share` done, 0 to 1, and of what; what takes long has the time that is left beside it. Not
    /// for several threads at once.
    void show(double share, std::string_view what = "");
    /// Off the terminal, for other text.
    void clear();

  private:
    bool terminal_, color_;
    int percent_ = -1;
    std::string what_;
    std::optional<std::chrono::steady_clock::time_point> begun_;  ///< with what is shown
};

/// The warning that a map that was derived from heights is not kept in the cache, once in the life
/// of the process for each reason.
void say_not_kept(const std::string& reason, ProgressBar& bar);

}  // namespace quadrel::cli
