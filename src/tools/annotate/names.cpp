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

/// What is computed of an axis: names end in its letter.
std::string named_for(const std::string& axis, const std::string& expression) {
    return "(recorded::NamedFor(" + quoted(axis) + "), " + expression + ")";
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
    std::string axis;  ///< that it has several values of
};

/// What a line begins to declare or to assign, a right-hand side in the next line included; no name
/// where it does neither.
Head head_of(const std::string& line) {
    static const std::regex declaration(
        R"(^\s*(?:const\s+)?(?:F|Mask<F>|Int<F>|vec[234]<F>|auto)\s+(\w+) =(?: (?!\{)|$))");
    static const std::regex assignment(R"(^\s*((?:this->)?\w+(?:(?:\.|->)\w+)*) =(?: (?!\{)|$))");
    static const std::regex declaration_of_axis(
        R"(^\s*(?:const\s+)?(?:auto|(?!\w*Jacobian)[A-Z]\w+(?:<F>)?)\s+([xyuvij]) =(?: (?!\{)|$))");
    static const std::regex assignment_of_axis(
        R"(^\s*((?:this->)?\w+(?:(?:\.|->)\w+)*\.([xyuvij])) =(?: (?!\{)|$))");
    static const std::regex other(R"(constexpr|static |^\s*(using|template|for|//|return)\b)");
    std::smatch found;
    if (std::regex_search(line, other)) return {};
    // What counts has the name of the counter that it is handed.
    if (line.find("counter = ") != std::string::npos) return {};
    const auto head = [&](bool is_declaration, const std::string& axis) {
        return Head{found[1], static_cast<std::size_t>(found.length()), is_declaration, axis};
    };
    if (std::regex_search(line, found, declaration_of_axis)) return head(true, found[1]);
    if (std::regex_search(line, found, declaration)) return head(true, "");
    if (std::regex_search(line, found, assignment_of_axis)) return head(false, found[2]);
    if (std::regex_search(line, found, assignment)) return head(false, "");
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
    std::string result, name = head.name + comments, axis = head.axis;
    for (;;) {
        end = end_of(text, at, head.is_declaration ? ";," : ";");
        if (end == std::string::npos) return "";
        const std::string expression = text.substr(at, end - at);
        if (is_left_alone(expression)) return "";
        result += named(name, axis.empty() ? expression : named_for(axis, expression));
        if (text[end] == ';') return result;
        std::smatch found;
        const std::string rest = text.substr(end, 200);
        if (!std::regex_search(rest, found, next_name)) return result;  // one without a value
        result += rest.substr(0, static_cast<std::size_t>(found.length()));
        name = found[1];
        if (!axis.empty()) axis = name;
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

// ---- Axes ---------------------------------------------------------------------------------------

/// `PrismAxis<F> x(u, K), y(v, K);`, the first argument named for its axis.
std::string with_named_axes(const std::string& text) {
    static const std::regex first(R"(\n\s*(?:const )?(?!Mask<|Int<)[A-Z]\w+<F> ([xyuvij])\()");
    static const std::regex next(R"(^\),\s*([xyuvij])\()");
    std::string result;
    std::size_t done = 0;
    for (std::sregex_iterator i(text.begin(), text.end(), first), last; i != last; ++i) {
        std::string axis = (*i)[1];
        std::size_t open = static_cast<std::size_t>(i->position() + i->length()) - 1;
        for (;;) {
            const std::size_t end = std::min(end_of(text, open + 1, ","), match(text, open));
            if (end == std::string::npos) break;
            result += text.substr(done, open + 1 - done) +
                      named_for(axis, text.substr(open + 1, end - open - 1));
            done = end;
            std::smatch found;
            const std::string rest = text.substr(match(text, open), 40);
            if (!std::regex_search(rest, found, next)) break;
            axis = found[1];
            open = match(text, open) + static_cast<std::size_t>(found.length()) - 1;
        }
    }
    return result + text.substr(done);
}

/// `ray.x.exit(i)`, what it computes named for its axis.
std::string with_named_members(const std::string& text) {
    static const std::regex call(R"((?:\w+(?:\.|->))*\b([xy])\.(?!node\b)\w+\()");
    std::string result;
    std::size_t done = 0;
    for (std::sregex_iterator i(text.begin(), text.end(), call), last; i != last; ++i) {
        const auto at = static_cast<std::size_t>(i->position());
        const std::size_t close = match(text, at + static_cast<std::size_t>(i->length()) - 1);
        const char before = at > 0 ? text[at - 1] : ' ';
        const bool is_whole = !is_word(before) && before != '.' && before != '>' && before != ')';
        if (at < done || close == std::string::npos || !is_whole) continue;
        result += text.substr(done, at - done) + "recorded::of_axis(" + quoted((*i)[1]) +
                  ", [&] { return " + text.substr(at, close + 1 - at) + "; })";
        done = close + 1;
    }
    return result + text.substr(done);
}

}  // namespace

std::string with_names(const std::string& text, const Structs& structs) {
    // What goes through both axes of something.
    static const std::regex both_axes(R"((for \(\w+<F>\* (\w+) : \{(&[\w.]+\.)x, \3y\}\) \{))");
    static const std::regex count(R"((\n\s*)count_in<F>\(([\w.>-]+), ([^;]*)\);)");
    static const std::regex block(R"(\bif \(when\()"), flag(R"(\bInt<F>\(HitFlag::)");
    const std::string axes =
        std::regex_replace(with_named_axes(with_named_members(text)), both_axes,
                           "$1 const recorded::NamedFor of_axis($2 == $3x ? \"x\" : \"y\");");
    const std::string values = with_named_values(with_named_results(axes, structs));
    const std::string counts =
        std::regex_replace(values, count, "$1count_in<F>($2, $3); $2 = named(\"$2\", $2);");
    const std::string blocks =
        std::regex_replace(counts, block, "if (const auto in_block = branch(");
    return std::regex_replace(blocks, flag, "hit_flag<F>(HitFlag::");
}

}  // namespace quadrel::annotate
