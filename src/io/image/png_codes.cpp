#include "io/image/png_codes.hpp"

#include <png.h>

#include <string>

#include "file/atomic_file.hpp"
#include "quadrel/check.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

void write_png_codes(const std::filesystem::path& path, int width, int height, int channels,
                     const std::vector<std::uint8_t>& codes) {
    QUADREL_CHECK_OP(==, codes.size(), static_cast<std::size_t>(width) * height * channels);
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    // In memory, because errors must not jump through libpng's C frames.
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, codes.data(), 0, nullptr) == 0)
        throw OutputError(path, image.message);
    AtomicFile file(path);
    file.write(bytes.data(), size);
    file.commit();
}

}  // namespace quadrel
