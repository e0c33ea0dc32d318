#include "film/preview_group.hpp"

#include <string_view>

namespace quadrel {
namespace {

/// The planes of these endings, all float, behind `prefix`; none unless all are there.
std::vector<const Plane*> find_all(const Film& film, const std::string& prefix,
                                   std::string_view endings) {
    std::vector<const Plane*> planes;
    for (const char ending : endings) {
        const Plane* plane = film.find(prefix + ending);
        if (plane == nullptr || plane->type != ChannelType::float32) return {};
        planes.push_back(plane);
    }
    return planes;
}

}  // namespace

PreviewGroup preview_group(const Film& film) {
    if (auto colours = find_all(film, "", "RGB"); !colours.empty()) return {"", colours};
    const Plane& first = film.planes[0];
    const std::size_t dot = first.name.rfind('.');
    const std::string group = dot == std::string::npos ? "" : first.name.substr(0, dot);
    const std::string prefix = group.empty() ? "" : group + ".";
    const char last = first.name.back();
    if (first.name.size() == prefix.size() + 1)
        for (const std::string_view endings : {"XYZ", "RGB", "UV", "012"}) {
            if (endings.find(last) == endings.npos) continue;
            if (auto planes = find_all(film, prefix, endings); !planes.empty())
                return {group.empty() ? std::string(endings) : group, planes};
        }
    return {first.name, {&first}};
}

}  // namespace quadrel
