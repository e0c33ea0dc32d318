#include "cli/common/command_files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <map>

#include "file/atomic_file.hpp"
#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

constexpr const char* standard_output = "/dev/stdout";

/// Two outputs in one pipe are as mixed up as in one file.
std::optional<FileIdentity> identity_of_output(const std::filesystem::path& file) {
    if (const auto identity = identity_of(file)) return identity;
    struct stat status = {};
    if (stat(file.c_str(), &status) != 0) return std::nullopt;
    if (!S_ISFIFO(status.st_mode) && !S_ISSOCK(status.st_mode)) return std::nullopt;
    return FileIdentity{status.st_dev, status.st_ino, ""};
}

}  // namespace

std::vector<std::filesystem::path> CommandFiles::inputs() const {
    std::vector<std::filesystem::path> names;
    for (const InputFile& input : inputs_.files()) names.push_back(input.name);
    return names;
}

void CommandFiles::add_output(const std::string& option, const std::filesystem::path& file) {
    // Standard output is render's alone, which does not name it here.
    if (file == "-") throw UsageError(option + ": found -, expected the name of a file");
    if (!file.empty()) outputs_.push_back({option, file});
}

void CommandFiles::add_standard_output(const std::string& option) {
    outputs_.push_back({option, standard_output});
}

void CommandFiles::check() const {
    std::map<FileIdentity, const Output*> seen;
    for (const Output& output : outputs_) {
        const auto identity = identity_of_output(output.file);
        if (!identity) continue;
        const auto [other, is_new] = seen.emplace(*identity, &output);
        if (!is_new)
            throw UsageError(fmt::format("{} {} and {} {} are the same file, expected two",
                                         other->second->option, other->second->file.string(),
                                         output.option, output.file.string()));
        check_inputs(output, *identity);
    }
}

void CommandFiles::check_inputs(const Output& output, const FileIdentity& identity) const {
    for (const InputFile& input : inputs_.files())
        if (input.identity == identity)
            throw UsageError(fmt::format("{} {} is the input {}, expected another file",
                                         output.option, output.file.string(), input.name.string()));
}

void CommandFiles::check_writable() const {
    check();
    for (const Output& output : outputs_)
        if (output.file != standard_output) quadrel::check_writable(output.file);
}

}  // namespace quadrel::cli
