#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <half.h>

#include <cmath>

#include "colour.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

double round_to(double value, double codes) { return std::floor(saturate(value) * codes + 0.5); }

template <class Texel>
constexpr Imf::PixelType pixel_type = Imf::FLOAT;
template <>
constexpr Imf::PixelType pixel_type<half> = Imf::HALF;

/// Interleaved values as an EXR whose channels are the letters of `names`.
template <class T>
void write_exr(const std::filesystem::path& file, int width, int height, const char* names,
               const std::vector<T>& values) {
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    const std::size_t channels = std::char_traits<char>::length(names);
    const std::size_t stride = channels * sizeof(T);
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels; ++c) {
        const char name[2] = {names[c], 0};
        header.channels().insert(name, Imf::Channel(pixel_type<T>));
        char* base = const_cast<char*>(reinterpret_cast<const char*>(values.data() + c));
        buffer.insert(name, Imf::Slice(pixel_type<T>, base, stride, stride * width));
    }
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(height);
}

/// The grid's texels flattened by `convert(texel, values)`, which appends `values`.
template <class T, class Texel, class Convert>
std::vector<T> flatten(const Grid<Texel>& grid, Convert convert) {
    std::vector<T> values;
    for (const Texel& texel : grid.values) convert(texel, values);
    return values;
}

half srgb8(double linear) { return half(static_cast<float>(linear_of_code(srgb_code(linear)))); }
half unorm8(double value) { return half(static_cast<float>(round_to(value, 255) / 255)); }
float unorm16(double value) { return static_cast<float>(round_to(value, 65535)) / 65535.0f; }

}  // namespace

void write_height(const std::filesystem::path& file, const Grid<double>& height) {
    write_exr(file, height.width, height.height, "Y",
              flatten<float>(height, [](double h, auto& out) { out.push_back(unorm16(h)); }));
}

void write_colour(const std::filesystem::path& file, const Grid<glm::dvec4>& colour) {
    const auto convert = [](const glm::dvec4& c, std::vector<half>& out) {
        for (int i = 0; i < 3; ++i) out.push_back(srgb8(c[i]));
        out.push_back(unorm8(c.a));
    };
    write_exr(file, colour.width, colour.height, "RGBA", flatten<half>(colour, convert));
}

void write_data(const std::filesystem::path& file, const Grid<glm::dvec3>& data) {
    const auto convert = [](const glm::dvec3& d, std::vector<half>& out) {
        for (int i = 0; i < 3; ++i) out.push_back(unorm8(d[i]));
    };
    write_exr(file, data.width, data.height, "RGB", flatten<half>(data, convert));
}

void write_radiance(const std::filesystem::path& file, const Grid<glm::dvec3>& radiance) {
    const auto convert = [](const glm::dvec3& r, std::vector<half>& out) {
        for (int i = 0; i < 3; ++i) out.push_back(half(static_cast<float>(r[i])));
    };
    write_exr(file, radiance.width, radiance.height, "RGB", flatten<half>(radiance, convert));
}

void write_normal_height(const std::filesystem::path& file, const Grid<glm::dvec4>& texels) {
    const auto convert = [](const glm::dvec4& t, std::vector<float>& out) {
        for (int i = 0; i < 3; ++i) out.push_back(static_cast<float>(round_to(t[i], 255)) / 255.0f);
        out.push_back(unorm16(t.a));
    };
    write_exr(file, texels.width, texels.height, "RGBA", flatten<float>(texels, convert));
}

void write_depths(const std::filesystem::path& file, int channels, const Grid<glm::dvec4>& depths) {
    const auto convert = [channels](const glm::dvec4& d, std::vector<float>& out) {
        for (int i = 0; i < channels; ++i) out.push_back(unorm16(d[i]));
    };
    write_exr(file, depths.width, depths.height, channels == 2 ? "RG" : "RGBA",
              flatten<float>(depths, convert));
}

}  // namespace quadrel::textures
