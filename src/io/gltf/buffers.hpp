// The bytes that a glTF file's buffers hold.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "io/gltf/accessor.hpp"

namespace quadrel {

/// Fills the model's buffers, as `json` (checked) describes them: from data URIs, from files beside
/// `folder`, or, the first one, from the container's binary chunk. Throws InputError.
void load_gltf_buffers(GltfFile& file, const nlohmann::json& json,
                       const std::filesystem::path& folder, std::optional<std::string_view> binary);

/// Whether the uri holds the bytes itself.
bool is_gltf_data(const std::string& uri);

/// The bytes of such a uri, of whatever type it says; empty where they are no base64.
std::vector<unsigned char> gltf_data(const std::string& uri);

/// The file that a uri names; nothing for data in the uri itself.
std::optional<std::filesystem::path> gltf_uri_path(const std::string& uri,
                                                   const std::filesystem::path& folder);

/// The files that they come from, in their order.
std::vector<std::filesystem::path> gltf_buffer_paths(const nlohmann::json& json,
                                                     const std::filesystem::path& folder);

}  // namespace quadrel
