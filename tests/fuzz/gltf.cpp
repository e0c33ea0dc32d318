// The reader of glTF meshes, as text and as binary: the content says which.
#include "fuzz.hpp"
#include "quadrel/scene/mesh_file.hpp"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    quadrel::fuzz::folder().write("square.bin", std::string(256, '\0'));
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return quadrel::fuzz::read_as("mesh.gltf", data, size, [](const auto& file) {
        quadrel::load_mesh(file);
        quadrel::files_of_mesh(file);
    });
}
