// The text of man pages, by the macros of man(7) that groff and mandoc share.
#pragma once

#include <string>
#include <string_view>

namespace quadrel::cli {

/// Plain text or Markdown of one line as roff: nothing of it is a request; what stands in backticks
/// is bold. Line breaks stay.
std::string roff_text(std::string_view text);

/// A page that grows from the top down.
class RoffPage {
  public:
    /// `title` as "quadrel-render", of a section of the manual; `source` is the program with its
    /// version.
    RoffPage(std::string_view title, int section, std::string_view source);

    void section(std::string_view name);
    void subsection(std::string_view name);
    void paragraph(std::string_view text);
    /// A term, which is roff already, and what is to be said of it.
    void item(const std::string& term, std::string_view text);
    /// Lines as they are, in a fixed pitch.
    void listing(std::string_view lines);
    /// A paragraph that is roff already.
    void raw(const std::string& lines);

    const std::string& text() const { return text_; }

  private:
    void begin_paragraph();

    std::string text_;
};

/// Roff in bold or italic.
std::string roff_bold(std::string_view text);
std::string roff_italic(std::string_view text);

}  // namespace quadrel::cli
