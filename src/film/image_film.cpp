#include "film/image_film.hpp"

#include <bit>

#include "texture/channel_names.hpp"

namespace quadrel {

Film image_film(const Image& image, bool gray) {
    const std::vector<std::string> names = channel_names(gray, image.channels);
    const auto channels = static_cast<std::size_t>(image.channels);
    Film film;
    film.frame = film.window = {0, 0, image.width, image.height};
    for (std::size_t c = 0; c < channels; ++c) {
        Plane& plane = film.add(names[c], ChannelType::float32);
        for (std::size_t i = 0; i < plane.bits.size(); ++i)
            plane.bits[i] = std::bit_cast<std::uint32_t>(image.values[i * channels + c]);
    }
    return film;
}

}  // namespace quadrel
