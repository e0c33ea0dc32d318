// Files that appear whole, for the tests of what writes them.
#pragma once

#include "file/atomic_file.hpp"
#include "film/films.hpp"

namespace quadrel {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

inline void write_whole(const std::filesystem::path& file, const std::string& text) {
    AtomicFile output(file);
    output.write(text.data(), text.size());
    output.commit();
}

}  // namespace quadrel
