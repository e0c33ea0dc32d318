#include "file/data_path.hpp"

#include <cstdlib>

#include "file/module_path.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

namespace fs = std::filesystem;

std::vector<fs::path> data_directories() {
    std::vector<fs::path> candidates;
    if (const char* chosen = std::getenv("QUADREL_DATA"); chosen && *chosen)
        candidates.emplace_back(chosen);
    for (const fs::path& installed : installed_near_binary("share/quadrel"))
        candidates.push_back(installed);
    candidates.emplace_back(QUADREL_SOURCE_DATA_DIR);
    std::error_code error;
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
