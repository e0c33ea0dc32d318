#include "cli/compare/decode.hpp"

#include <utility>

#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/film/value_bits.hpp"

namespace quadrel::cli {
namespace {

constexpr const char* decode_option = "--decode";

bool stores_codes(const ComparableImage& image) {
    for (const auto& [name, storage] : image.stored)
        if (storage != Storage::unorm8 && storage != Storage::unorm16) return false;
    return true;
}

/// Also the ranges of what is kept, where a value is judged by these.
void keep_decoded(const Film& decoded, bool ranges, Film& reference) {
    std::erase_if(reference.planes, [&](const Plane& plane) {
        if (decoded.find(plane.name) != nullptr) return false;
        for (const std::string prefix : gpu_range_prefixes)
            if (ranges && plane.name.starts_with(prefix))
                return decoded.find(plane.name.substr(prefix.size())) == nullptr;
        return true;
    });
}

}  // namespace

void decode_test(const std::vector<std::string>& decode, bool ranges, Images& images) {
    if (decode.empty()) return;
    if (stores_codes(images.reference)) {
        if (stores_codes(images.test))
            throw UsageError(std::string(decode_option) +
                             ": two images of codes, expected one, and an EXR with the values");
        std::swap(images.reference, images.test);
    }
    std::vector<BitImage> carriers;
    for (const std::string& text : decode) {
        CarriedBits carries = parse_carried_bits(decode_option, text);
        ComparableImage image = carries.file.empty() ? images.test : read_comparable(carries.file);
        carriers.push_back({std::move(carries), std::move(image)});
    }
    const std::filesystem::path file = images.test.file;
    images.test = decode_bits(carriers, images.reference.film);
    images.test.file = file;
    keep_decoded(images.test.film, ranges, images.reference.film);
}

std::vector<std::string> decoded_channels(const std::vector<std::string>& decode,
                                          const std::string& test_file) {
    std::vector<std::string> lines;
    for (const std::string& text : decode) {
        const CarriedBits carries = parse_carried_bits(decode_option, text);
        const std::string file = carries.file.empty() ? test_file : carries.file.string();
        for (const std::string& channel : carries.channels)
            lines.push_back(channel + ": " + bit_layout_name(carries.layout) + " of " + file);
    }
    return lines;
}

}  // namespace quadrel::cli
