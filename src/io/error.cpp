#include "quadrel/error.hpp"

#include <fmt/format.h>

#include "io/printable.hpp"

namespace quadrel {
namespace {

std::string input_message(const std::string& file, const std::string& key, const std::string& found,
                          const std::string& expected, int line, int column) {
    std::string text = file;
    if (line > 0) text += fmt::format(":{}:{}", line, column);
    if (!key.empty()) text += (text.empty() ? "" : ": ") + shortened(key);
    text += ": found " + shortened(found);
    if (!expected.empty()) text += ", expected " + expected;
    return printable(text);
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
    : std::runtime_error(printable(file_ + ": " + reason_)),
      file(std::move(file_)),
      reason(std::move(reason_)) {}

}  // namespace quadrel
