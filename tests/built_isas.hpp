// Which kernels this build can be tested on.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "kernels/select.hpp"

namespace quadrel {

/// Lane sets whose modules this build makes and this CPU can run, then "scalar". A build under the
/// sanitizers makes fewer than a release.
inline std::vector<std::string> built_isas() {
    std::vector<std::string> isas;
    std::istringstream words(QUADREL_BUILT_ISAS);
    for (std::string isa; words >> isa;)
        if (cpu_supports(isa)) isas.push_back(isa);
    isas.emplace_back("scalar");
    return isas;
}

}  // namespace quadrel
