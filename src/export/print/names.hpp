// Names that shading languages take.
#pragma once

#include <set>
#include <string>

namespace quadrel::recorded {

/// What the text calls it, as shaders may: letters, digits and single underscores.
std::string local_name(const std::string& text);

/// A name that nothing in `taken` has, and is there from now on: `hint` as far as that is one.
std::string unique_name(const std::string& hint, const char* otherwise,
                        std::set<std::string>& taken);

}  // namespace quadrel::recorded
