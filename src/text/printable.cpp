#include "text/printable.hpp"

#include <fmt/format.h>

namespace quadrel {

namespace {

/// The bytes of the UTF-8 character that `text` begins with (Unicode 15, table 3-7), or 0.
std::size_t character_size(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    const std::size_t size = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (first < 0xc2 || first > 0xf4) return 0;
    const unsigned low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (second < low || second > high) return 0;
    for (std::size_t i = 2; i < size; ++i)
        if (byte(i) < 0x80 || byte(i) > 0xbf) return 0;
    return size;
}

/// The code of the control character that is `character`, or -1.
int control_code(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    if (first < 0x20 || first == 0x7f) return first;
    const bool c1 = first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
    return c1 ? static_cast<unsigned char>(character[1]) : -1;
}

/// Calls escape(code) for control characters, and for bytes that are no UTF-8.
template <class Escape>
std::string escaped(std::string_view text, const Escape& escape) {
    std::string out;
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        const std::string_view character = text.substr(0, size == 0 ? 1 : size);
        const int code = size == 0 ? static_cast<unsigned char>(text[0]) : control_code(character);
        if (code >= 0)
            out += escape(code);
        else
            out += character;
        text.remove_prefix(character.size());
    }
    return out;
}

std::string escape_code(int code) {
    if (code == '\n') return "\\n";
    if (code == '\t') return "\\t";
    return fmt::format("\\x{:02x}", code);
}

}  // namespace

std::string printable(std::string_view text) { return escaped(text, escape_code); }

std::string printable_lines(std::string_view text) {
    return escaped(text, [](int code) { return code == '\n' ? "\n" : escape_code(code); });
}

std::string printable_json(std::string_view text) {
    return escaped(text, [](int code) {
        return code == '\n' ? std::string("\n") : fmt::format("\\u{:04x}", code);
    });
}

std::string shortened(std::string_view text, std::size_t most) {
    if (text.size() <= most) return std::string(text);
    return std::string(text.substr(0, most)) + "...";
}

}  // namespace quadrel
