// EXR files of several parts, whose sizes may differ.
#pragma once

#include "quadrel/film/exr.hpp"

namespace quadrel {

struct ExrPart {
    std::string name;  ///< of its own in the file
    Film film;
    Attributes attributes;
};

/// Writes the parts whole or not at all; a single part as a plain file, without a name. NaNs become
/// canonical_nan. Throws OutputError.
void write_exr_parts(const std::filesystem::path& file, const std::vector<ExrPart>& parts,
                     const ExrWriting& writing = {});

}  // namespace quadrel
