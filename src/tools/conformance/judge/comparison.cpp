#include "conformance/judge/comparison.hpp"

#include <algorithm>

#include "quadrel/film/channels.hpp"

namespace quadrel::conformance {
namespace {

std::vector<std::string> channels_of(const Film& film) {
    std::vector<std::string> names;
    for (const Plane& plane : film.planes)
        if (find_channel(plane.name) != nullptr) names.push_back(plane.name);
    return names;
}

}  // namespace

Comparison::Comparison(const Scene& of, const Film& by, const JudgeOptions& how)
    : scene(of),
      options(how),
      found(by),
      reruns(of, how.threads),
      reference(reruns.reference(channels_of(by))),
      skipped(by.window.area(), false) {}

bool Comparison::equals(const Film& film, const Group& group, std::size_t i) const {
    return std::ranges::all_of(group.channels,
                               [&](const std::string& name) { return equals(film, name, i); });
}

Film Comparison::given(const std::vector<std::size_t>& pixels) const {
    return part_of(found, earlier, window_around(pixels, found.window));
}

Film Comparison::made_of(const Group& group, const Film& image,
                         const std::vector<std::size_t>& pixels, double heights,
                         double levels) const {
    return reruns.made_of(group.channels, earlier, image,
                          squares_around(pixels, found.window, image.window), heights, levels);
}

}  // namespace quadrel::conformance
