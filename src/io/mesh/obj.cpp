// A reader of our own: tinyobjloader's numbers go through libm's pow, which changes with the CPU,
// and it reads missing coordinates as 0.
#include "io/mesh/obj.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include "file/read_file.hpp"
#include "io/mesh/obj_statements.hpp"
#include "scene/mesh_corners.hpp"
#include "scene/triangulate.hpp"

namespace quadrel {
namespace {

constexpr std::uint32_t none = 0xffffffff;
/// Of a polygon: to cut it into triangles takes the square of their number, or worse.
constexpr std::size_t most_corners = 1024;
using Corner = std::array<std::uint32_t, 3>;  // position, uv, normal
using Words = std::vector<std::string_view>;

/// Numbers in the text of a file; errors name the line.
class ObjNumbers {
  public:
    explicit ObjNumbers(std::string name) : name_(std::move(name)) {}

    void set_line(int line) { line_ = line; }

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

    glm::vec3 vector(const Words& words) const {
        if (words.size() < 4)
            fail(std::to_string(words.size() - 1) + " numbers after " + std::string(words[0]), "3");
        return {number(words[1]), number(words[2]), number(words[3])};
    }

    // From 1; negative ones backwards from the last of `count` so far. Others may come later.
    std::uint32_t index(std::string_view word, std::size_t count, const char* what) const {
        if (word.empty()) return none;
        long long value = 0;
        const char* end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, value);
        if (stop != end || error != std::errc())
            fail("\"" + std::string(word) + "\" in a face", "an index");
        const long long from_zero = value < 0 ? value + static_cast<long long>(count) : value - 1;
        if (from_zero < 0 || from_zero >= none)
            fail_index(what, std::string(word), std::to_string(count) + " so far");
        return static_cast<std::uint32_t>(from_zero);
    }

    [[noreturn]] void fail_index(const char* what, const std::string& index,
                                 const std::string& count) const {
        fail(std::string(what) + " index " + index, "an index of the " + count);
    }

  private:
    // from_chars calls numbers below float32's denormals out of range; they are 0.
    static bool underflows(std::string_view word) {
        double value = 0;
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        return error == std::errc() && std::abs(value) < 1;
    }

    std::string name_;
    int line_ = 0;
};

class ObjReader {
  public:
    ObjReader(std::string name, bool flip_v) : numbers_(std::move(name)), flip_v_(flip_v) {}

    void read(const Words& words, int line) {
        numbers_.set_line(line);
        const std::string_view what = words[0];
        // A fourth number is a weight (of rational curves), three more are a colour.
        if (what == "v") return positions_.push_back(numbers_.vector(words));
        if (what == "vn") return normals_.push_back(numbers_.vector(words));
        if (what == "vt") return read_uv(words);
        if (what == "f") return read_face(words, line);
        if (what == "s") smooth_ = words.size() > 1 && words[1] != "off" && words[1] != "0";
        const bool only_names = what == "g" || what == "o" || what == "s";
        if (!only_names) ignore(what);
    }

    MeshFile finish() {
        for (std::size_t i = 0; i < faces_.size(); ++i)
            add_face(faces_[i], i + 1 < faces_.size() ? faces_[i + 1].first : corners_.size());
        numbers_.set_line(0);
        if (mesh_.triangles.empty()) numbers_.fail("no faces", "a mesh");
        if (!any_uv_) mesh_.uvs.clear();
        settle_normals(mesh_);
        return {std::move(mesh_), uvs_.empty() ? 0 : 1, {}, std::move(ignored_)};
    }

  private:
    struct Face {
        std::size_t first;  ///< of its corners
        int line;
        bool smooth;
    };

    void read_uv(const Words& words) {
        if (words.size() < 2) numbers_.fail("no number after vt", "u and v");
        const float v = words.size() > 2 ? numbers_.number(words[2]) : 0;
        uvs_.emplace_back(numbers_.number(words[1]), flip_v_ ? 1 - v : v);
    }

    Corner read_corner(std::string_view word) const {
        std::array<std::string_view, 3> parts;
        for (auto& part : parts) {
            const auto slash = std::min(word.find('/'), word.size());
            part = word.substr(0, slash);
            word.remove_prefix(std::min(slash + 1, word.size()));
        }
        if (parts[0].empty() || !word.empty())
            numbers_.fail("a face's corner without position", "v/vt/vn");
        return {numbers_.index(parts[0], positions_.size(), "position"),
                numbers_.index(parts[1], uvs_.size(), "uv"),
                numbers_.index(parts[2], normals_.size(), "normal")};
    }

