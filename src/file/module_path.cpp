#include "file/module_path.hpp"

#include <cstdlib>
#include <vector>

namespace quadrel {

namespace fs = std::filesystem;

std::optional<fs::path> find_module(const std::string& name) {
    std::vector<fs::path> directories;
    if (const char* chosen = std::getenv("QUADREL_MODULES"); chosen && *chosen)
        directories.emplace_back(chosen);
    std::error_code error;
    const fs::path executable = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        directories.push_back(executable.parent_path() / "modules");
        directories.push_back(executable.parent_path() / "../lib/quadrel");
    }
    directories.emplace_back(QUADREL_MODULE_DIR);
    directories.emplace_back(QUADREL_INSTALL_MODULE_DIR);
    for (const fs::path& directory : directories) {
        fs::path candidate = directory / (name + ".so");
        if (fs::exists(candidate, error)) return candidate;
    }
    return std::nullopt;
}

}  // namespace quadrel
