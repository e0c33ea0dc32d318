// A reference with ranges as films of values, of their ends, and of their numbers.
#include <map>
#include <set>

#include "quadrel/error.hpp"
#include "quadrel/film/legal.hpp"

namespace quadrel {
namespace {

/// The parts that a channel's range is made of.
struct Part {
    const char* prefix;
    ChannelType type;
    Film LegalReference::*film;
    bool optional = false;  ///< where it is absent, the upper end stands for it
};

constexpr Part range_parts[] = {
    {"gpu.lo.", ChannelType::float32, &LegalReference::lo},
    {"gpu.hi.", ChannelType::float32, &LegalReference::hi},
    {"gpu.paths.", ChannelType::uint32, &LegalReference::paths},
    {"gpu.gap.lo.", ChannelType::float32, &LegalReference::gap_lo, true},
    {"gpu.gap.hi.", ChannelType::float32, &LegalReference::gap_hi, true},
};

bool is_range(const std::string& name) { return name.starts_with("gpu."); }

/// The channels that any part names, in order.
std::set<std::string> ranged_channels(const Film& reference) {
    std::set<std::string> names;
    for (const Plane& plane : reference.planes)
        for (const Part& part : range_parts)
            if (plane.name.starts_with(part.prefix))
                names.insert(plane.name.substr(std::string(part.prefix).size()));
    return names;
}

/// What is wrong with a channel that has a range, or nothing.
std::string defect(const Film& reference, const std::string& name) {
    if (reference.find(name) == nullptr) return "the reference has its range and no value";
    for (const Part& part : range_parts) {
        const Plane* plane = reference.find(part.prefix + name);
        if (plane == nullptr && part.optional) continue;
        if (plane == nullptr) return "the reference lacks " + (part.prefix + name);
        if (plane->type != part.type)
            return part.prefix + name + " of the reference: found " +
                   (plane->type == ChannelType::uint32 ? "integers, expected floats"
                                                       : "floats, expected integers");
    }
    return "";
}

void add_parts(const Film& reference, const Plane& value, LegalReference& parts) {
    parts.values.planes.push_back(value);
    for (const Part& part : range_parts) {
        const Plane* const own = reference.find(part.prefix + value.name);
        Plane& plane =
            (parts.*part.film)
                .planes.emplace_back(own ? *own : *reference.find("gpu.hi." + value.name));
        plane.name = value.name;
    }
}

}  // namespace

LegalReference take_apart(const Film& reference, const std::string& file) {
    const std::set<std::string> ranged = ranged_channels(reference);
    if (ranged.empty())
        throw InputError(file, "", "no channels gpu.lo.*, gpu.hi.*, gpu.paths.*",
                         "a reference that holds what its values may be");
    const Film empty{reference.frame, reference.window, {}};
    LegalReference parts{empty, empty, empty, empty, empty, empty, {}, {}};
    for (const std::string& name : ranged)
        if (const std::string text = defect(reference, name); !text.empty())
            parts.structure.push_back("channel " + name + ": " + text);
    for (const Plane& plane : reference.planes) {
        if (is_range(plane.name)) continue;
        if (plane.name == "undecided" && plane.type == ChannelType::uint32) {
            parts.undecided = plane;
            continue;
        }
        if (plane.name == "A") parts.coverage = plane;
        if (plane.name == "A" && reference.find("undecided") != nullptr) continue;
        if (ranged.count(plane.name) == 0)
            parts.rangeless.push_back(plane.name);
        else if (defect(reference, plane.name).empty())
            add_parts(reference, plane, parts);
    }
    return parts;
}

}  // namespace quadrel
