#include <png.h>

#include <string>

#include "file/atomic_file.hpp"
#include "io/image/png_encode.hpp"
#include "quadrel/check.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

std::string encode_png(const std::filesystem::path& file, const Picture& picture) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) ==
        0)
        throw OutputError(file, image.message);
    bytes.resize(size);
    return bytes;
}

void write_png(const std::filesystem::path& path, const Picture& picture) {
    QUADREL_CHECK(picture.width > 0 && picture.height > 0, picture.width);
    const std::string bytes = encode_png(path, picture);
    AtomicFile file(path);
    file.write(bytes.data(), bytes.size());
    file.commit();
}

}  // namespace quadrel
