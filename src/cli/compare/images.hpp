// The two images of compare as they were read.
#pragma once

#include "quadrel/compare.hpp"

namespace quadrel::cli {

/// Both images as they are to be compared, and how they became so.
struct Images {
    ComparableImage reference, test;
    Preparation preparation;
    CompareRules rules;
};

/// "float32 uint32": how the channels of an image are stored.
std::string storage_text(const ComparableImage& image);

}  // namespace quadrel::cli
