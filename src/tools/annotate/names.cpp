#include "tools/annotate/names.hpp"

#include <algorithm>
#include <regex>

namespace quadrel::annotate {
namespace {

/// A string of C++.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '\n')
            result += "\\n";
        else if (c == '"' || c == '\\')
            result += '\'';
        else
            result += c;
    }
    return result + "\"";
}

std::string named(const std::string& name, const std::string& expression) {
    return "named(" + quoted(name) + ", " + expression + ")";
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \n");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \n") - first + 1);
}

/// The whole lines of comment in front of position `line_start`, a line break before each.
std::string comments_before(const std::string& text, std::size_t line_start) {
    std::string comments;
    while (line_start > 1) {
        const std::size_t before = text.rfind('\n', line_start - 2);
        const std::size_t start = before == std::string::npos ? 0 : before + 1;
        const std::string line = trimmed(text.substr(start, line_start - 1 - start));
        if (line.rfind("// ", 0) != 0) break;
        comments = "\n" + line.substr(3) + comments;
        line_start = start;
    }
    return comments;
}

// ---- Right-hand sides ---------------------------------------------------------------------------

struct Head {
    std::string name;
    std::size_t length = 0;  ///< up to the right-hand side
    bool is_declaration = false;
};

/// What a line begins to declare or to assign, a right-hand side in the next line included; no name
/// where it does neither.
Head head_of(const std::string& line) {
    static const std::regex declaration(
        R"(^\s*(?:const\s+)?(?:F|Mask<F>|Int<F>|vec[234]<F>|auto)\s+(\w+) =(?: (?!\{)|$))");
    static const std::regex assignment(R"(^\s*((?:this->)?\w+(?:(?:\.|->)\w+)*) =(?: (?!\{)|$))");
    static const std::regex other(R"(constexpr|static |^\s*(using|template|for|//|return)\b)");
    std::smatch found;
    if (std::regex_search(line, other)) return {};
    // What counts has the name of the counter that it is handed.
    if (line.find("counter = ") != std::string::npos) return {};
    if (std::regex_search(line, found, declaration))
        return {found[1], static_cast<std::size_t>(found.length()), true};
    if (std::regex_search(line, found, assignment))
        return {found[1], static_cast<std::size_t>(found.length()), false};
    return {};
}

/// Whether an expression makes no value with lanes, as far as one sees.
bool is_left_alone(const std::string& expression) {
    const std::string bare = trimmed(expression);
    return bare.empty() || bare[0] == '[' || bare[0] == '{' || bare[0] == '&';
}

/// One statement from `at` on, the right-hand side of `head`; where it ends. Empty: leave it.
std::string named_statement(const std::string& text, std::size_t at, const Head& head,
                            const std::string& comments, std::size_t& end) {
    static const std::regex next_name(R"(^,\s*(\w+) = (?!\{))");
    std::string result, name = head.name + comments;
    for (;;) {
        end = end_of(text, at, head.is_declaration ? ";," : ";");
        if (end == std::string::npos) return "";
        const std::string expression = text.substr(at, end - at);
        if (is_left_alone(expression)) return "";
        result += named(name, expression);
        if (text[end] == ';') return result;
        std::smatch found;
        const std::string rest = text.substr(end, 200);
        if (!std::regex_search(rest, found, next_name)) return result;  // one without a value
        result += rest.substr(0, static_cast<std::size_t>(found.length()));
        name = found[1];
        at = end + static_cast<std::size_t>(found.length());
    }
}

std::string with_named_values(const std::string& text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t line_end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, line_end - at);
        const Head head = head_of(line);
        std::size_t end = 0;
        const std::string statement =
            head.name.empty()
                ? ""
                : named_statement(text, at + head.length, head, comments_before(text, at), end);
        if (statement.empty()) {
            result += text.substr(at, line_end + 1 - at);
            at = line_end + 1;
            continue;
        }
        result += line.substr(0, head.length) + statement;
        const std::size_t rest_end = std::min(text.find('\n', end), text.size());
        result += text.substr(end, rest_end + 1 - end);
        at = rest_end + 1;
    }
    return result;
}

// ---- Results ------------------------------------------------------------------------------------

bool has_lanes(const std::string& type) {
    static const std::regex packets(R"(^(F|Mask<F>|Int<F>|vec[234]<F>|)$)");
    return std::regex_search(type, packets);
}

/// `{a, b}` with the names of a struct's members; empty where they do not fit.
std::string named_members(const std::string& braces, const std::vector<std::string>& members) {
    std::vector<std::string> parts;
    for (std::size_t at = 1;;) {
        const std::size_t comma = end_of(braces, at, ",");
        const std::size_t end = comma != std::string::npos ? comma : braces.size() - 1;
        parts.push_back(trimmed(braces.substr(at, end - at)));
        if (comma == std::string::npos) break;
        at = comma + 1;
    }
    if (parts.size() != members.size()) return "";
    std::string result;
    for (std::size_t i = 0; i < parts.size(); ++i)
        result += (i > 0 ? ", " : "") +
                  (is_left_alone(parts[i]) ? parts[i] : named("?" + members[i], parts[i]));
    return "{" + result + "}";
}

std::string named_result(const std::string& expression, const Scope& scope,
                         const Structs& structs) {
    static const std::regex other(R"(^(store|io\.|\[|named|\w+<F>\{|\*this))");
    if (scope.name.empty()) return "";
    if (expression[0] == '{') {
        const auto found = structs.find(scope.type.substr(0, scope.type.find('<')));
        return found != structs.end() ? named_members(expression, found->second) : "";
    }
    if (!has_lanes(scope.type) || std::regex_search(expression, other)) return "";
    return named("?" + scope.name, expression);
}

std::string with_named_results(const std::string& text, const Structs& structs) {
    static const std::regex statement(R"(\breturn )");
    const std::vector<Scope> scopes = scopes_of(text);
    std::string result;
    std::size_t done = 0;
    for (std::sregex_iterator i(text.begin(), text.end(), statement), last; i != last; ++i) {
        const auto at = static_cast<std::size_t>(i->position());
        const std::size_t from = at + static_cast<std::size_t>(i->length());
        const Scope* inner = nullptr;
        for (const Scope& scope : scopes)
            if (scope.begin < at && at < scope.end &&
                (inner == nullptr || scope.begin > inner->begin ||
                 (scope.begin == inner->begin && inner->name.empty())))
                inner = &scope;
        const std::size_t end = end_of(text, from, ";");
        if (inner == nullptr || end == std::string::npos || from < done) continue;
        const std::string replacement =
            named_result(text.substr(from, end - from), *inner, structs);
        if (replacement.empty()) continue;
        result += text.substr(done, from - done) + replacement;
        done = end;
    }
    return result + text.substr(done);
}

}  // namespace

std::string with_names(const std::string& text, const Structs& structs) {
    static const std::regex count(R"((\n\s*)count_in<F>\(([\w.>-]+), ([^;]*)\);)");
    static const std::regex block(R"(\bif \(when\()"), flag(R"(\bInt<F>\(HitFlag::)");
    const std::string values = with_named_values(with_named_results(text, structs));
    const std::string counts =
        std::regex_replace(values, count, "$1count_in<F>($2, $3); $2 = named(\"$2\", $2);");
    const std::string blocks =
        std::regex_replace(counts, block, "if (const auto in_block = branch(");
    return std::regex_replace(blocks, flag, "hit_flag<F>(HitFlag::");
}

}  // namespace quadrel::annotate
