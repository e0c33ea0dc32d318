// Integers beside floats: render targets of a port are floats more often than not.
#include <bit>

#include "quadrel/film/comparable.hpp"

namespace quadrel {
namespace {

void integers_to_floats(Plane& plane) {
    if (plane.type == ChannelType::float32) return;
    plane.type = ChannelType::float32;
    for (std::uint32_t& bits : plane.bits)
        bits = std::bit_cast<std::uint32_t>(static_cast<float>(bits));
}

/// -0 is the value 0, whose bits an integer gives.
void drop_zero_signs(Plane& plane) {
    for (std::uint32_t& bits : plane.bits)
        if (bits == 0x80000000u) bits = 0;
}

}  // namespace

std::vector<std::string> compare_by_value(Film& reference, Film& test) {
    std::vector<std::string> names;
    for (Plane& plane : reference.planes) {
        Plane* other = test.find(plane.name);
        if (other == nullptr || other->type == plane.type) continue;
        for (Plane* one : {&plane, other}) {
            integers_to_floats(*one);
            drop_zero_signs(*one);
        }
        names.push_back(plane.name);
    }
    return names;
}

}  // namespace quadrel
