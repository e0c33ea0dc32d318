#include "sweep/made_maps.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <map>

#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/texture/image.hpp"
#include "sweep/plan/map_kinds.hpp"
#include "sweep/sweep.hpp"

namespace quadrel::sweep {
namespace {

std::uint32_t bits(double value) { return std::bit_cast<std::uint32_t>(static_cast<float>(value)); }

/// Whether the file holds this film: it may have been cut short since it was written.
bool holds(const std::filesystem::path& file, const Film& film) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return false;
    try {
        return film_hash(read_exr(file).film) == film_hash(film);
    } catch (const InputError&) {
        return false;
    }
}

std::filesystem::path write_by_content(const std::filesystem::path& folder, const std::string& name,
                                       const Film& film) {
    make_folder(folder);
    const std::filesystem::path file =
        folder /
        fmt::format("{}-{}-{}.exr", name, film.window.width(), film_hash(film).substr(0, 12));
    if (!holds(file, film)) write_exr(file, film, {}, {ExrCompression::zip, 1});
    return file;
}

struct Normal {
    double x, y, z;
};

/// (-dh/du, -dh/dv, 1 / depth), normalised.
Normal normal_at(const Image& image, int x, int y, double depth) {
    const auto at = [&](int i, int j) {
        const int column = (i + image.width) % image.width, row = (j + image.height) % image.height;
        return double(
            image.values[static_cast<std::size_t>((row * image.width + column) * image.channels)]);
    };
    const double dx = -(at(x + 1, y) - at(x - 1, y)) * 0.5 * image.width * depth;
    const double dy = -(at(x, y + 1) - at(x, y - 1)) * 0.5 * image.height * depth;
    const double length = std::sqrt(dx * dx + dy * dy + 1);
    return {dx / length, dy / length, 1 / length};
}

}  // namespace

std::filesystem::path write_made_map(const std::filesystem::path& folder, const PlannedMap& map) {
    const std::vector<float> heights = find_map_kind(map.kind)->make(map.size, map.parameters);
    Film film;
    film.frame = film.window = {0, 0, map.size, map.size};
    Plane& plane = film.add("Y", ChannelType::float32);
    for (std::size_t i = 0; i < heights.size(); ++i) plane.bits[i] = bits(heights[i]);
    return write_by_content(folder, map.kind, film);
}

std::filesystem::path write_normal_map(const std::filesystem::path& folder,
                                       const std::filesystem::path& heights, double depth) {
    const Image image = load_image(heights, NotFinite::count);
    Film film;
    film.frame = film.window = {0, 0, image.width, image.height};
    for (const char* channel : {"R", "G", "B"}) film.add(channel, ChannelType::float32);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Normal n = normal_at(image, x, y, depth);
            const std::size_t i = film.index(x, y);
            film.planes[0].bits[i] = bits(0.5 + 0.5 * (std::isfinite(n.x) ? n.x : 0));
            film.planes[1].bits[i] = bits(0.5 + 0.5 * (std::isfinite(n.y) ? n.y : 0));
            film.planes[2].bits[i] = bits(0.5 + 0.5 * (std::isfinite(n.z) ? n.z : 1));
        }
    return write_by_content(folder, "normal", film);
}

MapSize size_of_map(const std::filesystem::path& file) {
    static std::map<std::filesystem::path, MapSize> known;
    const auto found = known.find(file);
    if (found != known.end()) return found->second;
    const Image image = load_image(file, NotFinite::count);
    return known[file] = {image.width, image.height};
}

}  // namespace quadrel::sweep
