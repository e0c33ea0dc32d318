// The reader of EXR files as films, for comparisons.
#include "fuzz.hpp"
#include "quadrel/film/exr.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return quadrel::fuzz::read_as("film.exr", data, size, [](const auto& file) {
        quadrel::read_exr(file, {"", "0"});
    });
}
