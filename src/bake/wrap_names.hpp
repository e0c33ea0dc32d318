// Wrap modes by name, as scene files have them.
#pragma once

#include <map>
#include <string>

#include "quadrel/texture/format.hpp"

namespace quadrel {

inline const std::map<std::string, Wrap>& wrap_modes() {
    static const std::map<std::string, Wrap> modes{{"repeat", Wrap::repeat},
                                                   {"mirrored-repeat", Wrap::mirrored_repeat},
                                                   {"clamp-to-edge", Wrap::clamp_to_edge},
                                                   {"clamp-to-border", Wrap::clamp_to_border},
                                                   {"mirror-once", Wrap::mirror_once}};
    return modes;
}

inline std::string wrap_name(Wrap wrap) {
    for (const auto& [name, mode] : wrap_modes())
        if (mode == wrap) return name;
    return "";
}

}  // namespace quadrel
