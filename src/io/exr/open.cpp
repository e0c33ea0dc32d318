#include "io/exr/open.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "io/exr/byte_stream.hpp"
#include "io/exr/limits.hpp"
#include "quadrel/error.hpp"
#include "text/out_of_memory.hpp"

namespace quadrel {
namespace {

constexpr const char* one_part = "one of them named as the part, or a layer of one of them";

/// OpenEXR says little about files that are no EXR at all; this does.
void check_is_exr(const FileBytes& file, const std::string& key) {
    char magic[4] = {};
    if (file.read(0, magic, 4) != 4 || !Imf::isImfMagic(magic))
        throw InputError(file.file().string(), key, "something else", "an EXR file");
    check_exr_attributes(file, key);
}

/// The part of that name, else of that number; -1 if there is none.
int find_part(const ExrHeaders& headers, const std::string& wanted) {
    const auto names = headers.names();
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found != names.end()) return static_cast<int>(found - names.begin());
    int number = -1;
    const char* const end = wanted.data() + wanted.size();
    const auto [stop, error] = std::from_chars(wanted.data(), end, number);
    const bool is_number = error == std::errc() && stop == end && number >= 0;
    return is_number && number < static_cast<int>(names.size()) ? number : -1;
}

/// Why a part was not found, as an exception.
class Choice {
  public:
    Choice(const ExrHeaders& headers, const ImageSelection& selection,
           const std::filesystem::path& file, const std::string& key)
        : headers_(headers), selection_(selection), file_(file), key_(key) {}

    ExrChoice choose() const {
        ExrChoice choice{choose_part(), selection_.layer.empty() ? "" : selection_.layer + "."};
        const Imf::Header& header = headers_.parts[static_cast<std::size_t>(choice.part)];
        if (header.hasType() && Imf::isDeepData(header.type()))
            fail("a deep image", "a flat image");
        if (!headers_.complete[static_cast<std::size_t>(choice.part)])
            fail("a file that was not written to its end", "a complete EXR");
        if (!exr_channels(header, choice.prefix).empty()) return choice;
        const bool named = header.hasName() && header.name() == selection_.layer;
        if (named || selection_.layer.empty()) return {choice.part, ""};
        fail(fmt::format("no layer \"{}\"", selection_.layer), known_layers(header));
    }

  private:
    [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
        throw InputError(file_.string(), key_, found, expected);
    }

    bool has_layer(int part) const {
        return !exr_channels(headers_.parts[static_cast<std::size_t>(part)], selection_.layer + ".")
                    .empty();
    }

    int choose_part() const {
        const int count = static_cast<int>(headers_.parts.size());
        if (!selection_.part.empty()) {
            const int part = find_part(headers_, selection_.part);
            if (part >= 0) return part;
            fail(fmt::format("no part \"{}\"", selection_.part), quoted_parts(headers_));
        }
        if (count == 1) return 0;
        if (selection_.layer.empty())
            fail(fmt::format("{} parts: {}", count, quoted_parts(headers_)), one_part);
        return part_of_layer(count);
    }

    int part_of_layer(int count) const {
        const auto names = headers_.names();
        const auto named = std::find(names.begin(), names.end(), selection_.layer);
        if (named != names.end()) return static_cast<int>(named - names.begin());
        std::vector<int> with_layer;
        for (int part = 0; part < count; ++part)
            if (has_layer(part)) with_layer.push_back(part);
        if (with_layer.size() == 1) return with_layer[0];
        if (with_layer.empty())
            fail(fmt::format("no layer and no part \"{}\" in {} parts: {}", selection_.layer, count,
                             quoted_parts(headers_)),
                 "the name of a layer or part");
        fail(fmt::format("a layer \"{}\" in {} of {} parts", selection_.layer, with_layer.size(),
                         count),
             "a part as well");
    }

    static std::string known_layers(const Imf::Header& header) {
        std::set<std::string> layers;
        for (const std::string& name : exr_channels(header, ""))
            for (std::size_t dot = name.find('.'); dot != name.npos; dot = name.find('.', dot + 1))
                layers.insert("\"" + name.substr(0, dot) + "\"");
        if (layers.empty()) return "none: the image has no layers";
        std::string text;
        for (const std::string& layer : layers) text += (text.empty() ? "" : ", ") + layer;
        return text;
    }

    const ExrHeaders& headers_;
    const ImageSelection& selection_;
    const std::filesystem::path& file_;
    const std::string& key_;
};

}  // namespace

std::vector<std::string> ExrHeaders::names() const {
    std::vector<std::string> names;
    for (const Imf::Header& header : parts) names.push_back(header.hasName() ? header.name() : "");
    return names;
}

void reading_exr(const std::filesystem::path& file, const std::string& key,
                 const std::function<void()>& read) {
    try {
        read();
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        rethrow_out_of_memory(error);
        throw InputError(file.string(), key, fmt::format("a damaged file ({})", error.what()),
                         "a whole EXR file");
    }
}

ExrHeaders read_exr_headers(const FileBytes& file, const std::string& key) {
    check_is_exr(file, key);
    ExrHeaders headers;
    reading_exr(file.file(), key, [&] {
        ByteStream stream(file);
        const Imf::MultiPartInputFile input(stream, 0, false);
        for (int part = 0; part < input.parts(); ++part) {
            headers.parts.push_back(input.header(part));
            headers.complete.push_back(input.partComplete(part));
        }
    });
    return headers;
}

ExrChoice choose_exr(const ExrHeaders& headers, const ImageSelection& selection,
                     const std::filesystem::path& file, const std::string& key) {
    return Choice(headers, selection, file, key).choose();
}

std::vector<std::string> exr_channels(const Imf::Header& header, const std::string& prefix) {
    std::vector<std::string> names;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
        const std::string name = i.name();
        if (name.size() > prefix.size() && name.starts_with(prefix))
            names.push_back(name.substr(prefix.size()));
    }
    return names;
}

std::string quoted_parts(const ExrHeaders& headers) {
    std::string text;
    int number = 0;
    for (const std::string& name : headers.names()) {
        text += text.empty() ? "" : ", ";
        text += name.empty() ? std::to_string(number) : "\"" + name + "\"";
        ++number;
    }
    return text;
}

}  // namespace quadrel
