// Ranges against images that are rounded before.
#pragma once

#include "quadrel/film/comparable.hpp"
#include "quadrel/film/legal.hpp"

namespace quadrel {

/// A judgement, and what was judged.
struct ImageJudgement {
    LegalReference reference;
    Film test;
    LegalReport report;
};

/// Takes the reference apart, rounds its values and the ends of its ranges, and the test image's
/// floats, to what `encoding` can hold, and judges. Throws InputError for a reference without
/// ranges, and as encode_both does.
ImageJudgement judge_images(ComparableImage reference, const ComparableImage& test,
                            const LegalRules& rules, Encoding encoding);

}  // namespace quadrel
