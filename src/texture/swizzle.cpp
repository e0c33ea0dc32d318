#include "texture/swizzle.hpp"

#include <fmt/format.h>

#include "quadrel/error.hpp"

namespace quadrel {

namespace {

constexpr const char* swizzle_syntax =
    "one to four of r g b a 1-r 1-g 1-b 1-a 0 1, such as \"rgba\", \"a\" or \"1-r\"";

int channel_of(char letter) {
    const std::size_t at = std::string("rgba").find(letter);
    return at == std::string::npos ? -1 : static_cast<int>(at);
}

/// Reads one entry at `at` and moves behind it; false if there is none.
bool read_entry(const std::string& text, std::size_t& at, SwizzleEntry& entry) {
    const char letter = text[at];
    if (letter == '1' && at + 2 < text.size() && text[at + 1] == '-' &&
        channel_of(text[at + 2]) >= 0) {
        entry = {channel_of(text[at + 2]), true, 0};
        at += 3;
        return true;
    }
    if (channel_of(letter) >= 0) {
        entry = {channel_of(letter), false, 0};
    } else if (letter == '0' || letter == '1') {
        entry = {-1, false, letter - '0'};
    } else {
        return false;
    }
    ++at;
    return true;
}

std::string own_channels(const Image& image) {
    if (image.luminance) return image.channels == 1 ? "r" : "ra";
    static const char* const names[] = {"r", "rg", "rgb1", "rgba"};
    return names[image.channels - 1];
}

/// The image's channel for r, g, b or a; -1 where alpha is missing, -2 where a colour is.
int image_channel(const Image& image, int source) {
    if (source == 3) {
        if (image.luminance) return image.channels == 2 ? 1 : -1;
        return image.channels == 4 ? 3 : -1;
    }
    if (image.luminance) return 0;
    return source < image.channels ? source : -2;
}

}  // namespace

std::vector<SwizzleEntry> parse_swizzle(const std::string& text, const std::string& file,
                                        const std::string& key) {
    const auto refuse = [&] {
        throw InputError(file, key, fmt::format("swizzle \"{}\"", text), swizzle_syntax);
    };
    std::vector<SwizzleEntry> entries;
    for (std::size_t at = 0; at < text.size();) {
        if (text[at] == ' ' || text[at] == ',') {
            ++at;
            continue;
        }
        SwizzleEntry entry{};
        if (!read_entry(text, at, entry)) refuse();
        entries.push_back(entry);
    }
    if (entries.empty() || entries.size() > 4) refuse();
    if (entries.size() == 3) entries.push_back({-1, false, 1});
    return entries;
}

std::vector<SwizzleEntry> resolve_swizzle(const std::string& text, const Image& image,
                                          const std::string& key) {
    const std::string file = image.file.string();
    if (text == alpha_or_first)
        return resolve_swizzle(image_channel(image, 3) >= 0 ? "a" : "r", image, key);
    const std::string wanted = text.empty() ? own_channels(image) : text;
    std::vector<SwizzleEntry> entries = parse_swizzle(wanted, file, key);
    for (SwizzleEntry& entry : entries) {
        if (entry.source < 0) continue;
        const int channel = image_channel(image, entry.source);
        if (channel == -2 || (channel == -1 && entries.size() == 1)) {
            throw InputError(file, key,
                             fmt::format("swizzle \"{}\" of an image with channels \"{}\"", wanted,
                                         own_channels(image)),
                             "channels that the image has");
        }
        if (channel == -1) entry = {-1, false, entry.complement ? 0 : 1};
        entry.source = channel;
    }
    return entries;
}

}  // namespace quadrel
