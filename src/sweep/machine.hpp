// What times were taken on.
#pragma once

#include <string>

namespace quadrel::sweep {

struct Machine {
    std::string processor;  ///< as the system names it
    std::string host;       ///< two machines of one kind are two machines
    int processors = 0;     ///< that the process may use
    std::string build;      ///< version, and a hash of the program and its kernels
    double load = 0;        ///< of the last minute when it was asked, processes that want to run

    /// By which charts keep machines apart.
    std::string name() const { return processor + ", " + host; }
};

/// This machine, with the program's version. `isa`: as select_kernels resolved it; its module is
/// part of the build.
Machine this_machine(const std::string& version, const std::string& isa);

}  // namespace quadrel::sweep
