// The statements of an OBJ file.
#pragma once

#include <string_view>
#include <vector>

namespace quadrel {

/// Statements of a text one after the other. Lines end in LF, CR LF or CR; a byte-order mark before
/// the first is no part of it. A comment, from # on, ends with its line, whatever its last
/// character is; otherwise a backslash at a line's end continues the statement on the next.
class ObjStatements {
  public:
    explicit ObjStatements(std::string_view text);

    /// Reads the next statement that has words. False at the end.
    bool next();

    /// Of the statement, at least one; they point into the text.
    const std::vector<std::string_view>& words() const { return words_; }
    /// Where it begins, from 1.
    int line() const { return line_; }

  private:
    std::string_view take_line();
    bool add_words(std::string_view line);

    std::string_view rest_;
    std::vector<std::string_view> words_;
    int lines_ = 0, line_ = 0;
};

}  // namespace quadrel
