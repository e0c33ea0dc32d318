// Words for command lines to copy and paste.
#pragma once

#include <string>

namespace quadrel {

/// `word` as a shell reads it back: quoted where it needs to be.
std::string shell_word(const std::string& word);

}  // namespace quadrel
