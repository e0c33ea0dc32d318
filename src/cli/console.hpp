// What people and pipes see: data on standard output, progress on standard error.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quadrel::cli {

/// Writes data to standard output. Throws OutputError.
void print(std::string_view text);

/// Throws OutputError if anything printed did not get out.
void flush_output();

/// Prints notes (Scene::notes) on standard error, each text once in the life of the process.
void say_notes(const std::vector<std::string>& notes);

/// A bar on standard error, drawn only if that is a terminal; without colour where NO_COLOR
/// (no-color.org) is set or the terminal is dumb.
class ProgressBar {
  public:
    ProgressBar();
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `share` done, 0 to 1. Not for several threads at once.
    void show(double share);
    /// Off the terminal, for other text.
    void clear();

  private:
    bool terminal_, color_;
    int percent_ = -1;
};

}  // namespace quadrel::cli
