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

/// A part that is about to be read.
struct Opened {
    ExrFile file;  ///< all but planes; its film's window is the data window
    std::vector<std::string> names;
    std::vector<ChannelType> types;
    std::unique_ptr<ExrPixels> pixels;
};

void add_channels(const FileBytes& bytes, const Imf::Header& header, const std::string& prefix,
                  Opened& opened) {
    const std::filesystem::path& file = bytes.file();
    opened.names = exr_channels(header, prefix);
    if (opened.names.empty()) reject(file, "", "no channels", "channels");
    const auto values =
        static_cast<std::int64_t>(opened.file.film.window.area() * opened.names.size());
    const std::int64_t most = most_exr_values(bytes, header);
    if (values > most)
        reject(file, "", std::to_string(values) + " values", "at most " + std::to_string(most));
    for (const std::string& name : opened.names) {
        const Imf::Channel& channel = header.channels()[(prefix + name).c_str()];
        if (channel.xSampling != 1 || channel.ySampling != 1)
            reject(file, prefix + name, "a sub-sampled channel", "one value a pixel");
        opened.types.push_back(channel.type == Imf::UINT ? ChannelType::uint32
                                                         : ChannelType::float32);
        opened.file.stored[name] = stored_type(channel.type);
    }
}

Opened open_chosen(const FileBytes& bytes, const ImageSelection& selection) {
    const std::filesystem::path& file = bytes.file();
    const ExrHeaders headers = read_exr_headers(bytes, "");
    const ExrChoice choice = choose_exr(headers, selection, file, "");
    const Imf::Header& header = headers.parts[static_cast<std::size_t>(choice.part)];
    Opened opened;
    opened.file.parts = headers.names();
    opened.file.film.frame = half_open(file, "displayWindow", header.displayWindow());
    opened.file.film.window = half_open(file, "dataWindow", header.dataWindow());
    opened.file.attributes = read_attributes(header);
    add_channels(bytes, header, choice.prefix, opened);
    std::vector<std::string> full_names;
    for (const std::string& name : opened.names) full_names.push_back(choice.prefix + name);
    opened.pixels = open_exr_pixels(bytes, choice.part, full_names);
    return opened;
}

void add_planes(const Opened& opened, Film& film) {
    for (std::size_t c = 0; c < opened.names.size(); ++c)
        film.add(opened.names[c], opened.types[c]);
}

/// The pixels of the film's window.
void read_planes(ExrPixels& pixels, Film& film) {
    const Window& window = film.window;
    pixels.read(window.y0, window.y1, [&](const ExrRun& run) {
        if (run.y < window.y0 || run.y >= window.y1) return;
        const int x0 = std::max(run.x, window.x0), x1 = std::min(run.x + run.count, window.x1);
        if (x0 >= x1) return;
        const auto to = film.planes[run.channel].bits.begin() +
                        static_cast<std::ptrdiff_t>(film.index(x0, run.y));
        std::copy(run.bits + (x0 - run.x), run.bits + (x1 - run.x), to);
    });
    canonicalize(film);
}

ExrFile read_chosen(const FileBytes& bytes, const ImageSelection& selection,
                    const std::optional<Window>& part_of_it) {
    Opened opened = open_chosen(bytes, selection);
    Film& film = opened.file.film;
    if (part_of_it && contains(film.window, *part_of_it)) film.window = *part_of_it;
    const auto values = static_cast<std::int64_t>(film.window.area() * opened.names.size());
    if (values > most_film_values)
        reject(bytes.file(), "", std::to_string(values) + " values",
               "at most 2^31 at a time, a part of the image");
    add_planes(opened, film);
    read_planes(*opened.pixels, film);
    return std::move(opened.file);
}

/// So many rows are whole chunks of any compression.
constexpr int band_rows = 256;

ExrFile read_bands(const FileBytes& bytes, const ImageSelection& selection,
                   const std::function<void(const Film& band)>& take) {
    Opened opened = open_chosen(bytes, selection);
    const Window all = opened.file.film.window;
    Film band;
    band.frame = opened.file.film.frame;
    for (int y = all.y0; y < all.y1; y += band_rows) {
        band.window = {all.x0, y, all.x1, std::min(y + band_rows, all.y1)};
        if (band.planes.empty()) add_planes(opened, band);
        for (Plane& plane : band.planes) plane.bits.resize(band.window.area());
        read_planes(*opened.pixels, band);
        take(band);
    }
    for (std::size_t c = 0; c < opened.names.size(); ++c)
        opened.file.film.planes.push_back({opened.names[c], opened.types[c], {}});
    return std::move(opened.file);
}

}  // namespace

ExrFile read_exr(const std::filesystem::path& file, const ImageSelection& selection,
                 const std::optional<Window>& part_of_it) {
    const FileBytes bytes(file, "", "an EXR file");
    ExrFile result;
    reading_exr(file, "", [&] { result = read_chosen(bytes, selection, part_of_it); });
    return result;
}

ExrFile read_exr_in_bands(const std::filesystem::path& file, const ImageSelection& selection,
                          const std::function<void(const Film& band)>& take) {
    const FileBytes bytes(file, "", "an EXR file");
    ExrFile result;
    reading_exr(file, "", [&] { result = read_bands(bytes, selection, take); });
    return result;
}

std::vector<ExrPartInfo> exr_parts(const std::filesystem::path& file) {
    const FileBytes bytes(file, "", "an EXR file");
    std::vector<ExrPartInfo> parts;
    for (const Imf::Header& header : read_exr_headers(bytes, "").parts)
        parts.push_back({header.hasName() ? header.name() : "",
                         half_open(file, "displayWindow", header.displayWindow()),
                         half_open(file, "dataWindow", header.dataWindow()),
                         exr_channels(header, ""), read_attributes(header)});
    return parts;
}

}  // namespace quadrel
