// The reader of glman's scenes.
#include "fuzz.hpp"
#include "quadrel/scene/load.hpp"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    quadrel::fuzz::imitate_data();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return quadrel::fuzz::read_as("scenes/scene.glib", data, size,
                                  [](const auto& file) { quadrel::load_scene(file); });
}
