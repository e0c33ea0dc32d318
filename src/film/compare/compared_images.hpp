// Two images on their way to a comparison: what the command line and Python do with them alike.
#pragma once

#include "film/compare/tolerances.hpp"
#include "quadrel/compare.hpp"

namespace quadrel {

/// Both images as they are to be compared, and how they became so.
struct ComparedImages {
    ComparableImage reference, test;
    Preparation preparation;
    CompareRules rules;
};

/// The last steps, of images that are cropped and renamed: matches tolerances with channels, keeps
/// `channels` alone (empty: all; `option` is what messages call them), finds which are compared by
/// value, and encodes both as the preparation says. Rules keep which pixels are left out. Throws
/// UsageError.
void prepare_comparison(std::span<const ToleranceRule> tolerances, const std::string& option,
                        const std::vector<std::string>& channels, ComparedImages& images);

}  // namespace quadrel
