#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>

#include <algorithm>

#include "io/exr/attributes.hpp"
#include "io/exr/limits.hpp"
#include "io/exr/open.hpp"
#include "io/exr/pixels.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {
namespace {

constexpr std::int64_t largest_side = 65536;
constexpr std::int64_t most_values = std::int64_t{1} << 31;

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& key,
                         const std::string& found, const std::string& expected) {
    throw InputError(file.string(), key, found, expected);
}

/// Computed in 64 bits: a damaged header may hold any integers.
Window half_open(const std::filesystem::path& file, const char* key, const Imath::Box2i& box) {
    const std::int64_t width = std::int64_t{box.max.x} - box.min.x + 1;
    const std::int64_t height = std::int64_t{box.max.y} - box.min.y + 1;
    constexpr int limit = 1 << 30;
    const bool near =
        box.min.x > -limit && box.min.y > -limit && box.max.x < limit && box.max.y < limit;
    if (!near || width < 1 || height < 1 || width > largest_side || height > largest_side)
        reject(file, key, std::to_string(width) + "x" + std::to_string(height) + " pixels",
               "1 to 65536 a side");
    return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
}

StoredType stored_type(Imf::PixelType type) {
    if (type == Imf::HALF) return StoredType::half;
    return type == Imf::UINT ? StoredType::uint32 : StoredType::float32;
}

/// A plane for each channel of the choice, without values yet.
void add_planes(const std::filesystem::path& file, const Imf::Header& header,
                const std::string& prefix, ExrFile& result) {
    const std::vector<std::string> names = exr_channels(header, prefix);
    if (names.empty()) reject(file, "", "no channels", "channels");
    const auto values = static_cast<std::int64_t>(result.film.window.area() * names.size());
    const std::int64_t most = std::min(most_values, most_exr_values(file, header));
    if (values > most)
        reject(file, "", std::to_string(values) + " values", "at most " + std::to_string(most));
    for (const std::string& name : names) {
        const Imf::Channel& channel = header.channels()[(prefix + name).c_str()];
        if (channel.xSampling != 1 || channel.ySampling != 1)
            reject(file, prefix + name, "a sub-sampled channel", "one value a pixel");
        const bool integer = channel.type == Imf::UINT;
        result.film.add(name, integer ? ChannelType::uint32 : ChannelType::float32);
        result.stored[name] = stored_type(channel.type);
    }
}

void read_planes(ExrPixels& pixels, Film& film) {
    const Window& window = film.window;
    pixels.read(window.y0, window.y1, [&](const ExrRun& run) {
        const auto to = film.planes[run.channel].bits.begin() +
                        static_cast<std::ptrdiff_t>(film.index(run.x, run.y));
        std::copy_n(run.bits, run.count, to);
    });
    canonicalize(film);
}

ExrFile read_chosen(const std::filesystem::path& file, const ImageSelection& selection) {
    const ExrHeaders headers = read_exr_headers(file, "");
    const ExrChoice choice = choose_exr(headers, selection, file, "");
    const Imf::Header& header = headers.parts[static_cast<std::size_t>(choice.part)];
    ExrFile result;
    result.parts = headers.names();
    result.film.frame = half_open(file, "displayWindow", header.displayWindow());
    result.film.window = half_open(file, "dataWindow", header.dataWindow());
    result.attributes = read_attributes(header);
    add_planes(file, header, choice.prefix, result);
    std::vector<std::string> names;
    for (const Plane& plane : result.film.planes) names.push_back(choice.prefix + plane.name);
    read_planes(*open_exr_pixels(file, choice.part, names), result.film);
    return result;
}

}  // namespace

ExrFile read_exr(const std::filesystem::path& file, const ImageSelection& selection) {
    ExrFile result;
    reading_exr(file, "", [&] { result = read_chosen(file, selection); });
    return result;
}

std::vector<ExrPartInfo> exr_parts(const std::filesystem::path& file) {
    std::vector<ExrPartInfo> parts;
    for (const Imf::Header& header : read_exr_headers(file, "").parts)
        parts.push_back({header.hasName() ? header.name() : "",
                         half_open(file, "displayWindow", header.displayWindow()),
                         half_open(file, "dataWindow", header.dataWindow()),
                         exr_channels(header, ""), read_attributes(header)});
    return parts;
}

}  // namespace quadrel
