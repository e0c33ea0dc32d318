// Lines of a width to read.
#pragma once

#include <string>

namespace quadrel::recorded {

/// `line` in pieces of at most 100 characters where it can be broken: behind an operator or a
/// comma, where the fewest parentheses are open; a comment between words.
std::string wrapped_line(const std::string& line);

}  // namespace quadrel::recorded
