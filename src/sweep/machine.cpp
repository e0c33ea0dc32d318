#include "sweep/machine.hpp"

#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <map>

#include "file/file_hash.hpp"
#include "file/module_path.hpp"

namespace quadrel::sweep {
namespace {

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    std::map<std::string, std::string> first;
    for (std::string line; std::getline(info, line) && !line.empty();) {
        const auto colon = line.find(':');
        if (colon == std::string::npos) continue;
        const std::string key = line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1);
        first[key] = line.substr(std::min(line.size(), colon + 2));
    }
    std::string name = first["model name"].empty() ? "unknown processor" : first["model name"];
    // Virtual machines often give no more of a name than the maker's.
    if (!first["cpu family"].empty() && name.find_first_of("0123456789") == std::string::npos)
        name += " family " + first["cpu family"] + " model " + first["model"];
    return name;
}

std::string host_name() {
    char name[256] = {};
    return gethostname(name, sizeof name - 1) == 0 ? name : "unknown host";
}

int processors_allowed() {
    cpu_set_t set;
    CPU_ZERO(&set);
    return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

/// The first digits of a file's hash; none where it cannot be read.
std::string short_hash(const std::filesystem::path& file) {
    try {
        return file_hash(file).substr(0, 12);
    } catch (const std::exception&) {
        return "unknown";
    }
}

/// The program and kernels that run, whatever lies at their names by now.
std::string build_of(const std::string& version, const std::string& isa) {
    static const std::string program = short_hash("/proc/self/exe");
    static std::map<std::string, std::string> modules;
    const auto [known, is_new] = modules.try_emplace(isa);
    if (const auto module = find_module("quadrel-kernels-" + isa); is_new && module)
        known->second = " " + short_hash(*module);
    return version + " " + program + known->second;
}

}  // namespace

Machine this_machine(const std::string& version, const std::string& isa) {
    double load = 0;
    getloadavg(&load, 1);
    return {processor_name(), host_name(), processors_allowed(), build_of(version, isa), load};
}

}  // namespace quadrel::sweep
