// The reader of Wavefront OBJ meshes.
#include "fuzz.hpp"
#include "quadrel/scene/mesh_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return quadrel::fuzz::read_as("mesh.obj", data, size,
                                  [](const auto& file) { quadrel::load_mesh(file); });
}
