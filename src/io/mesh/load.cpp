#include <cctype>

#include "io/gltf/container.hpp"
#include "io/gltf/mesh.hpp"
#include "io/gltf/open.hpp"
#include "io/mesh/obj.hpp"
#include "quadrel/error.hpp"
#include "quadrel/scene/mesh_file.hpp"

namespace quadrel {
namespace {

std::string lower_extension(const std::filesystem::path& file) {
    std::string text = file.extension().string();
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& file) {
    return is_gltf_file(file) || lower_extension(file) == ".obj";
}

MeshFile read_mesh_file(const std::filesystem::path& file, const MeshFileOptions& options) {
    if (!is_mesh_file(file))
        throw InputError(file.string(), "", "the extension \"" + file.extension().string() + "\"",
                         ".obj, .gltf or .glb");
    MeshFile read = is_gltf_file(file) ? load_gltf(file, options) : load_obj(file, options);
    read.mesh.name = file.filename().string();
    return read;
}

Mesh load_mesh(const std::filesystem::path& file, std::optional<bool> flip_v) {
    return read_mesh_file(file, {flip_v}).mesh;
}

std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& file) {
    std::vector<std::filesystem::path> files{file};
    if (is_gltf_file(file))
        for (const auto& buffer : gltf_buffer_files(file)) files.push_back(buffer);
    return files;
}

}  // namespace quadrel
