// Programs run as processes of their own.
#pragma once

#include <string>
#include <vector>

#include "picture.hpp"

namespace quadrel::peers {

struct ProcessUse {
    Time time;            ///< from its start to its end
    double peak_mib = 0;  ///< its greatest resident memory
};

/// Starts programs from a small process that is split off when this is made: what a program's
/// starter holds in memory counts as the program's own peak. To be made while this process is small
/// and has one thread.
class ProcessRunner {
  public:
    ProcessRunner();
    ~ProcessRunner();
    ProcessRunner(const ProcessRunner&) = delete;
    ProcessRunner& operator=(const ProcessRunner&) = delete;

    /// Runs a command on so many processors, nothing on its standard input, its outputs thrown
    /// away. Throws std::runtime_error where it cannot be run or does not end with 0.
    ProcessUse run(const std::vector<std::string>& command, int processors);

  private:
    int socket_ = -1;
    int starter_ = -1;
};

}  // namespace quadrel::peers
