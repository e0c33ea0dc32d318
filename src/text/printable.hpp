// Text that a terminal does not obey: what files and arguments hold gets into messages and reports.
#pragma once

#include <string>
#include <string_view>

namespace quadrel {

/// One line: control characters (C0, DEL, C1) and bytes that are no UTF-8 become \xNN, a line break
/// \n and a tab \t.
std::string printable(std::string_view text);

/// The same, line by line: line breaks stay.
std::string printable_lines(std::string_view text);

/// JSON as nlohmann writes it, with the control characters that it leaves (DEL, C1) as \u00NN.
std::string printable_json(std::string_view text);

/// The beginning of a text that may be as long as a file, at most `most` bytes and "...".
std::string shortened(std::string_view text, std::size_t most = 400);

/// A note (Scene::notes) about a file.
inline std::string file_note(const std::string& file, const std::string& text) {
    return printable(file + ": " + shortened(text));
}

}  // namespace quadrel
