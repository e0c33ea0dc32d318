// Code as a text: where a bracket closes, what a statement's body is.
#pragma once

#include <regex>
#include <string>

#include "sources/source_tree.hpp"

namespace quadrel::source_tests {

/// Without comments, and with strings emptied.
inline std::string bare_code(const std::string& text) {
    std::string code;
    bool in_string = false;
    char before = 0;
    for (const char c : without_comments(text)) {
        const bool quote = c == '"' && before != '\'' && before != '\\';
        in_string = in_string != quote;
        if (!in_string || quote) code += c;
        before = c;
    }
    return code;
}

/// Whether one of the words stands in the code: quicker than a regular expression that needs it.
inline bool mentions(const std::string& code, std::initializer_list<const char*> words) {
    return std::ranges::any_of(
        words, [&](const char* word) { return code.find(word) != std::string::npos; });
}

/// Position after the bracket that closes the one at `open`.
inline std::size_t after_bracket(const std::string& code, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < code.size(); ++i) {
        if (std::string("([{").find(code[i]) != std::string::npos) ++depth;
        if (std::string(")]}").find(code[i]) != std::string::npos && --depth == 0) return i + 1;
    }
    return code.size();
}

/// A statement with a head in brackets: `for (head) body`.
struct Block {
    std::string head, body;
};

/// The one whose head opens at `open`. The body is in braces, or one statement.
inline Block block_at(const std::string& code, std::size_t open) {
    const std::size_t end = after_bracket(code, open);
    const std::size_t start = std::min(code.find_first_not_of(" \n", end), code.size());
    const std::size_t stop = code[start] == '{'
                                 ? after_bracket(code, start)
                                 : std::min(code.find(';', start), code.size() - 1) + 1;
    return {code.substr(open + 1, end - open - 2), code.substr(start, stop - start)};
}

/// All statements that begin with `keyword (`.
inline std::vector<Block> blocks_of(const std::string& code, const std::string& keyword) {
    const std::regex start("\\b" + keyword + " \\(");
    std::vector<Block> blocks;
    for (std::sregex_iterator i(code.begin(), code.end(), start), end; i != end; ++i)
        blocks.push_back(block_at(code, std::size_t(i->position() + i->length() - 1)));
    return blocks;
}

/// The part of the function that `at` lies in before it.
inline std::string function_before(const std::string& code, std::size_t at) {
    static const std::regex scope("\\b(namespace|struct|class|enum)\\b");
    std::vector<std::size_t> bodies;  // where functions' braces open; npos: another brace
    for (std::size_t i = 0; i < at; ++i) {
        if (code[i] == '}' && !bodies.empty()) bodies.pop_back();
        if (code[i] != '{') continue;
        const std::size_t last = code.find_last_of(";{}", i - 1);
        const std::size_t begin = i == 0 || last == std::string::npos ? 0 : last;
        const bool own = !std::regex_search(code.substr(begin, i - begin), scope);
        bodies.push_back(own ? i : std::string::npos);
    }
    const auto function =
        std::ranges::find_if(bodies, [](std::size_t i) { return i != std::string::npos; });
    return function == bodies.end() ? "" : code.substr(*function, at - *function);
}

/// The code with the bodies of lambdas emptied: their `return` is their own.
inline std::string without_lambdas(std::string code) {
    static const std::regex lambda(R"(\]\s*(\([^()]*\))?\s*(mutable\s*)?(->[^{};]*)?\{)");
    std::smatch match;
    while (std::regex_search(code, match, lambda)) {
        const std::size_t open = std::size_t(match.position() + match.length() - 1);
        code.replace(std::size_t(match.position()), after_bracket(code, open) - match.position(),
                     "");
    }
    return code;
}

}  // namespace quadrel::source_tests
