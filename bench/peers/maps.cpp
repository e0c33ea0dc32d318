#include "maps.hpp"

#include <stdlib.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <glm/common.hpp>
#include <system_error>

#include "interruption.hpp"
#include "quadrel/film/exr.hpp"
#include "sweep/plan/map_kinds.hpp"
#include "textures/brick_wall.hpp"

namespace quadrel::peers {
namespace {

constexpr int most_computed = 1024;

/// A film of the channels of `value`, which gives a vector for each texel's centre.
template <class Value>
Film film_of(glm::ivec2 size, const std::vector<std::string>& channels, const Value& value) {
    Film film;
    film.frame = film.window = {0, 0, size.x, size.y};
    for (const std::string& channel : channels) film.add(channel, ChannelType::float32);
    tbb::parallel_for(0, size.y, [&](int y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::dvec4 texel = value(glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(size));
            for (std::size_t c = 0; c < channels.size(); ++c)
                film.planes[c].bits[film.index(x, y)] =
                    std::bit_cast<std::uint32_t>(static_cast<float>(texel[static_cast<int>(c)]));
        }
    });
    return film;
}

Film wall_heights(glm::ivec2 size) {
    return film_of(size, {"Y"}, [](const glm::dvec2& uv) {
        return glm::dvec4(textures::wall_height(uv), 0, 0, 0);
    });
}

/// The heights of `film` between its texels' centres, repeated.
Film enlarged(const Film& film, int side) {
    const int n = film.window.width();
    const auto at = [&](int x, int y) {
        return double(film.planes[0].as_float(film.index((x + n) % n, (y + n) % n)));
    };
    return film_of(glm::ivec2(side), {"Y"}, [&](const glm::dvec2& uv) {
        const glm::dvec2 place = uv * double(n) - 0.5, cell = floor(place), part = place - cell;
        const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
        const double low = glm::mix(at(x, y), at(x + 1, y), part.x);
        const double high = glm::mix(at(x, y + 1), at(x + 1, y + 1), part.x);
        return glm::dvec4(glm::mix(low, high, part.y), 0, 0, 0);
    });
}

void write(const std::filesystem::path& file, const Film& film) {
    write_exr(file, film, {}, {ExrCompression::none, 0});
}

void write_colours(const std::filesystem::path& folder, glm::ivec2 size) {
    write(folder / "color.exr", film_of(size, {"R", "G", "B", "A"}, textures::wall_colour));
    write(folder / "gloss.exr", film_of(size, {"R", "G", "B"}, [](const glm::dvec2& uv) {
              return glm::dvec4(textures::wall_gloss(uv), 0);
          }));
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "quadrel-peers-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw std::system_error(errno, std::generic_category(), name);
    path_ = name;
    remove_if_interrupted(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    forget_if_interrupted(path_);
}

void write_wall(const std::filesystem::path& folder, int side, bool heights_alone) {
    const int computed = std::min(side, most_computed);
    const Film heights = wall_heights(glm::ivec2(computed));
    write(folder / "height.exr", side > computed ? enlarged(heights, side) : heights);
    if (!heights_alone) write_colours(folder, glm::ivec2(computed));
}

void write_wall(const std::filesystem::path& folder, glm::ivec2 size) {
    write(folder / "height.exr", wall_heights(size));
    write_colours(folder, size);
}

void write_heights(const std::filesystem::path& file, const std::string& kind, int side) {
    const sweep::MapKind* const found = sweep::find_map_kind(kind);
    if (found == nullptr) throw std::invalid_argument("no kind of map: " + kind);
    sweep::MapValues values;
    for (const auto& parameter : found->parameters)
        values[std::string(parameter.name)] = parameter.standard;
    const std::vector<float> heights = found->make(side, values);
    write(file, film_of(glm::ivec2(side), {"Y"}, [&](const glm::dvec2& uv) {
              const glm::ivec2 texel(uv * double(side));
              return glm::dvec4(heights[static_cast<std::size_t>(texel.y * side + texel.x)], 0, 0,
                                0);
          }));
}

}  // namespace quadrel::peers
