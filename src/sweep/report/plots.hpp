// The charts of a sweep as files, for those who want a picture and no page.
#pragma once

#include <string>
#include <vector>

#include "io/document/json.hpp"

namespace quadrel::sweep {

struct Plot {
    std::string name;  ///< "front-1.svg"
    std::string svg;
};

/// For each machine, instruction set, number type and count of threads, none of which shares an
/// axis with another: the front of run time against error, and both against the angle.
std::vector<Plot> make_plots(const std::vector<Json>& records);

}  // namespace quadrel::sweep
