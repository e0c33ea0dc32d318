#include "conformance/judge/rounding.hpp"

#include <algorithm>
#include <cmath>

namespace quadrel::conformance {
namespace {

/// What a component belongs to: "N" of N.X, "hit.UV" of hit.U, "color" of all of its terms.
std::string vector_of(const std::string& name) {
    if (name == "R" || name == "G" || name == "B" || name.starts_with("light."))
        return "color";  // whose terms these are
    if (name == "hit.U" || name == "hit.V") return "hit.UV";
    const std::size_t dot = name.rfind('.');
    const bool is_component = dot != std::string::npos && dot + 2 == name.size() &&
                              std::string("XYZUVRGB").find(name.back()) != std::string::npos;
    return is_component ? name.substr(0, dot) : name;
}

/// The largest size among them.
double longest_of(const std::vector<const Plane*>& planes, std::size_t pixel) {
    double longest = 0;
    for (const Plane* plane : planes)
        longest = std::max(longest, std::fabs(static_cast<double>(plane->as_float(pixel))));
    return longest;
}

}  // namespace

Roundings::Roundings(const Film& film, const std::vector<std::string>& channels,
                     const PermittedErrors& errors)
    : rounding_(errors.rounding) {
    for (const std::string& name : channels) {
        Channel& channel = channels_.emplace_back();
        if (film.find(name)->type != ChannelType::float32) continue;
        if (name == "hit.s") channel.least = errors.height;
        for (const Plane& plane : film.planes) {
            if (vector_of(plane.name) == vector_of(name)) channel.vector.push_back(&plane);
            if (vector_of(name) == "K" && plane.name.starts_with("J."))
                channel.gradients.push_back(&plane);
        }
        if (vector_of(name) == "K") channel.depth = film.find("relief.depth");
    }
}

double Roundings::of(std::size_t channel, std::size_t pixel) const {
    const Channel& of = channels_[channel];
    const double depth = of.depth != nullptr ? std::fabs(of.depth->as_float(pixel)) : 0;
    const double longest =
        std::max(longest_of(of.vector, pixel), depth * longest_of(of.gradients, pixel));
    return std::max(rounding_ * longest, of.least);
}

}  // namespace quadrel::conformance
