#include "quadrel/film/film.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "quadrel/check.hpp"

namespace quadrel {

bool contains(const Window& outer, const Window& inner) {
    return outer.x0 <= inner.x0 && outer.y0 <= inner.y0 && inner.x1 <= outer.x1 &&
           inner.y1 <= outer.y1;
}

float Plane::as_float(std::size_t i) const { return std::bit_cast<float>(bits[i]); }

const Plane* Film::find(const std::string& name) const {
    const auto found = std::find_if(planes.begin(), planes.end(),
                                    [&](const Plane& plane) { return plane.name == name; });
    return found == planes.end() ? nullptr : &*found;
}

Plane* Film::find(const std::string& name) {
    return const_cast<Plane*>(std::as_const(*this).find(name));
}

Plane& Film::add(const std::string& name, ChannelType type, std::uint32_t fill) {
    QUADREL_CHECK(find(name) == nullptr, name);
    planes.push_back({name, type, std::vector<std::uint32_t>(window.area(), fill)});
    return planes.back();
}

std::size_t Film::index(int x, int y) const {
    return static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(window.width()) +
           static_cast<std::size_t>(x - window.x0);
}

void canonicalize(Film& film) {
    for (Plane& plane : film.planes)
        if (plane.type == ChannelType::float32)
            for (std::uint32_t& bits : plane.bits) bits = canonical_bits(bits);
}

}  // namespace quadrel
