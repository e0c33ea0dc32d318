#include "cli/common/hints.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <filesystem>

#include "file/named_descriptor.hpp"
#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

bool has(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// That this process may run on; 0 if nobody knows.
int processors() {
    cpu_set_t set;
    return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
}

std::string extension_of(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

/// ".exr", ".json", or ".png" for every kind of picture; empty for what is none of these.
std::string kind_of(const std::string& extension) {
    const std::vector<std::string> pictures = {".png", ".jpg",  ".jpeg", ".bmp", ".tga",
                                               ".tif", ".tiff", ".hdr",  ".webp"};
    if (has(pictures, extension)) return ".png";
    return extension == ".exr" || extension == ".json" ? extension : "";
}

/// Whether the name does not say what is written: devices, pipes and standard output take
/// everything, and of folders the writer says that they are some.
bool is_no_file(const std::string& name) {
    if (name == "-" || named_descriptor(name) || std::filesystem::path(name).filename().empty())
        return true;
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(name, error);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

}  // namespace

std::optional<std::string> bitangent_hint(const std::vector<std::string>& requests) {
    if (!has(requests, "B") || has(requests, "R") || has(requests, "G")) return std::nullopt;
    if (!has(requests, "T") && !has(requests, "N")) return std::nullopt;
    return "--channels: B is blue; the bitangent is B.X,B.Y,B.Z";
}

std::optional<std::string> threads_hint(int threads) {
    const int all = processors();
    if (all == 0 || threads <= all) return std::nullopt;
    return fmt::format("-t {}: more threads than the {} processor{} that there {}", threads, all,
                       all == 1 ? "" : "s", all == 1 ? "is" : "are");
}

void check_output_kinds(const std::vector<OutputOption>& outputs) {
    for (const OutputOption& output : outputs) {
        const std::string extension = extension_of(output.file);
        if (output.file.empty() || extension == output.extension || is_no_file(output.file))
            continue;
        std::string right;
        for (const OutputOption& other : outputs)
            if (other.extension == kind_of(extension) && other.option != output.option)
                right = fmt::format("; {} is written by {}", other.extension, other.option);
        throw UsageError(fmt::format("{}: found {}, expected a name that ends in {}{}",
                                     output.option, output.file, output.extension, right));
    }
}

}  // namespace quadrel::cli
