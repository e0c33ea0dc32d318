#include "file/data_path.hpp"

#include <cstdlib>

#include "quadrel/error.hpp"

namespace quadrel {

namespace fs = std::filesystem;

std::vector<fs::path> data_directories() {
    std::vector<fs::path> candidates;
    if (const char* chosen = std::getenv("QUADREL_DATA"); chosen && *chosen)
        candidates.emplace_back(chosen);
    std::error_code error;
    const fs::path executable = fs::read_symlink("/proc/self/exe", error);
    if (!error) candidates.push_back(executable.parent_path() / "../share/quadrel");
    candidates.emplace_back(QUADREL_SOURCE_DATA_DIR);
    std::erase_if(candidates, [&](const fs::path& path) { return !fs::is_directory(path, error); });
    return candidates;
}

fs::path find_data_file(const fs::path& relative) {
    std::string searched;
    std::error_code error;
    for (const fs::path& directory : data_directories()) {
        if (fs::exists(directory / relative, error)) return directory / relative;
        searched += (searched.empty() ? "" : ", ") + directory.string();
    }
    throw InputError(
        relative.string(), "", "no such data file",
        searched.empty() ? "QUADREL_DATA to name the data directory" : "it in one of " + searched);
}

}  // namespace quadrel
