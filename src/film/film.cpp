#include "quadrel/film/film.hpp"

#include <algorithm>
#include <bit>

namespace quadrel {

float Plane::as_float(std::size_t i) const { return std::bit_cast<float>(bits[i]); }

const Plane* Film::find(const std::string& name) const {
    const auto found = std::find_if(planes.begin(), planes.end(),
                                    [&](const Plane& plane) { return plane.name == name; });
    return found == planes.end() ? nullptr : &*found;
}

}  // namespace quadrel
