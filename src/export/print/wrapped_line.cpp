#include "export/print/wrapped_line.hpp"

#include <climits>
#include <cstring>

namespace quadrel::recorded {
namespace {

constexpr std::size_t longest_line = 100;

/// `line` may be broken behind position i.
bool breaks_at(const std::string& line, std::size_t i) {
    if (line[i] != ' ' || std::strchr(",=+-*/?:&|<>", line[i - 1]) == nullptr) return false;
    if (line[i - 1] == ':') return line[i - 2] == ' ';  // of a choice, not of a type
    return line[i - 1] != '&' || line[i - 2] == ' ' || line[i - 2] == '&';
}

}  // namespace

std::string wrapped_line(const std::string& line) {
    std::size_t lead = line.find_first_not_of(' ');
    if (line.size() <= longest_line || lead == std::string::npos) return line;
    const bool is_comment = line.compare(lead, 2, "//") == 0;
    const std::string indent =
        is_comment ? std::string(lead, ' ') + "// " : std::string(lead + 4, ' ');
    std::string rest = line, result;
    while (rest.size() > longest_line) {
        int open = 0, fewest = INT_MAX;
        std::size_t at = std::string::npos;
        for (std::size_t i = lead + 1; i < longest_line; ++i) {
            if (rest[i] == '(') ++open;
            if (rest[i] == ')') --open;
            if (i <= lead + 20 || open > fewest) continue;
            if (is_comment ? rest[i] != ' ' : !breaks_at(rest, i)) continue;
            fewest = open;
            at = i;
        }
        // Nowhere before: as soon as it may be.
        for (std::size_t i = longest_line; at == std::string::npos && i + 1 < rest.size(); ++i)
            if (!is_comment && breaks_at(rest, i)) at = i;
        if (at == std::string::npos) break;
        result += rest.substr(0, at) + "\n";
        rest = indent + rest.substr(at + 1);
        lead = indent.size();
    }
    return result + rest;
}

}  // namespace quadrel::recorded
