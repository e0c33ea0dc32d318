#include "io/scene/find_scene.hpp"

#include <algorithm>

#include "file/data_path.hpp"
#include "file/read_file.hpp"
#include "io/glib/commands.hpp"
#include "quadrel/scene/load.hpp"
#include "text/suggest.hpp"

namespace quadrel {
namespace {

// A name that is too long is none that exists, and no reason to give up here.
bool there_is(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::exists(file, error);
}

// "thesis-quad", or "rows/linear" for one in a folder.
bool is_bare_name(const std::filesystem::path& path) {
    if (path.empty() || path.has_extension() || path.is_absolute()) return false;
    return !path.has_parent_path() || !there_is(path);
}

/// The installed scene that a name is nearly: as a whole, or the last part of one in a folder.
std::string nearest_scene(const std::string& name) {
    const std::vector<std::string> scenes = installed_scenes();
    const std::string whole = nearest_word(name, scenes);
    if (!whole.empty()) return whole;
    std::vector<std::string> parts;
    for (const std::string& scene : scenes)
        parts.push_back(std::filesystem::path(scene).filename().string());
    const std::string part = nearest_word(name, parts);
    const auto at = std::find(parts.begin(), parts.end(), part);
    return at == parts.end() ? "" : scenes[static_cast<std::size_t>(at - parts.begin())];
}

[[noreturn]] void refuse_name(const std::filesystem::path& name) {
    std::error_code error;
    if (std::filesystem::is_directory(name, error))
        throw InputError(name.string(), "", "a directory", "a scene");
    if (there_is(name)) {
        const char* const reason = reason_not_to_read(name);
        throw InputError(name.string(), "", reason != nullptr ? reason : "a file without extension",
                         "the name of an installed scene, or a path: ./" + name.string());
    }
    const std::string nearest = nearest_scene(name.string());
    throw InputError(name.string(), "", "no installed scene of this name",
                     (nearest.empty() ? "one of those in `quadrel list scenes`"
                                      : "\"" + nearest + "\" (see `quadrel list scenes`)") +
                         ", or a path with an extension");
}

// A glman scene keeps its extension in its installed name.
std::filesystem::path find_glib(const std::filesystem::path& file) {
    if (file.has_parent_path() || there_is(file)) return file;
    for (const auto& directory : data_directories())
        if (const auto installed = directory / "scenes" / file; there_is(installed))
            return installed;
    return file;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    const std::size_t first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

}  // namespace

std::filesystem::path find_scene(const std::filesystem::path& file_or_name) {
    if (is_glib_file(file_or_name)) return find_glib(file_or_name);
    if (!is_bare_name(file_or_name)) return file_or_name;
    const std::string name = file_or_name.string();
    for (const auto& directory : data_directories()) {
        const auto candidate = directory / "scenes" / (name + ".json");
        if (there_is(candidate)) return candidate;
    }
    refuse_name(file_or_name);
}

std::vector<std::string> installed_scenes() {
    std::vector<std::string> names;
    for (const auto& directory : data_directories()) {
        std::error_code error;
        const auto scenes = directory / "scenes";
        for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes, error)) {
            std::filesystem::path name = entry.path().lexically_relative(scenes);
            if (is_glib_file(name)) names.push_back(name.string());
            if (name.extension() == ".json") names.push_back(name.replace_extension().string());
        }
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::string leading_comment(std::string_view text, std::string_view mark) {
    std::string comment;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        if (!line.starts_with(mark)) break;
        const std::string_view words = trimmed(line.substr(mark.size()));
        if (!words.empty()) comment += (comment.empty() ? "" : " ") + std::string(words);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return comment;
}

std::string scene_description(const std::filesystem::path& file_or_name) {
    const std::filesystem::path file = find_scene(file_or_name);
    const std::string text = read_whole_file(file);
    if (!is_glib_file(file)) return leading_comment(text, "//");
    // The first line of glman's files names their kind.
    return leading_comment(
        std::string_view(text).substr(std::min(text.find('\n'), text.size() - 1) + 1), "#");
}

}  // namespace quadrel
