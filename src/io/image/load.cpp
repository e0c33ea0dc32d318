// Which reader an image file goes to, and what is checked of every image.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "io/gltf/container.hpp"
#include "io/image/readers.hpp"
#include "quadrel/error.hpp"
#include "texture/image_bytes.hpp"

namespace quadrel {

namespace {

namespace fs = std::filesystem;

constexpr const char* readable_image = "a readable image file";

/// The first bytes of a file that has some.
std::string read_start(const FileBytes& file, const std::string& key) {
    std::string start(8, '\0');
    start.resize(file.read(0, start.data(), start.size()));
    if (start.empty()) throw InputError(file.file().string(), key, "an empty file", readable_image);
    return start;
}

void check_finite(Image& image, NotFinite policy, const std::string& key) {
    const auto bad = [](float x) {
        constexpr std::uint32_t exponent = 0x7f800000u;
        return (std::bit_cast<std::uint32_t>(x) & exponent) == exponent;
    };
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

namespace {

/// KTX 2 begins with these bytes. OpenImageIO does not know it and would name no reason.
constexpr std::string_view ktx2_start = "\xabKTX 20\xbb";

/// Refuses what no reader is asked for.
void check_other_than_exr(const std::string& file, std::string_view start,
                          const ImageSelection& selection, const std::string& key) {
    if (!selection.empty())
        throw InputError(
            file, key,
            fmt::format("a file without {}", selection.part.empty() ? "layers" : "parts"),
            "an EXR file");
    if (start == ktx2_start)
        throw InputError(file, key, "a KTX2 file, which Quadrel does not read",
                         "DDS, or another image file");
}

Image read_other_than_exr(const std::string& file, std::string_view start,
                          const ImageSelection& selection, const std::string& key) {
    check_other_than_exr(file, start, selection, key);
    if (start.starts_with("BM"))
        if (auto image = read_packed_bitmap(file, key)) return *std::move(image);
    return read_other_image(file, key).decoded();
}

constexpr std::string_view exr_magic = "\x76\x2f\x31\x01";

}  // namespace

Image load_image(const FileBytes& file, NotFinite not_finite, const std::string& key,
                 const ImageSelection& selection) {
    const std::string start = read_start(file, key);
    Image image = start.starts_with(exr_magic) ? read_exr_image(file, selection, key)
                  : is_gltf_file(file.file())
                      ? read_embedded_image(file, selection, key)
                      : read_other_than_exr(file.file().string(), start, selection, key);
    image.file = file.file();
    check_finite(image, not_finite, key);
    return image;
}

Image load_image(const fs::path& file, NotFinite not_finite, const std::string& key,
                 const ImageSelection& selection) {
    return load_image(FileBytes(file, key, readable_image), not_finite, key, selection);
}

std::optional<StoredImage> open_stored_image(const fs::path& file,
                                             const ImageSelection& selection) {
    const std::string start = read_start(FileBytes(file, "", readable_image), "");
    if (start.starts_with(exr_magic) || start.starts_with("BM")) return std::nullopt;
    check_other_than_exr(file.string(), start, selection, "");
    return read_other_image(file.string(), "");
}

}  // namespace quadrel
