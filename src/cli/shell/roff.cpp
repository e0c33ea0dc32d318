#include "cli/shell/roff.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace quadrel::cli {
namespace {

std::string upper_case(std::string_view text) {
    std::string upper(text);
    for (char& c : upper)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return upper;
}

/// A character as roff has it; what would be taken for a hyphen or a quotation mark of typography
/// stays what shells read.
std::string roff_character(char c) {
    switch (c) {
        case '\\':
            return "\\e";
        case '-':
            return "\\-";
        case '\'':
            return "\\(aq";
        case '^':
            return "\\(ha";
        case '~':
            return "\\(ti";
        case '"':
            return "\\(dq";
        default:
            return {c};
    }
}

/// A line that begins with a dot would be a request.
std::string as_line(const std::string& roff) { return roff.starts_with('.') ? "\\&" + roff : roff; }

}  // namespace

std::string roff_text(std::string_view text) {
    std::string roff;
    bool bold = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '`') {
            bold = !bold;
            roff += bold ? "\\fB" : "\\fR";
            continue;
        }
        if (text[i] == '.' && (i == 0 || text[i - 1] == '\n')) roff += "\\&";
        roff += roff_character(text[i]);
    }
    return bold ? roff + "\\fR" : roff;
}

std::string roff_bold(std::string_view text) { return "\\fB" + roff_text(text) + "\\fR"; }

std::string roff_italic(std::string_view text) { return "\\fI" + roff_text(text) + "\\fR"; }

RoffPage::RoffPage(std::string_view title, int section, std::string_view source)
    : text_(fmt::format(".TH {} {} \"\" \"{}\" \"Quadrel\"\n.nh\n.ad l\n",
                        roff_text(upper_case(title)), section, source)) {}

void RoffPage::section(std::string_view name) {
    text_ += ".SH \"" + roff_text(upper_case(name)) + "\"\n";
}

void RoffPage::subsection(std::string_view name) { text_ += ".SS \"" + roff_text(name) + "\"\n"; }

/// A heading begins a paragraph by itself.
void RoffPage::begin_paragraph() {
    const std::size_t end = text_.rfind('\n', text_.size() - 2);
    if (text_.compare(end + 1, 2, ".S") != 0) text_ += ".PP\n";
}

void RoffPage::raw(const std::string& lines) {
    begin_paragraph();
    text_ += lines;
}

void RoffPage::paragraph(std::string_view text) {
    begin_paragraph();
    text_ += as_line(roff_text(text)) + "\n";
}

void RoffPage::item(const std::string& term, std::string_view text) {
    text_ += ".TP\n" + as_line(term) + "\n" + as_line(roff_text(text)) + "\n";
}

void RoffPage::listing(std::string_view lines) {
    begin_paragraph();
    text_ += ".nf\n";
    while (!lines.empty()) {
        const std::size_t end = std::min(lines.find('\n'), lines.size());
        const std::string line = roff_text(lines.substr(0, end));
        text_ += (line.empty() ? "\\&" : as_line(line)) + "\n";
        lines.remove_prefix(std::min(end + 1, lines.size()));
    }
    text_ += ".fi\n";
}

}  // namespace quadrel::cli
