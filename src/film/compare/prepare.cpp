#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <set>

#include "file/read_file.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/comparable.hpp"
#include "quadrel/texture/image.hpp"
#include "text/suggest.hpp"
#include "texture/channel_names.hpp"
#include "texture/stored_image.hpp"

namespace quadrel {
namespace {

bool begins_as_exr(const std::filesystem::path& file) {
    std::array<char, 4> start{};
    std::ifstream stream(file, std::ios::binary);
    constexpr std::array<char, 4> magic = {'\x76', '\x2f', '\x31', '\x01'};
    return stream.read(start.data(), start.size()) && start == magic;
}

Storage storage_of(StoredType type) {
    if (type == StoredType::half) return Storage::half;
    return type == StoredType::uint32 ? Storage::uint32 : Storage::float32;
}

Storage storage_of(TexelFormat format) {
    if (format == TexelFormat::unorm8) return Storage::unorm8;
    if (format == TexelFormat::unorm16) return Storage::unorm16;
    return format == TexelFormat::half ? Storage::half : Storage::float32;
}

ComparableImage from_exr(const std::filesystem::path& file, const ImageSelection& selection,
                         const std::optional<Window>& part_of_it) {
    ExrFile exr = read_exr(file, selection, part_of_it);
    ComparableImage result{file, std::move(exr.film), {}, std::move(exr.attributes)};
    for (const auto& [name, type] : exr.stored) result.stored[name] = storage_of(type);
    return result;
}

/// A frame of channels, each filled by fill(channel, its bits).
template <class Fill>
ComparableImage from_channels(const std::filesystem::path& file, const Window& window,
                              const std::vector<std::string>& names, TexelFormat format,
                              const Fill& fill) {
    ComparableImage result{file, {window, window, {}}, {}, {}};
    for (std::size_t channel = 0; channel < names.size(); ++channel) {
        fill(channel, result.film.add(names[channel], ChannelType::float32).bits);
        result.stored[names[channel]] = storage_of(format);
    }
    canonicalize(result.film);
    return result;
}

ComparableImage from_image(const Image& image) {
    const auto channels = static_cast<std::size_t>(image.channels);
    return from_channels(
        image.file, {0, 0, image.width, image.height},
        channel_names(image.luminance, image.channels), image.format,
        [&](std::size_t channel, std::vector<std::uint32_t>& bits) {
            for (std::size_t i = 0; i < bits.size(); ++i)
                bits[i] = std::bit_cast<std::uint32_t>(image.values[i * channels + channel]);
        });
}

/// Without the floats of all channels beside those of the film.
ComparableImage from_stored(const std::filesystem::path& file, const StoredImage& image) {
    const auto channels = static_cast<std::size_t>(image.channels());
    std::vector<float> row(static_cast<std::size_t>(image.width()));
    return from_channels(file, {0, 0, image.width(), image.height()},
                         channel_names(image.is_luminance(), image.channels()), image.format(),
                         [&](std::size_t channel, std::vector<std::uint32_t>& bits) {
                             for (std::size_t i = 0; i < bits.size(); i += row.size()) {
                                 image.decode(i * channels + channel, channels, row.size(),
                                              row.data());
                                 for (std::size_t x = 0; x < row.size(); ++x)
                                     bits[i + x] = std::bit_cast<std::uint32_t>(row[x]);
                             }
                         });
}

/// One channel of the test image under the name it takes.
struct Renaming {
    std::string from, to;
};

std::vector<Renaming> renamings(const Film& film, const ChannelMapping& mapping) {
    if (film.find(mapping.test) != nullptr) return {{mapping.test, mapping.reference}};
    std::vector<Renaming> all;
    const std::string prefix = mapping.test + ".";
    for (const Plane& plane : film.planes)
        if (plane.name.starts_with(prefix))
            all.push_back({plane.name, mapping.reference + plane.name.substr(mapping.test.size())});
    return all;
}

[[noreturn]] void reject_mapping(const ComparableImage& image, const std::string& name) {
    std::vector<std::string> known;
    for (const Plane& plane : image.film.planes) known.push_back(plane.name);
    throw UsageError("--map: " + image.file.string() + " has no channel \"" + name +
                     "\", expected " + one_of(name, known));
}

std::vector<Renaming> all_renamings(const ComparableImage& image,
                                    std::span<const ChannelMapping> mappings) {
    std::vector<Renaming> all;
    for (const ChannelMapping& mapping : mappings) {
        const std::vector<Renaming> some = renamings(image.film, mapping);
        if (some.empty()) reject_mapping(image, mapping.test);
        all.insert(all.end(), some.begin(), some.end());
    }
    std::set<std::string> taken;
    for (const Renaming& renaming : all)
        if (!taken.insert(renaming.to).second)
            throw UsageError("--map: two channels for \"" + renaming.to + "\"");
    return all;
}

bool has_8_bits(Encoding encoding) {
    return encoding == Encoding::unorm8 || encoding == Encoding::srgb8;
}

bool stores_8_bits(const ComparableImage& image, const std::string& name) {
    const auto place = image.stored.find(name);
    return place != image.stored.end() && place->second == Storage::unorm8;
}

/// What `encoding` means for one channel.
Encoding channel_encoding(const ComparableImage& reference, const ComparableImage& test,
                          const std::string& name, Encoding encoding) {
    if (!has_8_bits(encoding)) return encoding;
    const bool color = name == "R" || name == "G" || name == "B" || name == "A";
    if (!color && !stores_8_bits(reference, name) && !stores_8_bits(test, name))
        return Encoding::none;
    return name == "A" ? Encoding::unorm8 : encoding;
}

void encode_plane(const ComparableImage& image, Plane& plane, Encoding encoding) {
    const Storage storage = image.stored.at(plane.name);
    const bool codes = storage == Storage::unorm8 || storage == Storage::unorm16;
    if (storage == Storage::unorm8 && has_8_bits(encoding)) return;
    if (codes)
        throw InputError(image.file.string(), plane.name,
                         fmt::format("{} codes", storage_name(storage)),
                         has_8_bits(encoding) ? "8-bit codes or floats to be encoded"
                                              : "floats to be rounded to half");
    for (std::uint32_t& bits : plane.bits)
        bits = std::bit_cast<std::uint32_t>(encode(encoding, std::bit_cast<float>(bits)));
}

}  // namespace

const char* storage_name(Storage storage) {
    switch (storage) {
        case Storage::unorm8:
            return "unorm8";
        case Storage::unorm16:
            return "unorm16";
        case Storage::half:
            return "half";
        case Storage::float32:
            return "float32";
        case Storage::uint32:
            break;
    }
    return "uint32";
}

std::string storage_text(const ComparableImage& image) {
    std::set<std::string> names;
    for (const Plane& plane : image.film.planes)
        names.insert(storage_name(image.stored.at(plane.name)));
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
    return text;
}

ComparableImage read_comparable(const std::filesystem::path& file, const ImageSelection& selection,
                                const std::optional<Window>& part_of_it) {
    if (const char* const reason = reason_not_to_read(file))
        throw InputError(file.string(), "", reason, "an image file");
    if (begins_as_exr(file)) return from_exr(file, selection, part_of_it);
    if (const auto stored = open_stored_image(file, selection)) return from_stored(file, *stored);
    return from_image(load_image(file, NotFinite::count, "", selection));
}

void flip_y(Film& film) {
    const auto width = static_cast<std::ptrdiff_t>(film.window.width());
    for (Plane& plane : film.planes) {
        auto top = plane.bits.begin(), bottom = plane.bits.end();
        for (; bottom - top >= 2 * width; top += width, bottom -= width)
            std::swap_ranges(top, top + width, bottom - width);
    }
    const int sum = film.frame.y0 + film.frame.y1;
    const Window old = film.window;
    film.window.y0 = sum - old.y1;
    film.window.y1 = sum - old.y0;
}

void map_channels(ComparableImage& image, std::span<const ChannelMapping> mappings) {
    // One channel may go under several names: all but the last are copies.
    std::vector<Renaming> all = all_renamings(image, mappings);
    const std::map<std::string, Storage> stored = image.stored;
    std::vector<Plane> renamed;
    for (std::size_t i = 0; i < all.size(); ++i) {
        Plane& from = *image.film.find(all[i].from);
        const bool again = std::any_of(all.begin() + static_cast<std::ptrdiff_t>(i) + 1, all.end(),
                                       [&](const Renaming& r) { return r.from == all[i].from; });
        Plane& plane = renamed.emplace_back(Plane{all[i].to, from.type, {}});
        if (again)
            plane.bits = from.bits;
        else
            plane.bits = std::move(from.bits);
    }
    std::set<std::string> gone;
    for (const Renaming& renaming : all) {
        gone.insert(renaming.from);
        gone.insert(renaming.to);
    }
    std::erase_if(image.film.planes,
                  [&](const Plane& plane) { return gone.count(plane.name) != 0; });
    std::erase_if(image.stored, [&](const auto& entry) { return gone.count(entry.first) != 0; });
    for (Plane& plane : renamed) image.film.planes.push_back(std::move(plane));
    for (const auto& [from, to] : all) image.stored[to] = stored.at(from);
}

std::map<std::string, Encoding> encode_both(ComparableImage& reference, ComparableImage& test,
                                            Encoding encoding) {
    std::map<std::string, Encoding> encodings;
    if (encoding == Encoding::none) return encodings;
    for (ComparableImage* image : {&reference, &test})
        for (Plane& plane : image->film.planes) {
            if (plane.type == ChannelType::uint32) continue;
            const Encoding own = channel_encoding(reference, test, plane.name, encoding);
            if (own == Encoding::none) continue;
            encode_plane(*image, plane, own);
            encodings[plane.name] = own;
        }
    return encodings;
}

}  // namespace quadrel
