// What is worth knowing about a file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "quadrel/texture/selection.hpp"

namespace quadrel::cli {

using Json = nlohmann::ordered_json;

/// Describes an EXR (by its first bytes), a scene (.json, or a bare name) or any other image.
/// Of an EXR of several parts, unless the selection names one, an overview. Throws InputError.
Json file_info(const std::string& file, const ImageSelection& selection = {});

}  // namespace quadrel::cli
