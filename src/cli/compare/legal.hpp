// compare --legal: values against the ranges that the reference holds.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "cli/compare/images.hpp"
#include "film/legal/judge_images.hpp"

namespace quadrel::cli {

struct LegalArguments {
    bool wanted = false;
    std::string widest, most_ambiguous, most_unconstrained;  ///< empty: the default
};

void add_legal_options(CLI::App& verb, LegalArguments& legal);

/// Throws UsageError for what is no share, or is given without --legal.
LegalRules legal_rules(const LegalArguments& legal);

/// Judges what was read. `channels` as given, empty for all; of `images` the rules say what is left
/// out. Throws UsageError for channels that have no range, InputError for a reference without any.
ImageJudgement judge_legal(const LegalRules& rules, Images images, const std::string& channels);

}  // namespace quadrel::cli
