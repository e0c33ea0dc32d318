// The arguments of one command of a glman scene file, taken from left to right.
#pragma once

#include <string>
#include <string_view>

#include "io/glib/text.hpp"

namespace quadrel {

/// A number and where it stands.
struct GlibNumber {
    double value = 0;
    TextPosition at;
};

/// Every function throws InputError at the word that does not suit, or behind the last one if a
/// word is missing. `meaning` says what is expected: "the field of view in degrees".
class GlibArguments {
  public:
    GlibArguments(const GlibCommand& command, const std::filesystem::path& file)
        : command_(command), file_(file) {}

    const GlibWord& name() const { return command_.name; }
    bool has_more() const { return next_ < command_.arguments.size(); }

    const GlibWord& word(std::string_view meaning);
    GlibNumber number(std::string_view meaning);
    GlibNumber positive_number(std::string_view meaning);
    /// A texture unit: a whole number from 0 to 31.
    int unit();
    /// A number, or the middle one of a slider's range <least default most>.
    GlibNumber number_or_slider(std::string_view meaning);
    /// Throws if a word is left; `signature` is what the command takes.
    void finish(std::string_view signature) const;

    [[noreturn]] void fail(TextPosition at, const std::string& found,
                           const std::string& expected) const;

  private:
    GlibNumber slider(std::string_view meaning);
    void bracket(char which, std::string_view meaning);

    const GlibCommand& command_;
    const std::filesystem::path& file_;
    std::size_t next_ = 0;
};

}  // namespace quadrel
