#include "io/parts/image_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "quadrel/error.hpp"
#include "text/hash.hpp"

namespace quadrel {
namespace {

constexpr const char* part_attribute = "quadrel:part";
constexpr const char* whole_attribute = "quadrel:partOf";
constexpr const char* hash_attribute = "quadrel:partHash";

std::string corners_of(const Window& window) {
    return fmt::format("{},{},{},{}", window.x0, window.y0, window.x1, window.y1);
}

constexpr int most_side = 65536;

int rows_of_tiles(const Window& window) { return (window.height() + part_rows - 1) / part_rows; }

}  // namespace

std::optional<ImagePart> part_of(const Attributes& attributes) {
    const auto part = attributes.find(part_attribute), whole = attributes.find(whole_attribute);
    if (part == attributes.end() || whole == attributes.end()) return std::nullopt;
    ImagePart read;
    Window& window = read.whole;
    if (std::sscanf(part->second.c_str(), "%d/%d", &read.number, &read.of) != 2 ||
        std::sscanf(whole->second.c_str(), "%d,%d,%d,%d", &window.x0, &window.y0, &window.x1,
                    &window.y1) != 4)
        return std::nullopt;
    const auto inside = [](int from, int to) { return 0 <= from && from < to && to <= most_side; };
    const bool sound = inside(window.x0, window.x1) && inside(window.y0, window.y1) &&
                       read.number >= 1 && read.number <= read.of &&
                       read.of <= rows_of_tiles(window);
    return sound ? std::optional(read) : std::nullopt;
}

Window part_window(const ImagePart& part) {
    const Window& whole = part.whole;
    const int rows = rows_of_tiles(whole);
    if (part.of > rows)
        throw UsageError(fmt::format(
            "--task: found {}/{}, expected at most {} parts: so many rows of tiles of {} pixels",
            part.number, part.of, rows, part_rows));
    const auto edge = [&](int number) {
        const auto row = static_cast<int>(std::int64_t{number} * rows / part.of);
        return std::min(whole.y0 + row * part_rows, whole.y1);
    };
    return {whole.x0, edge(part.number - 1), whole.x1, edge(part.number)};
}

std::string part_hash(const ImagePart& part, const Window& frame, const Attributes& attributes,
                      const std::vector<std::string>& channels, ExrCompression compression) {
    Sha256 hash;
    const auto add = [&](const std::string& text) {
        hash.update(std::to_string(text.size()) + ":" + text);
    };
    add(fmt::format("{}/{} {} {} {}", part.number, part.of, corners_of(part.whole),
                    corners_of(frame), static_cast<int>(compression)));
    for (const auto& [name, value] : attributes) {
        add(name);
        add(value);
    }
    for (const std::string& channel : channels) add(channel);
    return hash.hex();
}

Attributes without_part(Attributes attributes) {
    for (const char* const name : {part_attribute, whole_attribute, hash_attribute})
        attributes.erase(name);
    return attributes;
}

void name_part(const ImagePart& part, const std::string& hash, Attributes& attributes) {
    attributes[part_attribute] = fmt::format("{}/{}", part.number, part.of);
    attributes[whole_attribute] = corners_of(part.whole);
    attributes[hash_attribute] = hash;
}

bool is_finished_part(const std::filesystem::path& file, const std::string& hash) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) return false;
    try {
        const Attributes attributes = exr_parts(file).front().attributes;
        const auto found = attributes.find(hash_attribute);
        if (found == attributes.end() || found->second != hash) return false;
        read_exr_in_bands(file, {}, [](const Film&) {});
        return true;
    } catch (const InputError&) {
        return false;  // damaged: to be drawn anew
    }
}

}  // namespace quadrel
