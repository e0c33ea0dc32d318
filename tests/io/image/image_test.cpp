// Reading image files: exact values, every layout, and no success on half a file.
#include "quadrel/texture/image.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "quadrel/error.hpp"
#include "quadrel/texture/texture_cache.hpp"
#include "texture/files.hpp"
#include "texture/planted.hpp"
#include "texture/support.hpp"

namespace quadrel::test {
namespace {

namespace fs = std::filesystem;

/// A directory of its own, removed afterwards.
class Images : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "quadrel-images-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        directory_ = name;
    }
    void TearDown() override { fs::remove_all(directory_); }

    fs::path write(const std::string& name, const Bytes& bytes) {
        std::ofstream(directory_ / name, std::ios::binary) << bytes;
        return directory_ / name;
    }
    static Bytes read(const fs::path& file) {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    fs::path directory_;
};

std::vector<float> divided(const std::vector<int>& codes, float max) {
    std::vector<float> values;
    for (const int code : codes) values.push_back(static_cast<float>(code) / max);
    return values;
}

Bytes all_codes() {
    Bytes codes;
    for (int i = 0; i < 256; ++i) codes.push_back(static_cast<char>(i));
    return codes;
}

// ---- Formats other than EXR ---------------------------------------------------------------------

TEST_F(Images, EveryCodeOfAPng) {
    const Image image =
        load_image(write("a.png", make_png(16, 16, 8, PngColour::grey, all_codes())));
    EXPECT_EQ(image.width, 16);
    EXPECT_EQ(image.height, 16);
    EXPECT_EQ(image.channels, 1);
    EXPECT_TRUE(image.luminance);
    EXPECT_EQ(image.format, TexelFormat::unorm8);
    for (int i = 0; i < 256; ++i) EXPECT_EQ(image.values[i], static_cast<float>(i) / 255.0f);
}

TEST_F(Images, HeightsInAlphaDoNotTouchColours) {
    const Bytes pixels("\xc8\x64\x32\x00\xff\x80\x01\x03", 8);
    const Image image = load_image(write("a.png", make_png(2, 1, 8, PngColour::rgba, pixels)));
    EXPECT_EQ(image.values, divided({200, 100, 50, 0, 255, 128, 1, 3}, 255));
    EXPECT_FALSE(image.luminance);
}

TEST_F(Images, SixteenBitPng) {
    const Bytes pixels("\x00\x01\x80\x00\xff\xff\x12\x34", 8);
    const Image image = load_image(write("a.png", make_png(2, 2, 16, PngColour::grey, pixels)));
    EXPECT_EQ(image.format, TexelFormat::unorm16);
    EXPECT_EQ(image.values, divided({1, 32768, 65535, 0x1234}, 65535));
}

TEST_F(Images, PaletteAndGreyAlphaAndSmallDepths) {
    const Bytes palette("\x0a\x14\x1e\xc8\xd2\xdc", 6);
    const Image rgb = load_image(
        write("p.png", make_png(2, 1, 8, PngColour::palette, "\x01" + Bytes(1, 0), palette)));
    EXPECT_EQ(rgb.channels, 3);
    EXPECT_EQ(rgb.values, divided({200, 210, 220, 10, 20, 30}, 255));
    const Image grey_alpha = load_image(
        write("g.png", make_png(1, 2, 8, PngColour::grey_alpha, Bytes("\xc8\x00\x64\x80", 4))));
    EXPECT_TRUE(grey_alpha.luminance);
    EXPECT_EQ(grey_alpha.values, divided({200, 0, 100, 128}, 255));
    const Image two_bits =
        load_image(write("t.png", make_png(4, 1, 2, PngColour::grey, Bytes(1, '\x1b'))));
    EXPECT_EQ(two_bits.values, divided({0, 1, 2, 3}, 3));
}

TEST_F(Images, TiffAndRadiance) {
    const Image tiff = load_image(write("a.tif", make_tiff(16, 16, all_codes())));
    for (int i = 0; i < 256; ++i) EXPECT_EQ(tiff.values[i], static_cast<float>(i) / 255.0f);
    const Bytes header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    const Image hdr =
        load_image(write("a.hdr", header + Bytes("\x80\x40\x00\x81\x80\x80\x80\x82", 8)));
    EXPECT_EQ(hdr.format, TexelFormat::float32);
    EXPECT_EQ(hdr.channels, 3);
    EXPECT_NEAR(hdr.values[0], 1, 0.01);
    EXPECT_NEAR(hdr.values[1], 0.5, 0.01);
    EXPECT_NEAR(hdr.values[3], 2, 0.02);
}

using Loader = std::function<void(const fs::path&)>;

/// Each file loads whole, and is an InputError at any cut.
testing::AssertionResult refuses_parts(const Loader& load, const fs::path& part, const Bytes& whole,
                                       std::size_t step) {
    for (std::size_t length = 0; length < whole.size(); length += step) {
        std::ofstream(part, std::ios::binary) << whole.substr(0, length);
        try {
            load(part);
            return testing::AssertionFailure() << length << " of " << whole.size() << " bytes load";
        } catch (const InputError& error) {
            if (error.file != part) return testing::AssertionFailure() << error.what();
        }
    }
    std::ofstream(part, std::ios::binary) << whole;
    load(part);
    return testing::AssertionSuccess();
}

void load_any(const fs::path& file) { load_image(file, NotFinite::refuse, "material.height"); }

TEST_F(Images, PartsOfFilesAreErrors) {
    const Bytes jpeg(reinterpret_cast<const char*>(noise_jpeg), sizeof noise_jpeg);
    Bytes noise;
    std::mt19937 random(1);
    for (int i = 0; i < 64 * 64; ++i) noise.push_back(static_cast<char>(random()));
    const Bytes png = make_png(64, 64, 8, PngColour::grey, noise);
    EXPECT_TRUE(refuses_parts(load_any, directory_ / "a.tif", make_tiff(64, 64, noise), 511));
    // The last bytes of a PNG and a JPEG are end markers: cut at steps that stay before them.
    EXPECT_TRUE(refuses_parts(load_any, directory_ / "a.png", png, png.size() / 9 - 3));
    EXPECT_TRUE(refuses_parts(load_any, directory_ / "a.jpg", jpeg, jpeg.size() / 9 - 3));
    EXPECT_FALSE(refuses_parts(  // Planted::error_swallowed
        [](const fs::path& file) {
            if (fs::file_size(file) < 1000) load_any(file);
        },
        directory_ / "b.tif", make_tiff(64, 64, noise), 511));
}

TEST_F(Images, WhatIsNotAnImage) {
    for (const auto& file :
         {directory_ / "missing.png", directory_, write("empty.png", ""),
          write("text.png", "not an image at all"), write("text.exr", "not an image at all")}) {
        try {
            load_any(file);
            ADD_FAILURE() << file;
        } catch (const InputError& error) {
            EXPECT_EQ(error.file, file);
            EXPECT_EQ(error.key, "material.height");
            EXPECT_FALSE(error.found.empty());
        }
    }
}

// ---- EXR ----------------------------------------------------------------------------------------

struct ExrChannel {
    std::string name;
    Imf::PixelType type;
};

/// Value of channel c at pixel (x, y) of the data window.
float exr_value(int c, int x, int y) { return static_cast<float>(100 * c + 10 * y + x) / 8; }

/// Buffers of a data window, one per channel, in the file's types.
struct ExrPixels {
    std::vector<std::vector<char>> storage;
    Imf::FrameBuffer buffer;

