// HTML pages that need nothing else: texts of the data directory with marks, and what fills them.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "io/document/json.hpp"

namespace quadrel::page {

/// A file of the data directory, by its path there. Throws InputError.
std::string page_part(const std::filesystem::path& relative);

/// Several, one after the other.
std::string page_parts(std::initializer_list<const char*> relative);

/// A page whose marks are filled from the last to the first, so that none is looked for in what
/// was filled in.
class PageTemplate {
  public:
    /// Of the data directory. Throws InputError.
    explicit PageTemplate(const std::filesystem::path& relative);

    /// Puts `text` in the place of the mark. Throws InputError where the template has none.
    void fill(std::string_view mark, std::string_view text);

    const std::string& text() const { return text_; }

  private:
    std::filesystem::path file_;
    std::string text_;
};

/// For a script element of JSON: no text in it can end the element. Bytes that are no UTF-8 are
/// replaced.
std::string embedded_json(const Json& json);

/// For an element's text.
std::string escaped_text(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace quadrel::page
