#include "io/document/json.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

#include "quadrel/error.hpp"
#include "text/not_finite.hpp"

namespace quadrel {
namespace {

// nlohmann's events carry no position; this iterator tells how far its lexer has read.
class CountingIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    CountingIterator(const char* at, const char** reached) : at_(at), reached_(reached) {}
    reference operator*() const { return *at_; }
    CountingIterator& operator++() {
        ++at_;
        *reached_ = at_;
        return *this;
    }
    CountingIterator operator++(int) {
        CountingIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
    bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

  private:
    const char* at_;
    const char** reached_;
};

// Where each line of a text begins.
class Lines {
  public:
    explicit Lines(std::string_view text) : size_(text.size()) {
        for (std::size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') starts_.push_back(i + 1);
    }
    TextPosition position_at(std::size_t offset) const {
        offset = std::min(offset, size_);
        const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
        return {static_cast<int>(next - starts_.begin()),
                static_cast<int>(offset - *std::prev(next)) + 1};
    }

  private:
    std::size_t size_;
    std::vector<std::size_t> starts_{0};
};

// A file of more is no scene. Each position has its path, and keys are found one after another.
constexpr std::size_t most_bytes = std::size_t(1) << 22, most_levels = 50, most_members = 4096,
                      longest_key = 200;

// Builds the tree from the parser's events.
class TreeBuilder : public nlohmann::json_sax<Json> {
  public:
    TreeBuilder(SceneDocument& document, std::string_view text, const char* const& reached)
        : document_(document), text_(text), lines_(text), reached_(reached) {}

    bool null() override { return add(nullptr), true; }
    bool boolean(bool value) override { return add(value), true; }
    bool number_integer(number_integer_t value) override { return add(value), true; }
    bool number_unsigned(number_unsigned_t value) override { return add(value), true; }
    bool number_float(number_float_t value, const string_t&) override { return add(value), true; }
    bool string(string_t& value) override { return add(value), true; }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool end_object() override { return open_.pop_back(), true; }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_array() override { return open_.pop_back(), true; }

    bool key(string_t& name) override {
        Level& level = open_.back();
        const TextPosition here =
            lines_.position_at(offset() - std::min(offset(), name.size() + 2));
        if (name.size() > longest_key)
            throw InputError(document_.file.string(), level.path,
                             "a key of " + std::to_string(name.size()) + " bytes",
                             "at most " + std::to_string(longest_key), here.line, here.column);
        const std::string path = join_key(level.path, name);
        if (level.value->contains(name))
            throw InputError(document_.file.string(), path, "the key a second time",
                             "each key once in an object", here.line, here.column);
        if (level.value->size() == most_members)
            throw InputError(document_.file.string(), level.path,
                             "more than " + std::to_string(most_members) + " keys", "a scene",
                             here.line, here.column);
        document_.positions[path] = here;
        level.key = name;
        return true;
    }

    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& error) override {
        refuse_word(position, error);
        const TextPosition here = lines_.position_at(position == 0 ? 0 : position - 1);
        // The library's message is "[...] parse error at line L, column C: what - found; expected".
        std::string found = error.what();
        if (const auto colon = found.find(": "); colon != std::string::npos)
            found = found.substr(colon + 2);
        std::string expected = "JSON";
        if (const auto mark = found.find("; expected "); mark != std::string::npos) {
            expected = found.substr(mark + 11);
            found.resize(mark);
        }
        throw InputError(document_.file.string(), "", found, expected, here.line, here.column);
    }

  private:
    struct Level {
        Json* value;
        std::string path, key;
    };

    /// Throws InputError where the parser stopped at NaN, an infinity or a number beyond double,
    /// which the library names in words of its own.
    void refuse_word(std::size_t position, const nlohmann::detail::exception& error) const {
        constexpr int number_overflow = 406;
        const bool overflow = error.id == number_overflow;
        const bool at_value =
            overflow || std::string_view(error.what()).find("parsing value") != std::string::npos;
        const std::string_view found = word_around(text_, position == 0 ? 0 : position - 1);
        const std::string word(found);
        if (!at_value || !(overflow || spells_not_finite(word))) return;
        const TextPosition here =
            lines_.position_at(static_cast<std::size_t>(found.data() - text_.data()));
        throw InputError(document_.file.string(), path_of_next(),
                         overflow ? "the number " + word : word,
                         overflow ? "a number within the range of float64" : "a finite number",
                         here.line, here.column);
    }

    std::size_t offset() const { return static_cast<std::size_t>(reached_ - text_.data()); }

    std::string path_of_next() const {
        if (open_.empty()) return "";
        const Level& level = open_.back();
        return level.value->is_array() ? join_index(level.path, level.value->size())
                                       : join_key(level.path, level.key);
    }

    Json* add(Json value) {
        if (open_.empty()) return &(document_.root = std::move(value));
        Level& level = open_.back();
        if (level.value->is_array()) {
            level.value->push_back(std::move(value));
            return &level.value->back();
        }
        return &((*level.value)[level.key] = std::move(value));
    }

    bool open(Json value) {
        std::string path = path_of_next();
        document_.positions.try_emplace(path, lines_.position_at(offset() - 1));
        open_.push_back({add(std::move(value)), std::move(path), ""});
        if (open_.size() > most_levels)
            throw InputError(document_.file.string(), "",
                             "more than " + std::to_string(most_levels) + " nested brackets",
                             "a scene");
        return true;
    }

    SceneDocument& document_;
    std::string_view text_;
    Lines lines_;
    const char* const& reached_;
    std::vector<Level> open_;
};

}  // namespace

std::string join_key(const std::string& path, std::string_view key) {
    return path.empty() ? std::string(key) : path + "." + std::string(key);
}

std::string join_index(const std::string& path, std::size_t index) {
    return path + "[" + std::to_string(index) + "]";
}

TextPosition SceneDocument::position_of(std::string path) const {
    while (true) {
        if (const auto found = positions.find(path); found != positions.end()) return found->second;
        const auto cut = path.find_last_of(".[");
        if (cut == std::string::npos) return {};
        path.resize(cut);
    }
}

bool SceneDocument::set_by_option(const std::string& path) const {
    return std::any_of(overridden.begin(), overridden.end(), [&](const std::string& option) {
        if (path.compare(0, option.size(), option) != 0) return false;
        return path.size() == option.size() || path[option.size()] == '.' ||
               path[option.size()] == '[';
    });
}

SceneDocument parse_scene_text(std::string_view text, const std::filesystem::path& file) {
    if (text.size() > most_bytes)
        throw InputError(file.string(), "", std::to_string(text.size()) + " bytes",
                         "a scene of at most " + std::to_string(most_bytes));
    SceneDocument document;
    document.file = file;
    const char* reached = text.data();
    TreeBuilder builder(document, text, reached);
    const char* end = text.data() + text.size();
    Json::sax_parse(CountingIterator(text.data(), &reached), CountingIterator(end, &reached),
                    &builder, nlohmann::detail::input_format_t::json, true, true);
    return document;
}

Json parse_option_value(std::string_view text) {
    try {
        return parse_scene_text(text, "-D").root;
    } catch (const InputError& error) {
        if (!error.key.empty()) throw;
        return std::string(text);
    }
}

}  // namespace quadrel
