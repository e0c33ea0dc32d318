// Pixels that a comparison leaves out by what the reference says of their hits.
#include <algorithm>

#include "quadrel/compare.hpp"
#include "quadrel/error.hpp"
#include "quadrel/quad/value.hpp"

namespace quadrel {

std::uint32_t parse_hit_flags(const std::vector<std::string>& names) {
    std::uint32_t flags = 0;
    for (const std::string& name : names) {
        const auto known = std::find_if(hit_flag_names.begin(), hit_flag_names.end(),
                                        [&](const HitFlagName& flag) { return flag.name == name; });
        if (known == hit_flag_names.end()) {
            std::string expected;
            for (const HitFlagName& flag : hit_flag_names)
                expected += (expected.empty() ? "" : ", ") + std::string(flag.name);
            throw UsageError("found \"" + name + "\", expected one or more of " + expected);
        }
        flags |= static_cast<std::uint32_t>(known->bit);
    }
    return flags;
}

std::vector<bool> flagged_pixels(const Film& reference, std::uint32_t flags) {
    const Plane* plane = reference.find("hit.flags");
    if (plane == nullptr || plane->type != ChannelType::uint32)
        throw UsageError("the reference has no channel hit.flags");
    std::vector<bool> flagged;
    for (const std::uint32_t bits : plane->bits) flagged.push_back((bits & flags) != 0);
    return flagged;
}

}  // namespace quadrel
