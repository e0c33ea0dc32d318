// A program run as a process of its own.
#pragma once

#include <string>
#include <vector>

#include "picture.hpp"

namespace quadrel::peers {

struct ProcessUse {
    Time time;            ///< from its start to its end
    double peak_mib = 0;  ///< its greatest resident memory
};

/// Runs it with nothing on standard input and its outputs thrown away. Throws std::runtime_error
/// where it cannot be run or does not end with 0.
ProcessUse run_process(const std::vector<std::string>& command);

}  // namespace quadrel::peers
