// A reader of our own: tinyobjloader's numbers go through libm's pow, which changes with the CPU,
// and it reads missing coordinates as 0.
#include "io/mesh_obj.hpp"

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "io/read_file.hpp"
#include "scene/triangulate.hpp"

namespace quadrel {
namespace {

constexpr std::uint32_t none = 0xffffffff;
/// Of a polygon: to cut it into triangles takes the square of their number, or worse.
constexpr std::size_t most_corners = 1024;
using Corner = std::array<std::uint32_t, 3>;  // position, uv, normal

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view blanks = " \t\r\v\f";
    std::vector<std::string_view> words;
    while (true) {
        const auto start = line.find_first_not_of(blanks);
        if (start == line.npos || line[start] == '#') return words;
        line.remove_prefix(start);
        const auto end = std::min(line.find_first_of(blanks), line.size());
        words.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
}

class ObjReader {
  public:
    ObjReader(std::string name, bool flip_v) : name_(std::move(name)), flip_v_(flip_v) {}

    void read_line(std::string_view line, int number) {
        line_ = number;
        const auto words = words_of(line);
        if (words.empty()) return;
        if (words[0] == "v") positions_.push_back(read_position(words));
        if (words[0] == "vn") normals_.push_back(read_vector(words));
        if (words[0] == "vt") uvs_.push_back(read_uv(words));
        if (words[0] == "f") read_face(words);
    }

    Mesh finish() {
        line_ = 0;
        if (mesh_.triangles.empty()) fail("no faces", "a mesh");
        if (lacks_[1]) mesh_.uvs.clear();
        if (lacks_[2]) mesh_.normals.clear();
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
        throw InputError(name_, "", found, expected, line_, line_ > 0 ? 1 : 0);
    }

    float number(std::string_view word) const {
        if (!word.empty() && word[0] == '+') word.remove_prefix(1);
        float value = 0;
        const char* end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, value);
        if (stop != end || word.empty() || (error != std::errc() && !underflows(word)) ||
            !std::isfinite(value))
            fail("\"" + std::string(word) + "\"", "a finite number");
        return value;
    }

    // from_chars calls numbers below float32's denormals out of range; they are 0.
    static bool underflows(std::string_view word) {
        double value = 0;
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        return error == std::errc() && std::abs(value) < 1;
    }

    glm::vec3 read_vector(const std::vector<std::string_view>& words) const {
        if (words.size() < 4)
            fail(std::to_string(words.size() - 1) + " numbers after " + std::string(words[0]), "3");
        return {number(words[1]), number(words[2]), number(words[3])};
    }

    // A fourth number is a weight (of rational curves), three more are a colour.
    glm::vec3 read_position(const std::vector<std::string_view>& words) const {
        return read_vector(words);
    }

    glm::vec2 read_uv(const std::vector<std::string_view>& words) const {
        if (words.size() < 2) fail("no number after vt", "u and v");
        const float v = words.size() > 2 ? number(words[2]) : 0;
        return {number(words[1]), flip_v_ ? 1 - v : v};
    }

    // Indices count from 1; negative ones backwards from the last.
    std::uint32_t index(std::string_view word, std::size_t count, const char* what) const {
        if (word.empty()) return none;
        long long value = 0;
        const char* end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, value);
        if (stop != end || error != std::errc())
            fail("\"" + std::string(word) + "\" in a face", "an index");
        const long long from_zero = value < 0 ? value + static_cast<long long>(count) : value - 1;
        if (from_zero < 0 || from_zero >= static_cast<long long>(count))
            fail(std::string(what) + " index " + std::string(word),
                 "an index of the " + std::to_string(count) + " so far");
        return static_cast<std::uint32_t>(from_zero);
    }

    Corner read_corner(std::string_view word) const {
        std::array<std::string_view, 3> parts;
        for (auto& part : parts) {
            const auto slash = std::min(word.find('/'), word.size());
            part = word.substr(0, slash);
            word.remove_prefix(std::min(slash + 1, word.size()));
        }
        if (parts[0].empty() || !word.empty()) fail("a face's corner without position", "v/vt/vn");
        return {index(parts[0], positions_.size(), "position"), index(parts[1], uvs_.size(), "uv"),
                index(parts[2], normals_.size(), "normal")};
    }

    std::uint32_t vertex(const Corner& corner) {
        const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto [found, is_new] = vertices_.try_emplace(corner, next);
        if (!is_new) return found->second;
        mesh_.positions.push_back(positions_[corner[0]]);
        mesh_.uvs.push_back(corner[1] == none ? glm::vec2(0) : uvs_[corner[1]]);
        mesh_.normals.push_back(corner[2] == none ? glm::vec3(0) : normals_[corner[2]]);
        for (std::size_t i = 1; i < 3; ++i) lacks_[i] = lacks_[i] || corner[i] == none;
        return next;
    }

    void read_face(const std::vector<std::string_view>& words) {
        if (words.size() < 4 || words.size() > most_corners + 1)
            fail("a face of " + std::to_string(words.size() - 1) + " corners",
                 "3 to " + std::to_string(most_corners));
        std::vector<std::uint32_t> corners;
        std::vector<glm::dvec3> places;
        for (std::size_t i = 1; i < words.size(); ++i) {
            corners.push_back(vertex(read_corner(words[i])));
            places.emplace_back(mesh_.positions[corners.back()]);
        }
        for (const auto& [a, b, c] : triangulate(places))
            mesh_.triangles.push_back({corners[a], corners[b], corners[c]});
    }

    std::string name_;
    bool flip_v_;
    int line_ = 0;
    std::vector<glm::vec3> positions_, normals_;
    std::vector<glm::vec2> uvs_;
    std::map<Corner, std::uint32_t> vertices_;
    std::array<bool, 3> lacks_{};
    Mesh mesh_;
};

// A backslash at its end continues a line.
std::string join_continued(std::string_view& text, int& number) {
    std::string line;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        std::string_view piece = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++number;
        if (!piece.empty() && piece.back() == '\r') piece.remove_suffix(1);
        const bool continued = !piece.empty() && piece.back() == '\\';
        if (continued) piece.remove_suffix(1);
        line += std::string(piece) + (continued ? " " : "");
        if (!continued) break;
    }
    return line;
}

}  // namespace

Mesh load_obj(const std::filesystem::path& file, bool flip_v) {
    const std::string bytes = read_whole_file(file);
    std::string_view text = bytes;
    ObjReader reader(file.string(), flip_v);
    for (int number = 0; !text.empty();) {
        const std::string line = join_continued(text, number);
        reader.read_line(line, number);
    }
    return reader.finish();
}

}  // namespace quadrel
