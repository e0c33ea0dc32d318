// Files that are written: none that was read for what is in them, and none of another kind.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "file/file_identity.hpp"

namespace quadrel::python {

/// Files that something was made of.
class Inputs {
  public:
    void add(const Inputs& others);
    void add(const std::filesystem::path& file);
    /// Throws UsageError, which begins with `what`, where `output` is one of them.
    void check(const std::string& what, const std::filesystem::path& output) const;

  private:
    struct Input {
        std::filesystem::path name, absolute;
        FileIdentity identity;  ///< when it was read
    };
    std::vector<Input> files_;
};

/// The files that `read` reads. One at a time; not with the interpreter's lock.
Inputs inputs_of(const std::function<void()>& read);

/// Before an EXR is made. Devices and pipes take what they get. Throws UsageError for a name that
/// is none, is an input's, or does not end in .exr.
void check_output(const std::string& what, const std::string& file, const Inputs& inputs);

}  // namespace quadrel::python
