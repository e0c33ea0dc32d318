// compare --decode: one side is an image that carries values' bits as codes.
#pragma once

#include <string>
#include <vector>

#include "cli/compare/images.hpp"

namespace quadrel::cli {

/// Makes the image that carries bits the test image, and of its codes the channels that `decode`
/// names; the reference keeps only these, with `ranges` their gpu.* channels, too. The carrier is
/// the test, or where that is none, and the reference is an image of 8 or 16 bits, the reference:
/// then they are exchanged. Throws UsageError and InputError.
void decode_test(const std::vector<std::string>& decode, bool ranges, Images& images);

/// "hit.U: bits of shot.png".
std::vector<std::string> decoded_channels(const std::vector<std::string>& decode,
                                          const std::string& test_file);

}  // namespace quadrel::cli
