// The commands of a glman scene file (".glib"), before they are understood.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/document/json.hpp"

namespace quadrel {

/// One word of the file and where it begins.
struct GlibWord {
    std::string text;
    TextPosition at;
};

/// A command's name and the words that follow it, on its line and on those it continues on.
struct GlibCommand {
    GlibWord name;
    std::vector<GlibWord> arguments;
    TextPosition end;  ///< just behind the last word
};

/// Splits `text` at blanks and line ends. `#` before a word begins a comment up to the line's end;
/// a backslash at the end of a line continues the command on the next line that is neither blank
/// nor all comment; `<` and `>` are words by themselves. Throws InputError if the file ends where
/// a backslash promises more.
std::vector<GlibCommand> split_glib(std::string_view text, const std::filesystem::path& file);

/// A word as messages quote it: printable and not too long.
std::string quoted(const std::string& word);

}  // namespace quadrel
