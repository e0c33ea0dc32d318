#include "io/parts/join.hpp"

#include <OpenEXR/ImfChannelList.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "io/exr/file_sink.hpp"
#include "io/exr/open.hpp"
#include "io/parts/image_part.hpp"
#include "quadrel/error.hpp"
#include "text/printable.hpp"

namespace quadrel {
namespace {

// Where messages say that something is wrong.
constexpr const char* part_key = "quadrel:part";
constexpr const char* whole_key = "quadrel:partOf";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& key,
                         const std::string& found, const std::string& expected) {
    throw InputError(file.string(), key, found, expected);
}

/// The same part of two texts that differ: of long ones from shortly before where they do.
std::pair<std::string, std::string> differing_parts(const std::string& a, const std::string& b) {
    constexpr std::size_t most = 120, before = 30;
    const auto differs = std::ranges::mismatch(a, b).in1 - a.begin();
    const std::size_t at =
        std::max(a.size(), b.size()) <= most
            ? 0
            : static_cast<std::size_t>(differs) - std::min<std::size_t>(differs, before);
    const auto part = [&](const std::string& text) {
        return (at == 0 ? "" : "...") + shortened(std::string_view(text).substr(at), most);
    };
    return {part(a), part(b)};
}

std::string corners_text(const Window& window) {
    return fmt::format("{},{},{},{}", window.x0, window.y0, window.x1, window.y1);
}

/// What a file says of itself.
struct PartFile {
    std::filesystem::path file;
    ImagePart part;
    Window window;
    Film layout;
    Attributes attributes;  ///< of the whole image
    ExrCompression compression = ExrCompression::zip;
};

ExrCompression compression_of_header(const Imf::Header& header) {
    switch (header.compression()) {
        case Imf::NO_COMPRESSION:
            return ExrCompression::none;
        case Imf::RLE_COMPRESSION:
            return ExrCompression::rle;
        case Imf::ZIPS_COMPRESSION:
            return ExrCompression::zips;
        case Imf::PIZ_COMPRESSION:
            return ExrCompression::piz;
        default:
            return ExrCompression::zip;
    }
}

PartFile open_part(const std::filesystem::path& file) {
    const FileBytes bytes(file, "", "an EXR file");
    const ExrHeaders headers = read_exr_headers(bytes, "");
    const ExrChoice choice = choose_exr(headers, {}, file, "");
    const Imf::Header& header = headers.parts[static_cast<std::size_t>(choice.part)];
    const ExrPartInfo info = exr_parts(file)[static_cast<std::size_t>(choice.part)];
    PartFile opened{file, {}, info.window, {}, info.attributes};
    const std::optional<ImagePart> part = part_of(opened.attributes);
    if (!part) refuse(file, part_key, "none", "a part of an image, as render --task writes them");
    opened.part = *part;
    opened.attributes = without_part(std::move(opened.attributes));
    std::erase_if(opened.attributes,
                  [](const auto& attribute) { return !attribute.first.starts_with("quadrel:"); });
    opened.layout.frame = info.frame;
    opened.layout.window = part->whole;
    for (auto at = header.channels().begin(); at != header.channels().end(); ++at)
        opened.layout.planes.push_back(
            {at.name(),
             at.channel().type == Imf::UINT ? ChannelType::uint32 : ChannelType::float32,
             {}});
    opened.compression = compression_of_header(header);
    return opened;
}

void check_rows(const PartFile& part) {
    const Window expected = part_window(part.part);
    if (part.window != expected)
        refuse(part.file, "dataWindow", corners_text(part.window), corners_text(expected));
}

/// "R (float), id.object (uint)".
std::string channels_text(const Film& layout) {
    std::string text;
    for (const Plane& plane : layout.planes)
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", plane.name,
                            plane.type == ChannelType::float32 ? "float" : "uint");
    return text;
}

