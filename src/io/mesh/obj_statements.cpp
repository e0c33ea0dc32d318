#include "io/mesh/obj_statements.hpp"

#include <algorithm>

namespace quadrel {
namespace {

constexpr std::string_view blanks = " \t\v\f";

std::string_view without_end_blanks(std::string_view line) {
    const auto last = line.find_last_not_of(blanks);
    return line.substr(0, last == line.npos ? 0 : last + 1);
}

}  // namespace

ObjStatements::ObjStatements(std::string_view text) : rest_(text) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
}

std::string_view ObjStatements::take_line() {
    const auto end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end);
    if (rest_.starts_with("\r\n"))
        rest_.remove_prefix(2);
    else if (!rest_.empty())
        rest_.remove_prefix(1);
    ++lines_;
    return line;
}

// Whether the statement continues on the next line.
bool ObjStatements::add_words(std::string_view line) {
    line = without_end_blanks(line.substr(0, line.find('#')));
    const bool continued = line.ends_with('\\');
    if (continued) line.remove_suffix(1);
    while (true) {
        const auto start = line.find_first_not_of(blanks);
        if (start == line.npos) return continued;
        line.remove_prefix(start);
        const auto end = std::min(line.find_first_of(blanks), line.size());
        words_.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
}

bool ObjStatements::next() {
    words_.clear();
    while (!rest_.empty()) {
        line_ = lines_ + 1;
        while (add_words(take_line()) && !rest_.empty()) {
        }
        if (!words_.empty()) return true;
    }
    return false;
}

}  // namespace quadrel
