#include "io/document/override.hpp"

#include <charconv>
#include <variant>

#include "io/document/keys.hpp"
#include "io/document/value.hpp"
#include "quadrel/error.hpp"
#include "text/printable.hpp"
#include "text/shell_word.hpp"

namespace quadrel {
namespace {

using PathPart = std::variant<std::string, std::size_t>;  // a key, or an index

[[noreturn]] void malformed(const std::string& assignment) {
    constexpr std::size_t most = 80;
    throw UsageError("-D " + shortened(assignment, most) +
                     ": expected KEY=VALUE, the key as in camera.eye or objects[0].mesh");
}

std::size_t parse_index(const std::string& digits, const std::string& assignment) {
    std::size_t index = 0;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, index);
    if (digits.empty() || stop != end || error != std::errc()) malformed(assignment);
    return index;
}

// One dotted part: "name", "name[1]", "name[1][2]".
void parse_part(std::string part, const std::string& assignment, std::vector<PathPart>& steps) {
    const auto bracket = part.find('[');
    const std::string name = part.substr(0, bracket);
    if (name.empty()) malformed(assignment);
    steps.emplace_back(name);
    part = bracket == std::string::npos ? "" : part.substr(bracket);
    while (!part.empty()) {
        const auto close = part.find(']');
        if (part[0] != '[' || close == std::string::npos) malformed(assignment);
        steps.emplace_back(parse_index(part.substr(1, close - 1), assignment));
        part = part.substr(close + 1);
    }
}

std::vector<PathPart> parse_path(const std::string& path, const std::string& assignment) {
    std::vector<PathPart> steps;
    std::size_t start = 0;
    while (true) {
        const auto dot = path.find('.', start);
        parse_part(path.substr(start, dot == std::string::npos ? dot : dot - start), assignment,
                   steps);
        if (dot == std::string::npos) return steps;
        start = dot + 1;
    }
}

// Walks down the document and the table of keys at once.
class Walker {
  public:
    explicit Walker(SceneDocument& document) : document_(document), at_(&document.root) {}

    void descend(const PathPart& step) {
        if (const auto* index = std::get_if<std::size_t>(&step))
            into_element(*index);
        else
            into_member(std::get<std::string>(step));
    }
    void set(Json value) {
        *at_ = std::move(value);
        document_.overridden.insert(path_);
    }
    const std::string& path() const { return path_; }
    /// Takes the key that was reached last out of its object.
    void remove() {
        if (parent_ == nullptr) fail(path_, "null for an element", "a key, which null removes");
        parent_->erase(key_);
        document_.overridden.insert(path_);
    }

  private:
    [[noreturn]] void fail(const std::string& path, const std::string& found,
                           const std::string& expected) const {
        throw InputError(document_.file.string(), path, found + " (set by -D)", expected);
    }

    void into_element(std::size_t index) {
        const std::string path = join_index(path_, index);
        if (!at_->is_array()) fail(path, "an index into " + describe(*at_), "an array");
        if (index >= at_->size())
            fail(path, "index " + std::to_string(index),
                 "less than " + std::to_string(at_->size()));
        parent_ = nullptr;
        at_ = &(*at_)[index];
        path_ = path;
        if (below_ == Below::list) below_ = Below::object;
    }

    void into_member(const std::string& key) {
        const std::string path = join_key(path_, key);
        if (below_ == Below::names)
            into_name(key, path);
        else
            into_key(key, path);
        parent_ = at_;
        key_ = key;
        at_ = &(*at_)[key];
        path_ = path;
    }

    /// Names are not made up on the way, since a mistyped one would change nothing in silence.
    std::string how_to_add(const std::string& name) const {
        return "a name that the scene has, and it has none; -D " +
               shell_word(path_ + "={\"" + name + "\": {...}}") + " adds it";
    }

    void into_name(const std::string& name, const std::string& path) {
        std::vector<std::string> names;
        if (at_->is_object())
            for (const auto& [known, member] : at_->items()) names.push_back(known);
        if (!at_->is_object() || !at_->contains(name))
            fail(path, "an unknown name", names.empty() ? how_to_add(name) : one_of(name, names));
        below_ = Below::object;
    }

    void into_key(const std::string& key, const std::string& path) {
        if (below_ != Below::object) fail(path, "a key below " + describe(*at_), "none there");
        // A stage may be named by its id alone; a parameter of it makes the id a member. So it is
        // with a face and its file.
        if (section_ == "stage" && at_->is_string()) *at_ = Json{{"id", *at_}};
        if (section_ == "face" && at_->is_string()) *at_ = Json{{"file", *at_}};
        if (at_->is_null()) *at_ = Json::object();
        if (!at_->is_object()) fail(path, "a key below " + describe(*at_), "an object there");
        const SceneKey* row = find_scene_key(section_, key);
        if (!row && !takes_parameters(section_))
            fail(path, "an unknown key", one_of(key, keys_of_section(section_)));
        below_ = row ? row->below : Below::value;
        section_ = row ? row->below_section : std::string_view();
    }

    SceneDocument& document_;
    Json* at_;
    Json* parent_ = nullptr;  ///< the object that has key_; null at the root and at elements
    std::string key_;
    std::string path_;
    Below below_ = Below::object;
    std::string_view section_ = "scene";
};

// `material` stands for the first of `materials` in a scene that has only those.
void resolve_material(const Json& root, std::vector<PathPart>& steps) {
    if (std::get<std::string>(steps[0]) != "material" || root.contains("material")) return;
    if (!root.contains("materials") || !root["materials"].is_object() || root["materials"].empty())
        return;
    steps[0] = root["materials"].begin().key();
    steps.insert(steps.begin(), "materials");
}

/// Whether the whole path is there already.
bool exists(const Json& root, const std::vector<PathPart>& steps) {
    const Json* at = &root;
    for (const PathPart& step : steps) {
        const auto* key = std::get_if<std::string>(&step);
        const bool there = key ? at->is_object() && at->contains(*key)
                               : at->is_array() && std::get<std::size_t>(step) < at->size();
        if (!there) return false;
        at = key ? &(*at)[*key] : &(*at)[std::get<std::size_t>(step)];
    }
    return true;
}

void remove_key(SceneDocument& document, const std::vector<PathPart>& steps) {
    // Where there is nothing to remove, nothing is made on the way; the path must be right, though.
    SceneDocument copy;
    const bool there = exists(document.root, steps);
    if (!there) copy = document;
    Walker walker(there ? document : copy);
    for (const PathPart& step : steps) walker.descend(step);
    walker.remove();
}

/// The value of an assignment to `path`.
Json option_value(const SceneDocument& document, const std::string& path, const std::string& text) {
    try {
        return parse_option_value(text);
    } catch (const InputError& error) {
        const std::string key =
            error.key.starts_with('[') ? path + error.key : join_key(path, error.key);
        throw InputError(document.file.string(), key, error.found + " (set by -D)", error.expected);
    }
}

}  // namespace

void apply_override(SceneDocument& document, const std::string& assignment) {
    const auto equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) malformed(assignment);
    std::vector<PathPart> steps = parse_path(assignment.substr(0, equals), assignment);
    resolve_material(document.root, steps);
    const std::string text = assignment.substr(equals + 1);
    if (text == "null") return remove_key(document, steps);
    Walker walker(document);
    for (const PathPart& step : steps) walker.descend(step);
    walker.set(option_value(document, walker.path(), text));
}

}  // namespace quadrel
