// What is worth knowing about a file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace quadrel::cli {

using Json = nlohmann::ordered_json;

/// Describes an EXR (by its first bytes), a scene (.json, or a bare name) or any other image.
/// Throws InputError.
Json file_info(const std::string& file);

}  // namespace quadrel::cli