/// The attribute that is to be named where two images differ: what says most about it comes first.
std::string differing_key(const Attributes& a, const Attributes& b) {
    const auto differs = [&](const std::string& key) {
        const auto in_a = a.find(key), in_b = b.find(key);
        if (in_a == a.end() || in_b == b.end()) return (in_a == a.end()) != (in_b == b.end());
        return in_a->second != in_b->second;
    };
    for (const char* const key : {"quadrel:version", "quadrel:number", "quadrel:sceneHash"})
        if (differs(key)) return key;
    for (const Attributes* const of : {&a, &b})
        for (const auto& [key, value] : *of)
            if (differs(key)) return key;
    return "";
}

void check_same_image(const PartFile& part, const PartFile& first) {
    const auto check = [&](const std::string& key, const std::string& found,
                           const std::string& expected) {
        if (found == expected) return;
        const auto [here, there] = differing_parts(found, expected);
        refuse(part.file, key, here, there + " as in " + first.file.string());
    };
    const std::string key = differing_key(part.attributes, first.attributes);
    const auto value = [&](const Attributes& attributes) {
        const auto found = attributes.find(key);
        return found == attributes.end() ? std::string("none") : found->second;
    };
    if (!key.empty()) check(key, value(part.attributes), value(first.attributes));
    check("displayWindow", corners_text(part.layout.frame), corners_text(first.layout.frame));
    check("channels", channels_text(part.layout), channels_text(first.layout));
    check(whole_key, corners_text(part.part.whole), corners_text(first.part.whole));
    check(part_key, fmt::format("one of {}", part.part.of),
          fmt::format("one of {}", first.part.of));
}

/// Sorted by their numbers.
void check_complete(const std::vector<PartFile>& parts) {
    const int of = parts.front().part.of;
    for (std::size_t i = 1; i < parts.size(); ++i)
        if (parts[i].part.number == parts[i - 1].part.number)
            refuse(parts[i].file, part_key, fmt::format("{}/{}", parts[i].part.number, of),
                   "each part once, and " + parts[i - 1].file.string() + " is the same one");
    for (int number = 1; number <= of; ++number) {
        const auto index = static_cast<std::size_t>(number - 1);
        if (index >= parts.size() || parts[index].part.number != number)
            refuse(parts.front().file, part_key, fmt::format("{} of {} parts", parts.size(), of),
                   fmt::format("all, and {}/{} is missing", number, of));
    }
}

}  // namespace

JoinedParts::JoinedParts(const std::vector<std::filesystem::path>& files) {
    std::vector<PartFile> parts;
    for (const std::filesystem::path& file : files) parts.push_back(open_part(file));
    for (const PartFile& part : parts) {
        check_same_image(part, parts.front());
        check_rows(part);
    }
    std::stable_sort(parts.begin(), parts.end(), [](const PartFile& a, const PartFile& b) {
        return a.part.number < b.part.number;
    });
    check_complete(parts);
    for (const PartFile& part : parts) {
        files_.push_back(part.file);
        windows_.push_back(part.window);
    }
    layout_ = parts.front().layout;
    attributes_ = parts.front().attributes;
    compression_ = parts.front().compression;
}

void JoinedParts::write(const std::filesystem::path& output, ExrCompression compression,
                        const std::function<void(double)>& progress) const {
    const std::unique_ptr<BandSink> sink = exr_file_sink(output, layout_, attributes_, compression);
    const Window& whole = layout_.window;
    for (std::size_t i = 0; i < files_.size(); ++i) {
        const Window& window = windows_[i];
        for (int y = window.y0; y < window.y1; y += part_rows) {
            const Window rows{window.x0, y, window.x1, std::min(y + part_rows, window.y1)};
            ExrFile read = read_exr(files_[i], {}, rows);
            const BandStep step = sink->take(std::make_shared<const Film>(std::move(read.film)));
            if (step.work) step.work();
            if (step.finish) step.finish();
            progress(double(rows.y1 - whole.y0) / whole.height());
        }
    }
    sink->end();
}

}  // namespace quadrel
