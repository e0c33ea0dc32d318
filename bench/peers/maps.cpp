#include "maps.hpp"

#include <stdlib.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <glm/common.hpp>
#include <system_error>

#include "interruption.hpp"
#include "quadrel/film/exr.hpp"
#include "textures/brick_wall.hpp"

namespace quadrel::peers {
namespace {

constexpr int most_computed = 1024;

/// A film of the channels of `value`, which gives a vector for each texel's centre.
template <class Value>
Film film_of(int side, const std::vector<std::string>& channels, const Value& value) {
    Film film;
    film.frame = film.window = {0, 0, side, side};
    for (const std::string& channel : channels) film.add(channel, ChannelType::float32);
    tbb::parallel_for(0, side, [&](int y) {
        for (int x = 0; x < side; ++x) {
            const glm::dvec4 texel = value(glm::dvec2(x + 0.5, y + 0.5) / double(side));
            for (std::size_t c = 0; c < channels.size(); ++c)
                film.planes[c].bits[film.index(x, y)] =
                    std::bit_cast<std::uint32_t>(static_cast<float>(texel[static_cast<int>(c)]));
        }
    });
    return film;
}

Film wall_heights(int side) {
    return film_of(side, {"Y"}, [](const glm::dvec2& uv) {
        return glm::dvec4(textures::wall_height(uv), 0, 0, 0);
    });
}

/// The heights of `film` between its texels' centres, repeated.
Film enlarged(const Film& film, int side) {
    const int n = film.window.width();
    const auto at = [&](int x, int y) {
        return double(film.planes[0].as_float(film.index((x + n) % n, (y + n) % n)));
    };
    return film_of(side, {"Y"}, [&](const glm::dvec2& uv) {
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
    const Film heights = wall_heights(std::min(side, most_computed));
    write(folder / "height.exr", side > most_computed ? enlarged(heights, side) : heights);
    if (heights_alone) return;
    const int colours = std::min(side, most_computed);
    write(folder / "color.exr", film_of(colours, {"R", "G", "B", "A"}, textures::wall_colour));
    write(folder / "gloss.exr", film_of(colours, {"R", "G", "B"}, [](const glm::dvec2& uv) {
              return glm::dvec4(textures::wall_gloss(uv), 0);
          }));
}

}  // namespace quadrel::peers
