#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "io/exr_attributes.hpp"
#include "io/exr_limits.hpp"
#include "io/out_of_memory.hpp"
#include "io/read_file.hpp"
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

/// OpenEXR says little about files that are no EXR at all; this does.
void check_is_exr(const std::filesystem::path& file) {
    if (const char* reason = reason_not_to_read(file)) reject(file, "", reason, "an EXR file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) reject(file, "", "a file that cannot be opened", "an EXR file");
    char magic[4] = {};
    if (!stream.read(magic, 4) || !Imf::isImfMagic(magic))
        reject(file, "", "something else", "an EXR file");
    check_exr_attributes(file, "");
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

std::vector<std::string> part_names(const Imf::MultiPartInputFile& input) {
    std::vector<std::string> names;
    for (int part = 0; part < input.parts(); ++part)
        names.push_back(input.header(part).hasName() ? input.header(part).name() : "");
    return names;
}

StoredType stored_type(Imf::PixelType type) {
    if (type == Imf::HALF) return StoredType::half;
    return type == Imf::UINT ? StoredType::uint32 : StoredType::float32;
}

/// The channels of a layer, or all of them when `prefix` is empty; film names lack the prefix.
void add_planes(const std::filesystem::path& file, const Imf::Header& header,
                const std::string& prefix, ExrFile& result) {
    std::vector<std::pair<std::string, Imf::PixelType>> wanted;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
        const std::string name = i.name();
        if (name.compare(0, prefix.size(), prefix) != 0) continue;
        if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
            reject(file, name, "a sub-sampled channel", "one value a pixel");
        wanted.emplace_back(name.substr(prefix.size()), i.channel().type);
    }
    if (wanted.empty())
        reject(file, prefix, "no such channels", prefix.empty() ? "channels" : "a part or layer");
    const auto values = static_cast<std::int64_t>(result.film.window.area() * wanted.size());
    const std::int64_t most = std::min(most_values, most_exr_values(file, header));
    if (values > most)
        reject(file, "", std::to_string(values) + " values", "at most " + std::to_string(most));
    for (const auto& [name, type] : wanted) {
        const bool integer = type == Imf::UINT;
        result.film.add(name, integer ? ChannelType::uint32 : ChannelType::float32);
        result.stored[name] = stored_type(type);
    }
}

void read_pixels(Imf::InputPart& part, const std::string& prefix, Film& film) {
    const Imath::Box2i box = part.header().dataWindow();
    Imf::FrameBuffer buffer;
    for (Plane& plane : film.planes) {
        const auto type = plane.type == ChannelType::uint32 ? Imf::UINT : Imf::FLOAT;
        buffer.insert(prefix + plane.name, Imf::Slice::Make(type, plane.bits.data(), box));
    }
    part.setFrameBuffer(buffer);
    part.readPixels(box.min.y, box.max.y);
    canonicalize(film);
}

ExrFile read_part(const std::filesystem::path& file, const std::string& layer) {
    Imf::MultiPartInputFile input(file.c_str(), 0, false);
    ExrFile result;
    result.parts = part_names(input);
    int index = 0;
    std::string prefix = layer.empty() ? "" : layer + ".";
    for (int part = 0; part < input.parts(); ++part)
        if (!layer.empty() && result.parts[static_cast<std::size_t>(part)] == layer) {
            index = part;
            prefix.clear();
        }
    const Imf::Header& header = input.header(index);
    if (header.hasType() && Imf::isDeepData(header.type()))
        reject(file, "", "a deep image", "a flat image");
    result.film.frame = half_open(file, "displayWindow", header.displayWindow());
    result.film.window = half_open(file, "dataWindow", header.dataWindow());
    result.attributes = read_attributes(header);
    add_planes(file, header, prefix, result);
    Imf::InputPart part(input, index);
    read_pixels(part, prefix, result.film);
    return result;
}

}  // namespace

ExrFile read_exr(const std::filesystem::path& file, const std::string& layer) {
    check_is_exr(file);
    try {
        return read_part(file, layer);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        rethrow_out_of_memory(error);
        reject(file, "", std::string("a damaged file (") + error.what() + ")", "a whole EXR file");
    }
}

}  // namespace quadrel
