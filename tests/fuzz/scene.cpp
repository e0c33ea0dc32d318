// The reader of scenes in JSON.
#include "fuzz.hpp"
#include "quadrel/scene/load.hpp"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    quadrel::fuzz::imitate_data();
    quadrel::fuzz::folder().write("scenes/triangle.obj",
                                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return quadrel::fuzz::read_as("scenes/scene.json", data, size,
                                  [](const auto& file) { quadrel::load_scene(file); });
}
