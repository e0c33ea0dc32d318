// What an option or argument of the command line takes, as words to choose from.
#pragma once

#include "cli/shell/typed_line.hpp"
#include "cli/shell/words.hpp"

namespace quadrel::cli {

void add_values_of(const CLI::Option& option, const TypedLine& line, Candidates& to);

/// "{a,b,c}" in the description of what an option takes, as one_word_of and CLI::IsMember leave it;
/// empty if there is none.
std::vector<std::string> listed_words(const std::string& type);

}  // namespace quadrel::cli
