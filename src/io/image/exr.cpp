// Reads EXR images as textures, through OpenEXR.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

#include "io/exr/limits.hpp"
#include "io/exr/open.hpp"
#include "io/exr/pixels.hpp"
#include "io/image/readers.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

namespace {

struct PixelBox {
    std::int64_t min_x, min_y, width, height;
};

PixelBox to_box(const Imath::Box2i& box) {
    return {box.min.x, box.min.y, std::int64_t(box.max.x) - box.min.x + 1,
            std::int64_t(box.max.y) - box.min.y + 1};
}

/// Names of channels that together make an image, the first set that is there in full.
struct ChannelSet {
    std::vector<std::string> names;
    bool luminance;  ///< the first stands for R, G and B
};

/// X Y Z are a point, a normal or colours of CIE 1931; taken as three channels, not as luminance.
const std::vector<ChannelSet>& channel_sets() {
    static const std::vector<ChannelSet> sets = {{{"R", "G", "B", "A"}, false},
                                                 {{"R", "G", "B"}, false},
                                                 {{"R", "G"}, false},
                                                 {{"R"}, false},
                                                 {{"X", "Y", "Z", "A"}, false},
                                                 {{"X", "Y", "Z"}, false},
                                                 {{"Y", "A"}, true},
                                                 {{"Y"}, true}};
    return sets;
}

/// The channels to read, in order; none if these make no image.
ChannelSet chosen_channels(const std::vector<std::string>& all) {
    const auto has = [&](const std::string& name) {
        return std::find(all.begin(), all.end(), name) != all.end();
    };
    const bool gap = has("R") && ((has("B") && !has("G")) || (has("A") && !has("B")));
    const bool colour_differences = !has("R") && has("Y") && has("RY");
    const bool part_of_point = !has("R") && has("X") && !(has("Y") && has("Z"));
    if (all.size() > 1 && (gap || colour_differences || part_of_point)) return {{}, false};
    for (const ChannelSet& set : channel_sets())
        if (std::all_of(set.names.begin(), set.names.end(), has)) return set;
    return all.size() == 1 ? ChannelSet{all, true} : ChannelSet{{}, false};
}

TexelFormat common_format(const Imf::ChannelList& list, const std::vector<std::string>& names) {
    const bool half = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return list[name.c_str()].type == Imf::HALF;
    });
    return half ? TexelFormat::half : TexelFormat::float32;
}

std::vector<bool> integer_channels(const Imf::ChannelList& list,
                                   const std::vector<std::string>& names) {
    std::vector<bool> integers;
    for (const std::string& name : names) integers.push_back(list[name.c_str()].type == Imf::UINT);
    return integers;
}

/// Copies what the display window shows of a run.
void place(const ExrRun& run, bool integers, const PixelBox& display, Image& image) {
    if (run.y < display.min_y || run.y >= display.min_y + display.height) return;
    const std::int64_t x0 = std::max<std::int64_t>(run.x, display.min_x);
    const std::int64_t x1 =
        std::min<std::int64_t>(std::int64_t(run.x) + run.count, display.min_x + display.width);
    float* out = image.values.data() + run.channel +
                 ((run.y - display.min_y) * display.width + x0 - display.min_x) * image.channels;
    for (std::int64_t x = x0; x < x1; ++x, out += image.channels) {
        const std::uint32_t bits = run.bits[x - run.x];
        *out = integers ? static_cast<float>(bits) : std::bit_cast<float>(bits);
    }
}

ChannelSet require_channels(const Imf::Header& header, const ExrChoice& choice,
                            const std::string& file, const std::string& key) {
    const std::vector<std::string> all = exr_channels(header, choice.prefix);
    const ChannelSet set = chosen_channels(all);
    if (set.names.empty()) {
        throw InputError(file, key, fmt::format("channels {}", fmt::join(all, " ")),
                         "R, R G, R G B, R G B A, X Y Z, X Y Z A, Y, Y A, a single channel, or a "
                         "layer to be named that has these");
    }
    for (const std::string& name : set.names) {
        const Imf::Channel& channel = header.channels()[(choice.prefix + name).c_str()];
        if (channel.xSampling == 1 && channel.ySampling == 1) continue;
        throw InputError(file, key, fmt::format("channel {}, sub-sampled", name),
                         "channels with a value a pixel");
    }
    return set;
}

void check_sizes(const Imf::Header& header, std::int64_t channels, const FileBytes& bytes,
                 const std::string& key) {
    const std::string file = bytes.file().string();
    const PixelBox data = to_box(header.dataWindow());
    const PixelBox display = to_box(header.displayWindow());
    constexpr std::int64_t far = std::int64_t(1) << 30;
    for (const std::int64_t corner : {data.min_x, data.min_y, display.min_x, display.min_y})
        if (std::abs(corner) > far)
            throw InputError(file, key, fmt::format("a window at {}", corner), "less than 2^30");
    check_image_size(data.width, data.height, channels, file, key);
    check_image_size(display.width, display.height, channels, file, key);
    const std::int64_t pixels = std::max(data.width * data.height, display.width * display.height);
    if (pixels * channels > most_exr_values(bytes, header)) {
        throw InputError(file, key, fmt::format("{} pixels of {} channels", pixels, channels),
                         "no more than a file of its size can hold");
    }
}

Image read_chosen(const FileBytes& bytes, const ImageSelection& selection, const std::string& key) {
    const std::string file = bytes.file().string();
    const ExrHeaders headers = read_exr_headers(bytes, key);
    const ExrChoice choice = choose_exr(headers, selection, file, key);
    const Imf::Header& header = headers.parts[static_cast<std::size_t>(choice.part)];
    const ChannelSet set = require_channels(header, choice, file, key);
    const auto channels = static_cast<std::int64_t>(set.names.size());
    check_sizes(header, channels, bytes, key);
    const PixelBox display = to_box(header.displayWindow());
    std::vector<std::string> names;
    for (const std::string& name : set.names) names.push_back(choice.prefix + name);
    Image image;
    image.luminance = set.luminance;
    image.width = static_cast<int>(display.width);
    image.height = static_cast<int>(display.height);
    image.channels = static_cast<int>(channels);
    image.format = common_format(header.channels(), names);
    image.values.assign(static_cast<std::size_t>(display.width * display.height * channels), 0.0f);
    const std::vector<bool> integers = integer_channels(header.channels(), names);
    const Imath::Box2i box = header.dataWindow();
    open_exr_pixels(bytes, choice.part, names)
        ->read(box.min.y, box.max.y + 1,
               [&](const ExrRun& run) { place(run, integers[run.channel], display, image); });
    return image;
}

}  // namespace

Image read_exr_image(const FileBytes& file, const ImageSelection& selection,
                     const std::string& key) {
    Image image;
    reading_exr(file.file(), key, [&] { image = read_chosen(file, selection, key); });
    return image;
}

}  // namespace quadrel
