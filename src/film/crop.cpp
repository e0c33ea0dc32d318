#include <algorithm>

#include "quadrel/check.hpp"
#include "quadrel/film/film.hpp"

namespace quadrel {

Window intersection(const Window& a, const Window& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

void crop(Film& film, const Window& window) {
    QUADREL_CHECK(contains(film.window, window), window.x0);
    if (window == film.window) return;
    const std::ptrdiff_t width = window.width();
    for (Plane& plane : film.planes) {
        // Rows move towards the front only, so that none is overwritten before it is read.
        auto to = plane.bits.begin();
        for (int y = window.y0; y < window.y1; ++y, to += width) {
            const auto from =
                plane.bits.begin() + static_cast<std::ptrdiff_t>(film.index(window.x0, y));
            std::copy(from, from + width, to);
        }
        plane.bits.resize(window.area());
        plane.bits.shrink_to_fit();
    }
    film.window = window;
}

}  // namespace quadrel
