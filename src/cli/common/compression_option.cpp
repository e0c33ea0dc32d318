#include "cli/common/compression_option.hpp"

#include <CLI/CLI.hpp>

#include "text/suggest.hpp"

namespace quadrel::cli {
namespace {

ExrCompression compression_from(const std::string& name) {
    std::vector<std::string_view> known;
    for (const auto& [known_name, compression] : exr_compressions) {
        if (known_name == name) return compression;
        known.push_back(known_name);
    }
    throw CLI::ValidationError("--compression",
                               "found \"" + name + "\", expected " + one_of(name, known));
}

}  // namespace

void add_compression_option(CLI::App& verb, ExrCompression& compression) {
    verb.add_option_function<std::string>(
            "--compression",
            [&compression](const std::string& name) { compression = compression_from(name); },
            "of the EXR: none, rle, zips, zip or piz; the pixels are the same")
        ->default_str("zip");
}

}  // namespace quadrel::cli
