// Words of the command line that `advise` takes.
#include <charconv>
#include <string_view>

#include "quadrel/error.hpp"
#include "sweep/advise.hpp"

namespace quadrel::sweep {
namespace {

bool read_number(std::string_view text, double& number) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && stop == text.data() + text.size();
}

constexpr double steepest_angle = 89.5;

[[noreturn]] void refuse_angles(const std::string& text) {
    throw UsageError("--angles: found \"" + text +
                     "\", expected degrees from 0 to 89.5, ascending: 0..75, 0..75:5 or 0,30,60");
}

std::vector<double> range_of(const std::string& text, std::size_t dots) {
    const std::size_t colon = text.find(':');
    double from = 0, to = 0, step = 15;
    if (!read_number(std::string_view(text).substr(0, dots), from) ||
        !read_number(std::string_view(text).substr(dots + 2, colon - std::min(colon, dots + 2)),
                     to))
        refuse_angles(text);
    if (colon != std::string::npos && !read_number(std::string_view(text).substr(colon + 1), step))
        refuse_angles(text);
    if (!(step >= 0.5) || !(from <= to)) refuse_angles(text);
    std::vector<double> angles;
    for (double angle = from; angle < to && angles.size() < 1000; angle += step)
        angles.push_back(angle);
    angles.push_back(to);
    return angles;
}

std::vector<double> list_of(const std::string& text) {
    std::vector<double> angles;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t comma = std::min(text.find(',', start), text.size());
        double angle = 0;
        if (!read_number(std::string_view(text).substr(start, comma - start), angle))
            refuse_angles(text);
        angles.push_back(angle);
        start = comma + 1;
    }
    return angles;
}

}  // namespace

double parse_texels(const std::string& text) {
    std::string_view number = text;
    for (const std::string_view unit : {"texels", "texel"})
        if (number.ends_with(unit)) {
            number.remove_suffix(unit.size());
            break;
        }
    double texels = 0;
    if (!read_number(number, texels) || !(texels > 0) || !(texels <= 1e6))
        throw UsageError("--error: found \"" + text + "\", expected a distance as 0.5texel");
    return texels;
}

std::vector<double> parse_angles(const std::string& text) {
    const std::size_t dots = text.find("..");
    const std::vector<double> angles =
        dots == std::string::npos ? list_of(text) : range_of(text, dots);
    for (std::size_t i = 0; i < angles.size(); ++i)
        if (!(angles[i] >= 0) || angles[i] > steepest_angle ||
            (i > 0 && angles[i] <= angles[i - 1]))
            refuse_angles(text);
    return angles;
}

}  // namespace quadrel::sweep
