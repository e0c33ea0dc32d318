// What is legal but perhaps not what was meant.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quadrel::cli {

/// About --channels that ask for blue where the bitangent may be meant: "N,T,B".
std::optional<std::string> bitangent_hint(const std::vector<std::string>& requests);

/// About more threads than there are processors.
std::optional<std::string> threads_hint(int threads);

/// An option that writes a file, and the extension of what it writes: ".exr", ".png" or ".json".
struct OutputOption {
    std::string option, extension;
    std::string file;  ///< empty: not given
};

/// Throws UsageError where a file's name does not end as what its option writes, with the option
/// that writes that kind if there is one: -o x.png, -o x. Devices, pipes and - pass.
void check_output_kinds(const std::vector<OutputOption>& outputs);

}  // namespace quadrel::cli
