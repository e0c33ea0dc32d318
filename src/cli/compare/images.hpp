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

}  // namespace quadrel::cli
