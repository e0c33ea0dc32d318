#include "file/module_path.hpp"

#include <dlfcn.h>

#include <cstdlib>

namespace quadrel {

namespace fs = std::filesystem;

namespace {

/// The shared object that has this code; empty where the executable has it.
fs::path own_shared_object() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<void*>(&own_shared_object), &info) == 0) return {};
    // Of the executable this is the name that it was started by, which may lead nowhere.
    std::error_code error;
    const fs::path file = fs::canonical(info.dli_fname, error);
    if (error || fs::equivalent(file, "/proc/self/exe", error)) return {};
    return file;
}

/// Empty where a shared object has this code.
fs::path own_executable_folder() {
    std::error_code error;
    const fs::path executable = fs::read_symlink("/proc/self/exe", error);
    return error || !own_shared_object().empty() ? fs::path() : executable.parent_path();
}

}  // namespace

std::vector<fs::path> installed_near_binary(const fs::path& inner) {
    const fs::path beside = own_executable_folder();
    if (!beside.empty()) return {beside / ".." / inner};
    std::vector<fs::path> candidates;
    for (fs::path folder = own_shared_object(); folder.has_relative_path();) {
        folder = folder.parent_path();
        candidates.push_back(folder / inner);
    }
    return candidates;
}

std::optional<fs::path> find_module(const std::string& name) {
    std::vector<fs::path> directories;
    if (const char* chosen = std::getenv("QUADREL_MODULES"); chosen && *chosen)
        directories.emplace_back(chosen);
    if (const fs::path folder = own_executable_folder(); !folder.empty())
        directories.push_back(folder / "modules");
    for (const fs::path& installed : installed_near_binary("lib/quadrel"))
        directories.push_back(installed);
    directories.emplace_back(QUADREL_MODULE_DIR);
    directories.emplace_back(QUADREL_INSTALL_MODULE_DIR);
    std::error_code error;
    for (const fs::path& directory : directories) {
        fs::path candidate = directory / (name + ".so");
        if (fs::exists(candidate, error)) return candidate;
    }
    return std::nullopt;
}

}  // namespace quadrel