    ExrPixels(const Imath::Box2i& box, const std::vector<ExrChannel>& channels) {
        const int width = box.max.x - box.min.x + 1, height = box.max.y - box.min.y + 1;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const std::size_t size = channels[c].type == Imf::HALF ? 2 : 4;
            auto& bytes = storage.emplace_back(size * width * height);
            for (int i = 0; i < width * height; ++i) {
                set(&bytes[i * size], channels[c].type,
                    exr_value(static_cast<int>(c), i % width, i / width));
            }
            buffer.insert(channels[c].name, Imf::Slice::Make(channels[c].type, bytes.data(), box,
                                                             size, size * width));
        }
    }
    static void set(char* to, Imf::PixelType type, float value) {
        const auto copy = [to](auto stored) { std::memcpy(to, &stored, sizeof stored); };
        if (type == Imf::HALF) copy(Imath::half(value));
        if (type == Imf::FLOAT) copy(value);
        if (type == Imf::UINT) copy(static_cast<std::uint32_t>(value));
    }
};

void write_exr(const fs::path& file, const std::vector<ExrChannel>& channels,
               const Imath::Box2i& display, const Imath::Box2i& data, bool tiled = false) {
    Imf::Header header(display, data);
    for (const ExrChannel& channel : channels) {
        header.channels().insert(channel.name, Imf::Channel(channel.type));
    }
    ExrPixels pixels(data, channels);
    if (tiled) {
        header.setTileDescription(Imf::TileDescription(4, 4, Imf::ONE_LEVEL));
        Imf::TiledOutputFile out(file.c_str(), header);
        out.setFrameBuffer(pixels.buffer);
        out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
    } else {
        Imf::OutputFile out(file.c_str(), header);
        out.setFrameBuffer(pixels.buffer);
        out.writePixels(data.max.y - data.min.y + 1);
    }
}

