// The reader of EXR files as textures.
#include "fuzz.hpp"
#include "quadrel/texture/image.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // Anything else would go to the reader of other formats, which is a module.
    if (size < 4 || std::string(data, data + 4) != "\x76\x2f\x31\x01") return -1;
    return quadrel::fuzz::read_as("image.exr", data, size, [](const auto& file) {
        quadrel::load_image(file, quadrel::NotFinite::refuse, "", {"", "0"});
    });
}
