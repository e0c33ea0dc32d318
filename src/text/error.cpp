#include "quadrel/error.hpp"

#include <fmt/format.h>

#include "text/printable.hpp"

namespace quadrel {
namespace {

/// What libraries say may be several lines; a message is one.
std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\t') c = ' ';
    return printable(text);
}

/// Of a text that may be as long as a file.
constexpr std::size_t most_shown = 400;

std::string input_message(const std::string& file, const std::string& key, const std::string& found,
                          const std::string& expected, int line, int column) {
    std::string text = file;
    if (line > 0) text += fmt::format(":{}:{}", line, column);
    if (!key.empty()) text += (text.empty() ? "" : ": ") + shortened(key, most_shown);
    text += (text.empty() ? "found " : ": found ") + shortened(found, most_shown);
    if (!expected.empty()) text += ", expected " + expected;
    return one_line(text);
}

}  // namespace

InputError::InputError(std::string file_, std::string key_, std::string found_,
                       std::string expected_, int line_, int column_)
    : std::runtime_error(input_message(file_, key_, found_, expected_, line_, column_)),
      file(std::move(file_)),
      key(std::move(key_)),
      found(std::move(found_)),
      expected(std::move(expected_)),
      line(line_),
      column(column_) {}

OutputError::OutputError(std::string file_, std::string reason_)
    : std::runtime_error(one_line(file_ + ": " + reason_)),
      file(std::move(file_)),
      reason(std::move(reason_)) {}

}  // namespace quadrel
