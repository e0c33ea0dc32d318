#include <cmath>

#include "file/file_hash.hpp"
#include "file/file_store.hpp"
#include "io/document/keys.hpp"
#include "io/scene/read.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "text/hash.hpp"

namespace quadrel {
namespace {

using Sorted = nlohmann::json;

// The hash of the hashes of the files that together make a mesh, or of its only one.
std::string mesh_hash(const std::filesystem::path& mesh) {
    const std::vector<std::filesystem::path> files = files_of_mesh(mesh);
    if (files.size() == 1) return "sha256:" + file_hash(files[0]);
    std::string hashes;
    for (const auto& file : files) hashes += file_hash(file) + "\n";
    return "sha256:" + sha256_hex(hashes);
}

// Files that nothing uses are hashed, too: the hash is of the scene as it is described, and does
// not depend on which channels a render asks for or on what the planner finds out.
class Canonical {
  public:
    Canonical(const SceneDocument& document, FileStore& images)
        : folder_(document.file.parent_path()), images_(images) {}

    Sorted section(const Json& json, std::string_view name) {
        if (!json.is_object()) return plain(json);
        Sorted out = Sorted::object();
        for (const auto& [key, member] : json.items()) {
            const SceneKey* row = find_scene_key(name, key);
            out[key] = row ? below(member, *row) : plain(member);
        }
        return out;
    }

  private:
    Sorted below(const Json& json, const SceneKey& row) {
        if (row.key == "file") return hash_of(json, row.section == "mesh");
        if (row.below == Below::object) return section(json, row.below_section);
        if (row.below == Below::value) return plain(json);
        Sorted out = json.is_array() ? Sorted::array() : Sorted::object();
        for (const auto& [name, member] : json.items()) {
            if (json.is_array() && row.key == "faces" && member.is_string())
                out.push_back(hash_of(member, false));
            else if (json.is_array())
                out.push_back(section(member, row.below_section));
            else
                out[name] = section(member, row.below_section);
        }
        return out;
    }

    Sorted hash_of(const Json& json, bool mesh) const {
        const std::filesystem::path file = folder_ / json.get<std::string>();
        return mesh ? mesh_hash(file) : "sha256:" + images_.file_hash(file);
    }

    // 2 and 2.0 mean the same.
    static Sorted plain(const Json& json) {
        if (json.is_number_float()) {
            const double value = json.get<double>();
            if (value == std::floor(value) && std::abs(value) < 9e15)
                return static_cast<std::int64_t>(value);
            return value;
        }
        if (!json.is_array()) return Sorted::parse(json.dump());
        Sorted out = Sorted::array();
        for (const Json& element : json) out.push_back(plain(element));
        return out;
    }

    std::filesystem::path folder_;
    FileStore& images_;
};

}  // namespace

std::string canonical_scene(const SceneDocument& document, FileStore& images) {
    return Canonical(document, images).section(document.root, "scene").dump();
}

}  // namespace quadrel
