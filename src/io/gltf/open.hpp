// A glTF file, parsed and checked.
#pragma once

#include <filesystem>
#include <string_view>

#include "io/gltf/accessor.hpp"

namespace quadrel {

/// Reads a .gltf or .glb file with its buffers; images are left alone (images.hpp). Throws
/// InputError for whatever is no glTF 2.0, and for extensions that change what the buffers mean.
GltfFile open_gltf(const std::filesystem::path& path);

/// The object that the text is. Throws InputError, with `name` as the file.
nlohmann::json parse_gltf_json(const std::string& name, std::string_view text);

/// The files that its buffers come from, in their order.
std::vector<std::filesystem::path> gltf_buffer_files(const std::filesystem::path& path);

}  // namespace quadrel
