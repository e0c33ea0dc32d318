#include "page/template.hpp"

#include <algorithm>
#include <cstdint>

#include "file/data_path.hpp"
#include "file/read_file.hpp"
#include "quadrel/error.hpp"

namespace quadrel::page {

std::string page_part(const std::filesystem::path& relative) {
    return read_whole_file(find_data_file(relative));
}

std::string page_parts(std::initializer_list<const char*> relative) {
    std::string text;
    for (const char* name : relative) text += page_part(name);
    return text;
}

PageTemplate::PageTemplate(const std::filesystem::path& relative)
    : file_(relative), text_(page_part(relative)) {}

void PageTemplate::fill(std::string_view mark, std::string_view text) {
    const std::size_t at = text_.find(mark);
    if (at == std::string::npos)
        throw InputError(file_.string(), "", "no " + std::string(mark),
                         "it, where the page gets its parts");
    text_.replace(at, mark.size(), text);
}

std::string embedded_json(const Json& json) {
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;
    return safe;
}

std::string escaped_text(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '<')
            safe += "&lt;";
        else if (c == '&')
            safe += "&amp;";
        else
            safe += c;
    }
    return safe;
}

std::string base64(std::string_view bytes) {
    static constexpr char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace quadrel::page
