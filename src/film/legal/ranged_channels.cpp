#include "film/legal/ranged_channels.hpp"

#include <algorithm>
#include <set>

#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "text/suggest.hpp"

namespace quadrel {
namespace {

/// The channel that a plane of the reference says something of.
std::string judged_name(const std::string& plane) {
    for (const std::string prefix : gpu_range_prefixes)
        if (plane.starts_with(prefix)) return plane.substr(prefix.size());
    return plane;
}

bool is_meant(const std::string& channel, const std::string& request) {
    return channel == request || channel.starts_with(request + ".");
}

}  // namespace

void keep_ranged_channels(const std::string& option, const std::vector<std::string>& requests,
                          Film& reference, Film& test) {
    std::set<std::string> ranged;
    for (const Plane& plane : reference.planes)
        if (judged_name(plane.name) != plane.name) ranged.insert(judged_name(plane.name));
    if (ranged.empty()) return;  // which is said of the reference as a whole
    for (const std::string& request : requests)
        if (std::none_of(ranged.begin(), ranged.end(),
                         [&](const std::string& name) { return is_meant(name, request); }))
            throw UsageError(option + ": the reference holds no range of \"" + request +
                             "\", expected " + one_of(request, ranged));
    // Coverage is judged whatever channels are.
    const auto unwanted = [&](const Plane& plane) {
        if (plane.name == "A" || plane.name == "undecided") return false;
        return std::none_of(requests.begin(), requests.end(), [&](const std::string& request) {
            return is_meant(judged_name(plane.name), request);
        });
    };
    std::erase_if(reference.planes, unwanted);
    std::erase_if(test.planes, unwanted);
}

}  // namespace quadrel
