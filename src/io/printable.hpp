// Text out of files, for terminals.
#pragma once

#include <string>

namespace quadrel {

/// `text` as part of a message: it stays one line, and no terminal obeys it.
inline std::string printable(std::string text) {
    for (char& c : text) {
        if (c == '\n' || c == '\t') c = ' ';
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
    }
    return text;
}

/// The beginning of a text that may be as long as a file.
inline std::string shortened(const std::string& text) {
    constexpr std::size_t most = 400;
    return text.size() > most ? text.substr(0, most) + "..." : text;
}

/// A note (Scene::notes) about a file.
inline std::string file_note(const std::string& file, const std::string& text) {
    return printable(file + ": " + shortened(text));
}

}  // namespace quadrel
