// Typed reading of a scene file's values. Every failure names the file, the line, the key, what
// was found and what was expected.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/document/json.hpp"
#include "text/suggest.hpp"

namespace quadrel {

/// An interval of allowed numbers; `open` leaves out the ends.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool open = false;

    bool contains(double x) const { return open ? low < x && x < high : low <= x && x <= high; }
    std::string text(std::string_view kind) const;
};

inline constexpr Range any_number{};
inline constexpr Range not_negative{.low = 0};
inline constexpr Range above_zero{.low = 0, .open = true};
inline constexpr Range unit_interval{.low = 0, .high = 1};

/// A word of the scene format and what it means.
template <class T>
using Word = std::pair<std::string_view, T>;

/// One JSON value and where it stands.
class SceneValue {
  public:
    SceneValue(const SceneDocument& document, const Json& json, std::string path)
        : document_(&document), json_(&json), path_(std::move(path)) {}

    const Json& json() const { return *json_; }
    const std::string& path() const { return path_; }
    const SceneDocument& document() const { return *document_; }

    /// Throws InputError at this value.
    [[noreturn]] void fail(const std::string& found, const std::string& expected) const;
    /// Throws InputError with the value itself as what was found.
    [[noreturn]] void reject(const std::string& expected) const;

    double number(Range range = any_number) const;
    float real(Range range = any_number) const;  ///< a finite float32
    int integer(int low, int high) const;
    bool boolean() const;
    std::string string() const;
    /// An array of `least` to `most` numbers.
    std::vector<double> numbers(std::size_t least, std::size_t most,
                                Range range = any_number) const;
    glm::vec3 vector3(Range range = any_number) const;

    SceneValue element(std::size_t index) const {
        return {*document_, (*json_)[index], join_index(path_, index)};
    }
    SceneValue member(const std::string& key) const {
        return {*document_, (*json_)[key], join_key(path_, key)};
    }

    template <class T, std::size_t N>
    T word(const Word<T> (&words)[N]) const {
        const std::string found = string();
        std::vector<std::string_view> known;
        for (const auto& [name, meaning] : words) {
            if (name == found) return meaning;
            known.push_back(name);
        }
        reject(one_of(found, known));
    }

  private:
    const SceneDocument* document_;
    const Json* json_;
    std::string path_;
};

/// What a value is, for messages: `the string "x"`, `an array of 3`.
std::string describe(const Json& json);

/// The members of an object, each to be taken once; `finish` finds those that nobody took. The
/// `read` functions leave their target (the default) alone when the key is absent.
class Fields {
  public:
    explicit Fields(const SceneValue& value);

    const SceneValue& value() const { return value_; }
    bool has(const std::string& key) const { return value_.json().contains(key); }
    SceneValue get(const std::string& key);  ///< throws InputError if absent

    void read(const std::string& key, float& out, Range range = any_number);
    void read(const std::string& key, double& out, Range range = any_number);
    void read(const std::string& key, int& out, int low, int high);
    void read(const std::string& key, bool& out);
    void read(const std::string& key, std::string& out);
    void read(const std::string& key, glm::vec3& out, Range range = any_number);
    /// Three or four numbers; with three, w keeps its value.
    void read(const std::string& key, glm::vec4& out, Range range = any_number);
    template <class T, std::size_t N>
    void read(const std::string& key, T& out, const Word<T> (&words)[N]) {
        if (has(key)) out = get(key).word(words);
    }

    /// Keys not yet taken, in the file's order; they count as taken from now on.
    std::vector<std::string> rest();
    /// Throws InputError if a key was not taken; `owner` says what does not take it.
    void finish(const std::string& owner);

  private:
    SceneValue value_;
    std::set<std::string> taken_;
};

}  // namespace quadrel
