// Images that lie within glTF files.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace quadrel {

/// Whether the image, an element of the file's list, lies in the file itself. Others are files of
/// their own, or lie in a buffer that is one. `root` may be without the bytes of buffers.
bool is_within_gltf(const nlohmann::json& root, const nlohmann::json& image);

/// Such an image as it is encoded: PNG, JPEG or another. `bytes` are the file's, `part` the image's
/// name or its number from 0, a name winning; empty: the only one. Throws InputError with `file`
/// and `key`.
std::vector<unsigned char> read_gltf_image(const std::string& file, std::string_view bytes,
                                           const std::string& part, const std::string& key);

}  // namespace quadrel
