// Files for the tests of baked maps.
#pragma once

#include <cstring>
#include <fstream>
#include <iterator>

#include "bake/support.hpp"
#include "film/films.hpp"

namespace quadrel::test {

using testing_films::TemporaryFolder;

inline std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

/// Same layout, same bits.
inline bool same_texels(const Texture& a, const Texture& b) {
    const TextureView &x = a.view(), &y = b.view();
    if (x.levels != y.levels || x.faces != y.faces || x.channels != y.channels) return false;
    for (int level = 0; level < x.levels; ++level) {
        if (x.width[level] != y.width[level] || x.height[level] != y.height[level]) return false;
        const std::size_t floats =
            std::size_t(x.width[level]) * x.height[level] * x.channels * x.faces;
        if (std::memcmp(a.level_texels(level, 0), b.level_texels(level, 0), floats * 4) != 0)
            return false;
    }
    return true;
}

}  // namespace quadrel::test
