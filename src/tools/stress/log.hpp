// What a run has found so far as a file, so that one that was ended can go on.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "stress/checks.hpp"

namespace quadrel::stress {

/// Lines of JSON: of which run it is, then a scene and its result each.
class ResultLog {
  public:
    /// Opens a log, and makes it where absent. A line that was cut off is dropped: its scene is run
    /// again. Throws InputError for another file and for a log of another seed or limit of
    /// look-ups, OutputError.
    ResultLog(const std::filesystem::path& file, std::uint64_t seed, double look_ups);

    /// What it held when it was opened, by the scenes' names.
    const std::map<std::string, SceneResult>& known() const { return known_; }

    /// Adds a line. Throws OutputError.
    void add(const std::string& scene, const SceneResult& result);

  private:
    [[noreturn]] void refuse(const std::string& first) const;
    void read(const std::string& text);
    void write_line(const Json& line);

    std::filesystem::path file_;
    Json first_;  ///< line
    std::map<std::string, SceneResult> known_;
    std::ofstream out_;
};

}  // namespace quadrel::stress