Imath::Box2i box(int x0, int y0, int x1, int y1) { return {{x0, y0}, {x1, y1}}; }

TEST_F(Images, ExrScanLinesAndTiles) {
    const std::vector<ExrChannel> rgba = {
        {"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}, {"A", Imf::HALF}};
    for (const bool tiled : {false, true}) {
        const fs::path file = directory_ / "a.exr";
        write_exr(file, rgba, box(0, 0, 6, 4), box(0, 0, 6, 4), tiled);
        const Image image = load_image(file);
        EXPECT_EQ(image.width, 7);
        EXPECT_EQ(image.height, 5);
        EXPECT_EQ(image.channels, 4);
        EXPECT_EQ(image.format, TexelFormat::half);
        for (int i = 0; i < 7 * 5 * 4; ++i) {
            EXPECT_EQ(image.values[i], exr_value(i % 4, i / 4 % 7, i / 28));
        }
    }
}

TEST_F(Images, ExrWindows) {
    // The data window begins left of the display window and ends short of its right and bottom.
    const fs::path file = directory_ / "a.exr";
    write_exr(file, {{"Y", Imf::FLOAT}}, box(10, 20, 15, 25), box(8, 21, 13, 23));
    const Image image = load_image(file);
    EXPECT_EQ(image.width, 6);
    EXPECT_EQ(image.height, 6);
    EXPECT_TRUE(image.luminance);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) {
            const bool inside = x <= 3 && y >= 1 && y <= 3;
            EXPECT_EQ(image.values[y * 6 + x], inside ? exr_value(0, x + 2, y - 1) : 0.0f);
        }
    }
    write_exr(file, {{"Y", Imf::FLOAT}}, box(0, 0, 1, 1), box(5, 5, 6, 6));
    EXPECT_EQ(load_image(file).values, std::vector<float>(4, 0.0f));
}

TEST_F(Images, ExrChannels) {
    const fs::path file = directory_ / "a.exr";
    const auto load = [&](const std::vector<ExrChannel>& channels) {
        write_exr(file, channels, box(0, 0, 1, 0), box(0, 0, 1, 0));
        return load_image(file);
    };
    EXPECT_EQ(load({{"depth.V", Imf::UINT}}).channels, 1);
    EXPECT_EQ(load({{"height", Imf::FLOAT}}).values, (std::vector<float>{0, 0.125f}));
    EXPECT_EQ(load({{"R", Imf::FLOAT}, {"G", Imf::HALF}}).format, TexelFormat::float32);
    EXPECT_EQ(
        load({{"R", Imf::HALF}, {"G", Imf::HALF}, {"B", Imf::HALF}, {"Z", Imf::FLOAT}}).channels,
        3);
    EXPECT_EQ(load({{"Y", Imf::HALF}, {"A", Imf::HALF}}).channels, 2);
    EXPECT_THROW(load({{"U", Imf::HALF}, {"V", Imf::HALF}}), InputError);
    EXPECT_THROW(load({{"R", Imf::HALF}, {"B", Imf::HALF}}), InputError);
}

