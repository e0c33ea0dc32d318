// What a glTF file is wrapped in: nothing, or the binary container.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace quadrel {

/// Whether its name ends as those of glTF files do.
bool is_gltf_file(const std::filesystem::path& file);

/// Views into a file's bytes.
struct GltfContainer {
    std::string_view json;
    std::optional<std::string_view> binary;  ///< the BIN chunk, which may be empty
};

/// Takes a file apart (glTF 2.0, 4.4); chunks of unknown types are left out. Throws InputError,
/// with `name` as the file, for another version, chunks in another order and ends that are missing.
GltfContainer open_gltf_container(const std::string& name, std::string_view bytes);

}  // namespace quadrel
