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

/// The file that a uri names; nothing for data in the uri itself.
std::optional<std::filesystem::path> gltf_uri_path(const std::string& uri,
                                                   const std::filesystem::path& folder);

/// The files that they come from, in their order.
std::vector<std::filesystem::path> gltf_buffer_paths(const nlohmann::json& json,
                                                     const std::filesystem::path& folder);

}  // namespace quadrel
