#include <algorithm>

#include "quadrel/error.hpp"
#include "quadrel/film/film.hpp"

namespace quadrel {
namespace {

Window bounding_window(std::span<const Film> parts) {
    Window all = parts[0].window;
    for (const Film& part : parts) {
        all.x0 = std::min(all.x0, part.window.x0);
        all.y0 = std::min(all.y0, part.window.y0);
        all.x1 = std::max(all.x1, part.window.x1);
        all.y1 = std::max(all.y1, part.window.y1);
    }
    return all;
}

bool overlap(const Window& a, const Window& b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/// Disjoint windows whose areas add up to that of their bounding rectangle tile it.
void check_tiling(std::span<const Film> parts, const Window& all) {
    std::size_t area = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        area += parts[i].window.area();
        if (parts[i].frame != parts[0].frame) throw UsageError("join: the frames differ");
        for (std::size_t j = 0; j < i; ++j)
            if (overlap(parts[i].window, parts[j].window))
                throw UsageError("join: two windows overlap");
    }
    if (area != all.area()) throw UsageError("join: the windows leave a gap");
}

void copy_rows(const Film& from, const Plane& source, Film& to, Plane& destination) {
    const std::ptrdiff_t width = from.window.width();
    for (int y = from.window.y0; y < from.window.y1; ++y) {
        const auto begin =
            source.bits.begin() + static_cast<std::ptrdiff_t>(from.index(from.window.x0, y));
        std::copy(
            begin, begin + width,
            destination.bits.begin() + static_cast<std::ptrdiff_t>(to.index(from.window.x0, y)));
    }
}

void copy_part(const Film& part, Film& whole) {
    if (part.planes.size() != whole.planes.size()) throw UsageError("join: the channels differ");
    for (Plane& plane : whole.planes) {
        const Plane* source = part.find(plane.name);
        if (source == nullptr || source->type != plane.type)
            throw UsageError("join: the channels differ: " + plane.name);
        copy_rows(part, *source, whole, plane);
    }
}

}  // namespace

Film join(std::span<const Film> parts) {
    if (parts.empty()) throw UsageError("join: no films");
    Film whole{parts[0].frame, bounding_window(parts), {}};
    check_tiling(parts, whole.window);
    for (const Plane& plane : parts[0].planes) whole.add(plane.name, plane.type);
    for (const Film& part : parts) copy_part(part, whole);
    return whole;
}

}  // namespace quadrel
