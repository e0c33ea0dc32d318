#include "quadrel/error_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "film/draw.hpp"
#include "quadrel/error.hpp"
#include "quadrel/errors.hpp"

namespace quadrel {
namespace {

/// Powers of two between which a measure is shown, and what they are for people.
struct ErrorScale {
    const char* measure;
    double low, high;
    const char* text;
};
constexpr ErrorScale error_scales[] = {
    {"s", -16, 0, "depth 1/65536 to 1"},       {"uv", -8, 6, "texels 1/256 to 64"},
    {"normal", -7, 7, "degrees 1/128 to 128"}, {"shadow", -8, 0, "1/256 to 1"},
    {"color", -12, 0, "1/4096 to 1"},          {"K", -16, 0, "1/65536 to 1"}};

using Colour = std::array<std::uint8_t, 3>;
/// By ErrorKind. Okabe and Ito's, which those who see fewer colours tell apart, too.
constexpr std::array<Colour, error_kinds> kind_colours{{{40, 40, 40},
                                                        {86, 180, 233},
                                                        {230, 159, 0},
                                                        {0, 158, 115},
                                                        {204, 121, 167},
                                                        {213, 94, 0},
                                                        {120, 120, 120}}};
constexpr const char* kind_legend =
    "dark same, blue late, orange early, red other surface, pink missed, green invented, gray not "
    "judged";

/// "uv" of "err.search.uv", "color" of "err.color.R" as well.
std::string measure_of(const std::string& channel) {
    if (channel.find(".color") != std::string::npos) return "color";
    return channel.substr(channel.rfind('.') + 1);
}

const ErrorScale& error_scale_of(const std::string& channel) {
    const std::string measure = measure_of(channel);
    for (const ErrorScale& scale : error_scales)
        if (measure == scale.measure) return scale;
    throw UsageError(fmt::format("channel \"{}\" is no error that has a picture", channel));
}

std::vector<const Plane*> planes_of(const Film& film, const std::string& channel) {
    std::vector<const Plane*> planes;
    for (const char* suffix : {"", ".R", ".G", ".B"})
        if (const Plane* plane = film.find(channel + suffix)) planes.push_back(plane);
    if (planes.empty()) throw UsageError(fmt::format("the film has no channel \"{}\"", channel));
    return planes;
}

void paint_error(Picture& picture, int x, int y, const ErrorScale& scale, double error) {
    if (std::isnan(error)) return picture.set(x, y, 120, 120, 120);
    if (error == 0) return;
    int exponent = 0;
    const double mantissa = std::frexp(std::min(error, 1e300), &exponent);
    const double power = exponent - 1 + (2 * mantissa - 1);
    if (power < scale.low) return;
    paint_heat(picture, x, y, std::min((power - scale.low) / (scale.high - scale.low), 1.0));
}

Picture kind_picture(const Film& film, const Plane& kinds) {
    const Plane* coverage = film.find("A");
    Picture picture(film.window.width(), film.window.height(), 0);
    for (std::size_t i = 0; i < kinds.bits.size(); ++i) {
        if (kinds.bits[i] >= error_kinds || (coverage && !(coverage->as_float(i) > 0))) continue;
        const Colour& colour = kind_colours[kinds.bits[i]];
        picture.set(static_cast<int>(i % static_cast<std::size_t>(picture.width)),
                    static_cast<int>(i / static_cast<std::size_t>(picture.width)), colour[0],
                    colour[1], colour[2]);
    }
    return picture;
}

}  // namespace

Picture error_picture(const Film& film, const std::string& channel) {
    const std::vector<const Plane*> planes = planes_of(film, channel);
    if (measure_of(channel) == "kind") return kind_picture(film, *planes.front());
    const ErrorScale& scale = error_scale_of(channel);
    Picture picture(film.window.width(), film.window.height(), 0);
    std::size_t i = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x, ++i) {
            double most = 0;
            for (const Plane* plane : planes) {
                const double error = std::fabs(static_cast<double>(plane->as_float(i)));
                if (!(error <= most)) most = error;
            }
            paint_error(picture, x, y, scale, most);
        }
    return picture;
}

Picture error_sheet(const Film& film) {
    std::vector<SheetEntry> entries;
    const auto add = [&](const std::string& channel, const std::string& scale) {
        if (film.find(channel) || film.find(channel + ".R"))
            entries.push_back({channel + ": " + scale, error_picture(film, channel)});
    };
    for (const char* part : {"err.", "err.search.", "err.frame."}) {
        add(std::string(part) + "kind", kind_legend);
        for (const ErrorScale& scale : error_scales)
            if (std::string_view(scale.measure) != "s")
                add(part + std::string(scale.measure), scale.text);
    }
    return contact_sheet(entries, 5);
}

}  // namespace quadrel
