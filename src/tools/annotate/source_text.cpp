#include "tools/annotate/source_text.hpp"

#include <algorithm>
#include <cctype>
#include <regex>

namespace quadrel::annotate {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

namespace {

/// Behind the template arguments that begin at `open`; `open` itself where none do.
std::size_t behind_template(const std::string& text, std::size_t open) {
    if (open == 0 || !is_word(text[open - 1])) return open;
    int depth = 0;
    for (std::size_t i = open; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '<') ++depth;
        if (c == '>' && --depth == 0) return i + 1;
        if (!is_word(c) && c != '<' && c != '>' && c != ':' && c != ' ' && c != ',') break;
    }
    return open;
}

bool opens(char c) { return c == '(' || c == '[' || c == '{'; }
bool closes(char c) { return c == ')' || c == ']' || c == '}'; }

std::size_t behind_string(const std::string& text, std::size_t quote) {
    std::size_t i = quote + 1;
    while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
    return i;
}

}  // namespace

std::size_t end_of(const std::string& text, std::size_t from, const std::string& stops) {
    int depth = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') {
            i = behind_string(text, i);
        } else if (c == '/' && text.compare(i, 2, "//") == 0) {
            i = text.find('\n', i);
            if (i == std::string::npos) return i;
        } else if (opens(c)) {
            ++depth;
        } else if (closes(c)) {
            if (--depth < 0) return std::string::npos;
        } else if (c == '<') {
            const std::size_t behind = behind_template(text, i);
            if (behind != i) i = behind - 1;
        } else if (depth == 0 && stops.find(c) != std::string::npos) {
            return i;
        }
    }
    return std::string::npos;
}

std::size_t match(const std::string& text, std::size_t open) {
    const std::string closing(1, text[open] == '(' ? ')' : text[open] == '{' ? '}' : ']');
    int depth = 0;
    for (std::size_t i = open; i < text.size(); ++i) {
        if (text[i] == text[open]) ++depth;
        if (text[i] == closing[0] && --depth == 0) return i;
    }
    return std::string::npos;
}

std::vector<Scope> scopes_of(const std::string& text) {
    static const std::regex function(
        R"((?:^|[ \n;}])(F|Mask<F>|Int<F>|vec[234]<F>|auto|[A-Z]\w+(?:<F>)?) (\w+)\()");
    static const std::regex lambda(R"(\b(\w+) = \[[^\]]*\]\()");
    static const std::regex nameless(R"([^=] \[[^\]\n]*\]\()");
    static const std::regex body(R"(^\)\s*(?:const)?\s*(?:->\s*[\w<>]+)?\s*\{)");
    std::vector<Scope> scopes;
    const auto add = [&](std::size_t open, const std::string& name, const std::string& type) {
        const std::size_t close = match(text, open);
        if (close == std::string::npos) return;
        const std::string rest = text.substr(close, 80);
        std::smatch found;
        if (!std::regex_search(rest, found, body)) return;
        const std::size_t begin = close + static_cast<std::size_t>(found.length()) - 1;
        const std::size_t end = match(text, begin);
        if (end != std::string::npos) scopes.push_back({begin, end, name, type});
    };
    const auto each = [&](const std::regex& pattern, auto use) {
        for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i)
            use(*i, static_cast<std::size_t>(i->position() + i->length()) - 1);
    };
    each(function, [&](const std::smatch& m, std::size_t open) { add(open, m[2], m[1]); });
    each(lambda, [&](const std::smatch& m, std::size_t open) { add(open, m[1], ""); });
    each(nameless, [&](const std::smatch&, std::size_t open) { add(open, "", ""); });
    return scopes;
}

namespace {

/// The names that a line declares as data of a struct; none where it is anything else.
std::vector<std::string> data_of(const std::string& line) {
    static const std::regex data(R"(^\s*(?:const )?[\w:]+(?:<[\w, ]+>)? ([^()]*);$)");
    static const std::regex other(R"(^\s*(using|static|friend|struct|return|template)\b)");
    static const std::regex name(R"(\s*(\w+)[^,]*)");
    std::smatch found;
    if (std::regex_search(line, other) || !std::regex_search(line, found, data)) return {};
    const std::string list = found[1];
    std::vector<std::string> names;
    for (std::sregex_iterator i(list.begin(), list.end(), name), end; i != end; ++i)
        names.push_back((*i)[1]);
    return names;
}

}  // namespace

void add_structs(Structs& structs, const std::string& text) {
    static const std::regex head(R"(struct (\w+)(?: final)? \{)");
    for (std::sregex_iterator i(text.begin(), text.end(), head), last; i != last; ++i) {
        const auto open = static_cast<std::size_t>(i->position() + i->length()) - 1;
        const std::size_t close = match(text, open);
        if (close == std::string::npos) continue;
        std::vector<std::string> members;
        int depth = 0;
        for (std::size_t at = open + 1; at < close;) {
            const std::size_t end = std::min(text.find('\n', at), close);
            std::string line = text.substr(at, end - at);
            line.erase(std::min(line.find("//"), line.size()));
            while (!line.empty() && line.back() == ' ') line.pop_back();
            if (depth == 0)
                for (const std::string& name : data_of(line)) members.push_back(name);
            for (const char c : line) depth += c == '{' ? 1 : c == '}' ? -1 : 0;
            at = end + 1;
        }
        if (!members.empty()) structs[(*i)[1]] = members;
    }
}

}  // namespace quadrel::annotate
