// Names of numbers that are not finite, in messages.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace quadrel {

/// "NaN", "infinity" or "-infinity".
inline std::string not_finite_name(double value) {
    if (std::isnan(value)) return "NaN";
    return value > 0 ? "infinity" : "-infinity";
}

/// Whether a text is one of the usual spellings, in any case: nan, inf, infinity, with a sign or
/// without.
inline bool spells_not_finite(std::string_view text) {
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower == "nan" || lower == "inf" || lower == "infinity";
}

/// The letters, digits and signs at an offset and around it: what a parser of JSON stopped in.
inline std::string_view word_around(std::string_view text, std::size_t offset) {
    const auto is_word = [&](std::size_t i) {
        const char c = text[i];
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
               c == '.' || c == '+' || c == '-';
    };
    std::size_t begin = std::min(offset, text.size()), end = begin;
    while (begin > 0 && is_word(begin - 1)) --begin;
    while (end < text.size() && is_word(end)) ++end;
    return text.substr(begin, end - begin);
}

}  // namespace quadrel
