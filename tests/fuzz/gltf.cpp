// The reader of glTF meshes, their materials and the images within them, as text and as binary: the
// content says which.
#include <string_view>

#include "fuzz.hpp"
#include "io/gltf/material/images.hpp"
#include "io/gltf/material/materials.hpp"
#include "quadrel/scene/mesh_file.hpp"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    quadrel::fuzz::folder().write("square.bin", std::string(256, '\0'));
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    return quadrel::fuzz::read_as("mesh.gltf", data, size, [&](const auto& file) {
        try {
            quadrel::read_gltf_image(file.string(), bytes, "0", "material.color");
        } catch (const quadrel::InputError&) {  // meshes without images are read as well
        }
        quadrel::load_mesh(file);
        quadrel::files_of_mesh(file);
        quadrel::read_gltf_materials(file, {});
    });
}