    void read_face(const Words& words, int line) {
        if (words.size() < 4 || words.size() > most_corners + 1)
            numbers_.fail("a face of " + std::to_string(words.size() - 1) + " corners",
                          "3 to " + std::to_string(most_corners));
        faces_.push_back({corners_.size(), line, smooth_});
        for (std::size_t i = 1; i < words.size(); ++i) corners_.push_back(read_corner(words[i]));
    }

    void check(const Corner& corner) const {
        const std::size_t counts[] = {positions_.size(), uvs_.size(), normals_.size()};
        constexpr const char* names[] = {"position", "uv", "normal"};
        for (std::size_t i = 0; i < 3; ++i)
            if (corner[i] != none && corner[i] >= counts[i])
                numbers_.fail_index(names[i], std::to_string(corner[i] + std::uint64_t(1)),
                                    std::to_string(counts[i]));
    }

    // What one corner lacks, the face does without.
    void add_face(const Face& face, std::size_t end) {
        numbers_.set_line(face.line);
        bool has_uv = true, has_normal = true;
        for (std::size_t i = face.first; i < end; ++i) {
            check(corners_[i]);
            has_uv = has_uv && corners_[i][1] != none;
            has_normal = has_normal && corners_[i][2] != none;
        }
        any_uv_ = any_uv_ || has_uv;
        if (face.smooth && !has_normal) ignore("s");
        std::vector<std::uint32_t> vertices;
        std::vector<glm::dvec3> places;
        for (std::size_t i = face.first; i < end; ++i) {
            const auto [position, uv, normal] = corners_[i];
            vertices.push_back(vertex({position, has_uv ? uv : none, has_normal ? normal : none}));
            places.emplace_back(positions_[position]);
        }
        for (const auto& [a, b, c] : triangulate(places))
            mesh_.triangles.push_back({vertices[a], vertices[b], vertices[c]});
    }

    std::uint32_t vertex(const Corner& corner) {
        const auto next = static_cast<std::uint32_t>(mesh_.positions.size());
        const auto [found, is_new] = vertices_.try_emplace(corner, next);
        if (!is_new) return found->second;
        mesh_.positions.push_back(positions_[corner[0]]);
        mesh_.uvs.push_back(corner[1] == none ? glm::vec2(0) : uvs_[corner[1]]);
        mesh_.normals.push_back(corner[2] == none ? glm::vec3(0) : normals_[corner[2]]);
        return next;
    }

    // A file that is none of OBJ would bring a thousand.
    void ignore(std::string_view statement) {
        constexpr std::size_t most = 16;
        if (ignored_.size() > most) return;
        std::string name(statement);
        for (char& c : name)  // it need not be text
            if (c <= ' ' || c > '~') c = '?';
        if (std::find(ignored_.begin(), ignored_.end(), name) != ignored_.end()) return;
        ignored_.push_back(ignored_.size() < most ? name : "others");
    }

    ObjNumbers numbers_;
    bool flip_v_, smooth_ = false, any_uv_ = false;
    std::vector<glm::vec3> positions_, normals_;
    std::vector<glm::vec2> uvs_;
    std::vector<Corner> corners_;  ///< of all faces
    std::vector<Face> faces_;
    std::map<Corner, std::uint32_t> vertices_;
    std::vector<std::string> ignored_;
    Mesh mesh_;
};

}  // namespace

MeshFile load_obj(const std::filesystem::path& file, const MeshFileOptions& options) {
    const std::string bytes = read_whole_file(file);
    if (options.uv_set != 0)
        throw InputError(file.string(), "", "uv_set " + std::to_string(options.uv_set),
                         "0: OBJ has one set of texture coordinates");
    if (options.material)
        throw InputError(file.string(), "", "a material to be chosen",
                         "none of an OBJ file: of glTF alone they are read");
    ObjReader reader(file.string(), options.flip_v.value_or(true));
    ObjStatements statements(bytes);
    while (statements.next()) reader.read(statements.words(), statements.line());
    return reader.finish();
}

}  // namespace quadrel
