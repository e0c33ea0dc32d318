// Finding one's way in the sources of texts, as far as they are written by the style of this
// project.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace quadrel::annotate {

bool is_word(char c);

/// Position of the first of `stops` from `from` on that no parentheses, braces or string hide;
/// npos where there is none before the closing one of an outer pair.
std::size_t end_of(const std::string& text, std::size_t from, const std::string& stops);
/// Position of the parenthesis or brace that closes the one at `open`; npos where there is none.
std::size_t match(const std::string& text, std::size_t open);

/// A function's or a lambda's body: its braces, what it is called, and its result's type (empty
/// where that is deduced).
struct Scope {
    std::size_t begin, end;
    std::string name, type;
};
std::vector<Scope> scopes_of(const std::string& text);

/// Members of each struct that has nothing but data, by the struct's name.
using Structs = std::map<std::string, std::vector<std::string>>;
void add_structs(Structs& structs, const std::string& text);

}  // namespace quadrel::annotate
