// What `quadrel export` prints and writes without a scene: shader snippets, and the pattern that
// proves a way from a render target to a file.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "quadrel/error.hpp"

namespace quadrel::cli {

struct SnippetArguments {
    bool snippets = false;  ///< --snippets
    std::string pattern;    ///< --pattern: a size as in "640x480"

    bool given() const { return snippets || !pattern.empty(); }
};

void add_snippet_options(CLI::App& verb, SnippetArguments& arguments);

/// Prints the snippets of `language`, "glsl", "glsl-es", "hlsl" or "wgsl", or of all, each under
/// its file's name, if that is empty; or writes the pattern to `output`, an EXR with the channel
/// `pattern`, uint32, as pattern_bits of the snippets has it. Throws UsageError and OutputError.
ExitCode run_snippets(const SnippetArguments& arguments, const std::string& language,
                      const std::string& output);

}  // namespace quadrel::cli
