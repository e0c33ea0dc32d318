// Lines of a width to read.
#pragma once

#include <string>

namespace quadrel::recorded {

/// `line` in pieces of at most 100 characters where it can be broken: behind an operator or a
/// comma, where the fewest parentheses are open; a comment between words.
std::string wrapped_line(const std::string& line);

/// A line of code with its comment, if it has one: behind it where there is room, else above it.
/// Ends with a line break.
std::string commented_line(const std::string& code, const std::string& comment);

}  // namespace quadrel::recorded
