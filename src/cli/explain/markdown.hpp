// Texts that the documentation shares with the command line.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace quadrel::cli {

/// Markdown as plain text: without the marks of code.
inline std::string plain_text(std::string_view markdown) {
    std::string text(markdown);
    std::erase(text, '`');
    return text;
}

}  // namespace quadrel::cli
