#include "texture/stored_image.hpp"

#include <Imath/half.h>

#include <cstring>

namespace quadrel {
namespace {

template <class Stored, class Decode>
void decode_as(const unsigned char* bytes, std::size_t step, std::size_t count, float* out,
               const Decode& decode_one) {
    for (std::size_t i = 0; i < count; ++i) {
        Stored stored;
        std::memcpy(&stored, bytes + i * step * sizeof stored, sizeof stored);
        out[i] = decode_one(stored);
    }
}

}  // namespace

std::size_t value_size(QuadrelOiioType type) {
    static constexpr std::size_t sizes[] = {1, 2, 4, 2, 4, 8};
    return sizes[type];
}

TexelFormat StoredImage::format() const {
    switch (info_.type) {
        case quadrel_oiio_uint8:
            return TexelFormat::unorm8;
        case quadrel_oiio_uint16:
            return TexelFormat::unorm16;
        case quadrel_oiio_half:
            return TexelFormat::half;
        default:
            return TexelFormat::float32;
    }
}

/// Divisions, not products with a reciprocal: these give the nearest float.
void StoredImage::decode(std::size_t first, std::size_t step, std::size_t count, float* out) const {
    const unsigned char* const bytes = pixels_.data() + first * value_size(info_.type);
    switch (info_.type) {
        case quadrel_oiio_uint8:
            return decode_as<std::uint8_t>(bytes, step, count, out,
                                           [](std::uint8_t c) { return float(c) / 255.0f; });
        case quadrel_oiio_uint16:
            return decode_as<std::uint16_t>(bytes, step, count, out,
                                            [](std::uint16_t c) { return float(c) / 65535.0f; });
        case quadrel_oiio_uint32:
            return decode_as<std::uint32_t>(bytes, step, count, out, [](std::uint32_t c) {
                return static_cast<float>(c / 4294967295.0);
            });
        case quadrel_oiio_half:
            return decode_as<half>(bytes, step, count, out, [](half h) { return float(h); });
        case quadrel_oiio_float:
            return decode_as<float>(bytes, step, count, out, [](float x) { return x; });
        case quadrel_oiio_double:
            return decode_as<double>(bytes, step, count, out,
                                     [](double x) { return static_cast<float>(x); });
    }
}

Image StoredImage::decoded() const {
    Image image;
    image.width = info_.width;
    image.height = info_.height;
    image.channels = info_.channels;
    image.luminance = is_luminance();
    image.format = format();
    image.values.resize(pixels_.size() / value_size(info_.type));
    decode(0, 1, image.values.size(), image.values.data());
    return image;
}

}  // namespace quadrel
