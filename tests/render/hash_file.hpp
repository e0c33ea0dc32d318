// The committed hashes: one line per scene, "name WIDTHxHEIGHT default all", the hashes (film_hash,
// first 16 digits) of the default channels and of all channels.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel::render_tests {

struct SceneHash {
    std::string scene, size;  ///< size as "24x18"
    std::string of_default, of_all;
    bool operator==(const SceneHash&) const = default;
};

inline std::filesystem::path hash_file() {
    return std::filesystem::path(QUADREL_DATA_DIR).parent_path() /
           "tests/render/expected_hashes.txt";
}

inline std::vector<SceneHash> read_hashes(const std::filesystem::path& file) {
    std::vector<SceneHash> hashes;
    std::ifstream in(file);
    SceneHash line;
    while (in >> line.scene >> line.size >> line.of_default >> line.of_all) hashes.push_back(line);
    return hashes;
}

inline void write_hashes(const std::filesystem::path& file, const std::vector<SceneHash>& hashes) {
    std::ofstream out(file);
    for (const SceneHash& line : hashes)
        out << line.scene << " " << line.size << " " << line.of_default << " " << line.of_all
            << "\n";
}

inline std::string short_hash(const Film& film) { return film_hash(film).substr(0, 16); }

/// Relief is slow in an unoptimised build, so its pictures are small.
inline std::string hash_size(const Scene& scene) {
    for (const Material& material : scene.materials)
        if (material.textures.count("height") + material.textures.count("layers") > 0)
            return "24x18";
    return "40x30";
}

/// The override that gives a scene this size.
inline std::string size_override(const std::string& size) {
    const std::size_t x = size.find('x');
    return "size=[" + size.substr(0, x) + "," + size.substr(x + 1) + "]";
}

}  // namespace quadrel::render_tests
