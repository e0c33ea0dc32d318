#include "film/bits/codes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "quadrel/error.hpp"

namespace quadrel {

std::string Codes::names() const {
    std::string text;
    for (const Plane& plane : image_.film.planes) text += (text.empty() ? "" : " ") + plane.name;
    return text;
}

std::uint32_t Codes::at(const std::string& channel, int bits, std::size_t i) const {
    const Plane* const plane = image_.film.find(channel);
    if (plane == nullptr)
        reject(fmt::format("channels {} alone", names()), fmt::format("also {}", channel));
    const std::uint32_t most = (1u << bits) - 1;
    if (plane->type == ChannelType::uint32) {
        if (plane->bits[i] <= most) return plane->bits[i];
        reject(i, channel, std::to_string(plane->bits[i]), fmt::format("codes up to {}", most));
    }
    const double steps = double{plane->as_float(i)} * most, code = std::nearbyint(steps);
    // A half is rounded by up to 2^-12, a quarter of a step of 10 bits.
    const double most_apart = storage() == Storage::half ? 0.3 : 0.125;
    if (!(std::fabs(steps - code) <= most_apart && code >= 0 && code <= most))
        reject(i, channel, fmt::format("{}", plane->as_float(i)),
               fmt::format("a code of {} bits, k / {}", bits, most));
    return static_cast<std::uint32_t>(code);
}

void Codes::reject(std::size_t i, const std::string& key, const std::string& found,
                   const std::string& expected) const {
    const auto columns = static_cast<std::size_t>(width());
    throw InputError(image_.file.string(), key,
                     fmt::format("{} at {},{}", found, i % columns, i / columns), expected);
}

void Codes::reject(const std::string& found, const std::string& expected) const {
    throw InputError(image_.file.string(), "", found, expected);
}

bool Codes::is_everywhere(const std::string& channel, std::uint32_t code) const {
    for (std::size_t i = 0; i < image_.film.window.area(); ++i)
        if (at(channel, 8, i) != code) return false;
    return true;
}

bool Codes::are_codes(const char* channel, int bits) const {
    const Plane& plane = *image_.film.find(channel);
    const double most = (1 << bits) - 1;
    for (std::size_t i = 0; i < plane.bits.size(); ++i) {
        // Rounded down or to the nearest of 65535.
        const double steps = double{plane.as_float(i)} * most;
        if (!(std::fabs(steps - std::nearbyint(steps)) < most / 60000)) return false;
    }
    return true;
}

bool Codes::is_constant(const char* channel, float value) const {
    const Plane& plane = *image_.film.find(channel);
    for (std::size_t i = 0; i < plane.bits.size(); ++i)
        if (plane.as_float(i) != value) return false;
    return true;
}

bool Codes::are_of_ten_bits() const {
    for (const char* channel : {"R", "G", "B", "A"})
        if (!has(channel)) return false;
    if (is_constant("B", 0) && is_constant("A", 1)) return false;
    return are_codes("R", 10) && are_codes("G", 10) && are_codes("B", 10) && are_codes("A", 2);
}

bool Codes::has_check_bytes() const {
    for (std::size_t i = 0; i < image_.film.window.area(); ++i) {
        const std::uint32_t half = at("R", 8, i) | at("G", 8, i) << 8, check = at("B", 8, i);
        if (check != check_byte(half, false) && check != check_byte(half, true)) return false;
    }
    return true;
}

}  // namespace quadrel