TEST_F(Images, PartsOfExrAreErrors) {
    const fs::path file = directory_ / "whole.exr";
    for (const bool tiled : {false, true}) {
        write_exr(file, {{"R", Imf::FLOAT}}, box(0, 0, 63, 63), box(0, 0, 63, 63), tiled);
        const Bytes whole = read(file);
        EXPECT_TRUE(refuses_parts(load_any, directory_ / "part.exr", whole, whole.size() / 17 - 1));
    }
}

TEST_F(Images, NotFiniteTexelsAreRefusedOrCounted) {
    const fs::path file = directory_ / "nan.exr";
    Imf::Header header(3, 2);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const float pixels[6] = {1, 2, 3, 4, std::numeric_limits<float>::quiet_NaN(), -infinity};
    {
        Imf::OutputFile out(file.c_str(), header);
        Imf::FrameBuffer buffer;
        buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, pixels, header.dataWindow()));
        out.setFrameBuffer(buffer);
        out.writePixels(2);
    }
    EXPECT_EQ(load_image(file, NotFinite::count).not_finite, 2u);
    TextureCache cache;
    const auto kept = cache.load(file, {}, NotFinite::count);
    EXPECT_TRUE(std::isnan(kept->level_texels(0, 0)[4]));
    EXPECT_THROW(cache.load(file), InputError) << "the texture is alive, but not for everyone";
    try {
        load_any(file);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_NE(error.found.find("column 1, row 1"), std::string::npos) << error.found;
        EXPECT_EQ(error.file, file);
    }
}

TEST_F(Images, HalvesAreNotMadeOfWhatTheyCannotHold) {
    const fs::path file = directory_ / "large.exr";
    Imf::Header header(3, 1);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    const float pixels[3] = {1, 65519, -65520};
    {
        Imf::OutputFile out(file.c_str(), header);
        Imf::FrameBuffer buffer;
        buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, pixels, header.dataWindow()));
        out.setFrameBuffer(buffer);
        out.writePixels(1);
    }
    TextureCache cache;
    TextureOptions options;
    EXPECT_EQ(cache.load(file, options)->level_texels(0, 0)[2], -65520);
    options.format = TexelFormat::half;
    options.key = "material.height";
    EXPECT_TRUE(std::isinf(cache.load(file, options, NotFinite::count)->level_texels(0, 0)[2]));
    try {
        cache.load(file, options);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_NE(error.found.find("-65520 in channel 0"), std::string::npos) << error.found;
        EXPECT_NE(error.found.find("column 2, row 0"), std::string::npos) << error.found;
        EXPECT_EQ(error.key, "material.height");
    }
}

// ---- The cache ----------------------------------------------------------------------------------

TEST_F(Images, CacheSharesEqualContent) {
    const Bytes png = make_png(16, 16, 8, PngColour::grey, all_codes());
    const fs::path a = write("a.png", png), b = write("b.png", png);
    const fs::path c = write("c.png", make_png(1, 1, 8, PngColour::grey, "x"));
    TextureCache cache;
    const auto first = cache.load(a);
    EXPECT_EQ(cache.load(a), first);
    EXPECT_EQ(cache.load(b), first);
    EXPECT_NE(cache.load(c), first);
    TextureOptions flipped;
    flipped.flip_v = true;
    EXPECT_NE(cache.load(a, flipped), first);
    EXPECT_THROW(cache.load(directory_ / "missing.png"), InputError);
    const std::array<fs::path, 6> faces = {a, b, a, b, a, b};
    EXPECT_EQ(cache.load_cube(faces), cache.load_cube(faces));
}

}  // namespace
}  // namespace quadrel::test
