// What `quadrel export` prints and writes without a scene: shader snippets, and the pattern that
// proves a way from a render target to a file.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>

#include "quadrel/error.hpp"

namespace quadrel::cli {

/// Of `language`, "glsl", "glsl-es", "hlsl" or "wgsl"; empty: of all, each under its file's name.
/// Throws UsageError for another one.
ExitCode print_snippets(const std::string& language);

/// An EXR with the channel `pattern`, uint32, as pattern_bits of the snippets has it; `size` as in
/// "640x480". Throws UsageError and OutputError.
ExitCode write_pattern(const std::string& size, const std::string& output);

}  // namespace quadrel::cli
