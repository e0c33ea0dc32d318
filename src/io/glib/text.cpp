#include "io/glib/text.hpp"

#include <algorithm>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_bracket(char c) { return c == '<' || c == '>'; }

std::string_view without_comment(std::string_view line) {
    for (std::size_t i = 0; i < line.size(); ++i)
        if (line[i] == '#' && (i == 0 || is_blank(line[i - 1]))) return line.substr(0, i);
    return line;
}

std::string_view without_blanks_behind(std::string_view line) {
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    return line;
}

std::vector<GlibWord> words_of(std::string_view line, int number) {
    std::vector<GlibWord> words;
    for (std::size_t i = 0; i < line.size();) {
        if (is_blank(line[i])) {
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        if (!is_bracket(line[i]))
            while (end < line.size() && !is_blank(line[end]) && !is_bracket(line[end])) ++end;
        words.push_back({std::string(line.substr(i, end - i)), {number, static_cast<int>(i) + 1}});
        i = end;
    }
    return words;
}

// Takes the file line by line.
class Splitter {
  public:
    void take(std::string_view line, int number) {
        line = without_blanks_behind(without_comment(line));
        const bool continues = !line.empty() && line.back() == '\\';
        if (continues) line.remove_suffix(1);
        std::vector<GlibWord> words = words_of(line, number);
        if (words.empty() && !continues) return;
        if (!words.empty()) add(std::move(words));
        open_ = continues && !commands_.empty() && (open_ || commands_.back().end.line == number);
        if (open_) backslash_ = {number, static_cast<int>(line.size()) + 1};
    }

    std::vector<GlibCommand> finish(const std::filesystem::path& file) {
        if (open_)
            throw InputError(file.string(), commands_.back().name.text,
                             "the end of the file after a backslash", "the rest of the command",
                             backslash_.line, backslash_.column);
        return std::move(commands_);
    }

  private:
    void add(std::vector<GlibWord> words) {
        const GlibWord last = words.back();
        if (!open_) {
            commands_.push_back({words.front(), {}, {}});
            words.erase(words.begin());
        }
        GlibCommand& command = commands_.back();
        command.arguments.insert(command.arguments.end(), words.begin(), words.end());
        command.end = {last.at.line, last.at.column + static_cast<int>(last.text.size())};
    }

    std::vector<GlibCommand> commands_;
    bool open_ = false;
    TextPosition backslash_;
};

}  // namespace

std::vector<GlibCommand> split_glib(std::string_view text, const std::filesystem::path& file) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
    Splitter splitter;
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        splitter.take(line, number);
    }
    return splitter.finish(file);
}

std::string quoted(const std::string& word) {
    std::string text = word.substr(0, 60);
    for (char& c : text)
        if (c < ' ' || c > '~') c = '?';
    return "\"" + text + (word.size() > 60 ? "...\"" : "\"");
}

}  // namespace quadrel
