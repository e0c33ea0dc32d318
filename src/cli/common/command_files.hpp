// The files of one command: no output may be one of its inputs, and no two outputs one file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "file/input_record.hpp"

namespace quadrel::cli {

/// From its beginning on, every file that is read counts as an input, and all that a scene names.
class CommandFiles {
  public:
    /// An input that is not read before the check.
    void add_input(const std::filesystem::path& file) { note_input(file); }
    /// All inputs so far.
    std::vector<std::filesystem::path> inputs() const;
    /// `option` as in messages, such as "-o". An empty name is none.
    void add_output(const std::string& option, const std::filesystem::path& file);
    /// Standard output, which may have been led into a file.
    void add_standard_output(const std::string& option);

    /// Before the first output is made. Devices and terminals never clash, pipes with one another.
    /// Throws UsageError that names both.
    void check() const;
    /// check(), and whether the outputs can be written. Throws OutputError.
    void check_writable() const;

  private:
    struct Output {
        std::string option;
        std::filesystem::path file;
    };
    void check_inputs(const Output& output, const FileIdentity& identity) const;

    InputRecord inputs_;
    std::vector<Output> outputs_;
};

}  // namespace quadrel::cli
