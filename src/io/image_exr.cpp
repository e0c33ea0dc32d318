// Reads EXR images as textures, through OpenEXR.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/exr_limits.hpp"
#include "io/image_readers.hpp"
#include "io/out_of_memory.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

namespace {

struct Window {
    std::int64_t min_x, min_y, width, height;
};

Window to_window(const Imath::Box2i& box) {
    return {box.min.x, box.min.y, std::int64_t(box.max.x) - box.min.x + 1,
            std::int64_t(box.max.y) - box.min.y + 1};
}

std::vector<std::string> channel_names(const Imf::ChannelList& list) {
    std::vector<std::string> names;
    for (auto it = list.begin(); it != list.end(); ++it) names.emplace_back(it.name());
    return names;
}

/// The channels to read, in order; empty if the file has none that make an image.
std::vector<std::string> chosen_channels(const Imf::ChannelList& list, bool& luminance) {
    const auto has = [&](const char* name) { return list.findChannel(name) != nullptr; };
    luminance = false;
    if (has("R")) {
        std::vector<std::string> names;
        for (const char* name : {"R", "G", "B", "A"}) {
            if (has(name)) names.emplace_back(name);
        }
        const bool gap = (has("B") && !has("G")) || (has("A") && !has("B"));
        return gap ? std::vector<std::string>() : names;
    }
    luminance = true;
    if (has("Y") && !has("RY")) {
        return has("A") ? std::vector<std::string>{"Y", "A"} : std::vector<std::string>{"Y"};
    }
    const auto all = channel_names(list);
    return all.size() == 1 ? all : std::vector<std::string>();
}

TexelFormat common_format(const Imf::ChannelList& list, const std::vector<std::string>& names) {
    const bool half = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return list[name.c_str()].type == Imf::HALF;
    });
    return half ? TexelFormat::half : TexelFormat::float32;
}

/// Reads the whole data window, channels interleaved.
std::vector<float> read_data_window(Imf::InputFile& file, const Window& data,
                                    const std::vector<std::string>& names) {
    const std::size_t channels = names.size();
    const std::size_t row = static_cast<std::size_t>(data.width) * channels;
    std::vector<float> values(row * static_cast<std::size_t>(data.height));
    const Imath::Box2i box = file.header().dataWindow();
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels; ++c) {
        buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, values.data() + c, box,
                                                 channels * sizeof(float), row * sizeof(float)));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(box.min.y, box.max.y);
    return values;
}

/// Copies the part of the data window that the display window shows.
void place(const std::vector<float>& from, const Window& data, const Window& display,
           Image& image) {
    const std::int64_t x0 = std::max(data.min_x, display.min_x);
    const std::int64_t x1 = std::min(data.min_x + data.width, display.min_x + display.width);
    const std::int64_t y0 = std::max(data.min_y, display.min_y);
    const std::int64_t y1 = std::min(data.min_y + data.height, display.min_y + display.height);
    if (x0 >= x1) return;
    for (std::int64_t y = y0; y < y1; ++y) {
        const std::int64_t in = ((y - data.min_y) * data.width + x0 - data.min_x) * image.channels;
        const std::int64_t out =
            ((y - display.min_y) * display.width + x0 - display.min_x) * image.channels;
        std::copy_n(from.begin() + in, (x1 - x0) * image.channels, image.values.begin() + out);
    }
}

std::vector<std::string> require_channels(const Imf::Header& header, const std::string& file,
                                          const std::string& key, bool& luminance) {
    const Imf::ChannelList& list = header.channels();
    const auto names = chosen_channels(list, luminance);
    if (names.empty()) {
        throw InputError(file, key, fmt::format("channels {}", fmt::join(channel_names(list), " ")),
                         "R, R G, R G B, R G B A, Y, Y A, or a single channel");
    }
    for (const std::string& name : names) {
        const Imf::Channel& channel = list[name.c_str()];
        if (channel.xSampling == 1 && channel.ySampling == 1) continue;
        throw InputError(file, key, fmt::format("channel {}, sub-sampled", name),
                         "channels with a value a pixel");
    }
    return names;
}

Image read_open_file(Imf::InputFile& input, const std::string& file, const std::string& key) {
    const Imf::Header& header = input.header();
    Image image;
    const auto names = require_channels(header, file, key, image.luminance);
    const auto channels = static_cast<std::int64_t>(names.size());
    const Window data = to_window(header.dataWindow());
    const Window display = to_window(header.displayWindow());
    check_image_size(data.width, data.height, channels, file, key);
    check_image_size(display.width, display.height, channels, file, key);
    const std::int64_t pixels = std::max(data.width * data.height, display.width * display.height);
    if (pixels * channels > most_exr_values(file, header)) {
        throw InputError(file, key, fmt::format("{} pixels of {} channels", pixels, channels),
                         "no more than a file of its size can hold");
    }
    if (!input.isComplete()) {
        throw InputError(file, key, "a file that was not written to its end", "a complete EXR");
    }
    image.width = static_cast<int>(display.width);
    image.height = static_cast<int>(display.height);
    image.channels = static_cast<int>(channels);
    image.format = common_format(header.channels(), names);
    image.values.assign(static_cast<std::size_t>(display.width * display.height * channels), 0.0f);
    place(read_data_window(input, data, names), data, display, image);
    return image;
}

}  // namespace

Image read_exr_image(const std::string& file, const std::string& key) {
    check_exr_attributes(file, key);
    try {
        Imf::InputFile input(file.c_str(), 0);
        return read_open_file(input, file, key);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        rethrow_out_of_memory(error);
        throw InputError(file, key, error.what(), "a complete EXR image");
    }
}

}  // namespace quadrel
