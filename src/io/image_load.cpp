// Which reader an image file goes to, and what is checked of every image.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>

#include "io/image_readers.hpp"
#include "io/read_file.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

namespace {

namespace fs = std::filesystem;

/// The first bytes of a file that exists and has some.
std::string read_start(const fs::path& file, const std::string& key) {
    const auto refuse = [&](const char* found) {
        throw InputError(file.string(), key, found, "a readable image file");
    };
    if (const char* reason = reason_not_to_read(file)) refuse(reason);
    std::ifstream in(file, std::ios::binary);
    if (!in) refuse("no permission to read");
    std::string start(4, '\0');
    in.read(start.data(), 4);
    start.resize(static_cast<std::size_t>(in.gcount()));
    if (start.empty()) refuse("an empty file");
    return start;
}

void check_finite(Image& image, NotFinite policy, const std::string& key) {
    const auto bad = [](float x) { return !std::isfinite(x); };
    const auto& values = image.values;
    image.not_finite = static_cast<std::uint64_t>(std::count_if(values.begin(), values.end(), bad));
    if (image.not_finite == 0 || policy == NotFinite::count) return;
    const auto first = std::find_if(values.begin(), values.end(), bad);
    const std::int64_t index = first - values.begin(), texel = index / image.channels;
    throw InputError(
        image.file.string(), key,
        fmt::format("{} in channel {} of the texel in column {}, row {} ({} such values)",
                    std::isnan(*first) ? "NaN" : "infinity", index % image.channels,
                    texel % image.width, texel / image.width, image.not_finite),
        "finite texels");
}

}  // namespace

void check_image_size(std::int64_t width, std::int64_t height, std::int64_t channels,
                      const std::string& file, const std::string& key) {
    if (std::min(width, height) >= 1 && std::max(width, height) <= max_image_side &&
        width * height * channels <= max_texture_floats) {
        return;
    }
    throw InputError(file, key,
                     fmt::format("{} x {} pixels of {} channels", width, height, channels),
                     "1 to 65536 pixels a side and at most 2^29 values");
}

Image load_image(const fs::path& file, NotFinite not_finite, const std::string& key) {
    constexpr std::string_view exr_magic = "\x76\x2f\x31\x01";
    const bool is_exr = read_start(file, key) == exr_magic;
    Image image =
        is_exr ? read_exr_image(file.string(), key) : read_other_image(file.string(), key);
    image.file = file;
    check_finite(image, not_finite, key);
    return image;
}

}  // namespace quadrel
