// EXR files of several layers and parts, and channels X Y Z.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

#include <functional>

#include "io/image/image_folder.hpp"
#include "quadrel/error.hpp"
#include "quadrel/texture/texture_cache.hpp"
#include "texture/planted.hpp"

namespace quadrel::test {
namespace {

struct Part {
    std::string name;
    std::vector<std::string> channels;  ///< the c-th of the p-th part has the value 10 p + c
};

/// 2 x 1 pixels a part; a single part without a name is a plain file.
void write_parts(const std::filesystem::path& file, const std::vector<Part>& parts) {
    std::vector<Imf::Header> headers;
    for (const Part& part : parts) {
        Imf::Header& header = headers.emplace_back(2, 1);
        if (!part.name.empty()) header.setName(part.name);
        header.setType(Imf::SCANLINEIMAGE);
        for (const std::string& name : part.channels)
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    }
    Imf::MultiPartOutputFile output(file.c_str(), headers.data(), static_cast<int>(parts.size()));
    for (std::size_t p = 0; p < parts.size(); ++p) {
        std::vector<std::vector<float>> values;
        for (std::size_t c = 0; c < parts[p].channels.size(); ++c)
            values.emplace_back(2, static_cast<float>(10 * p + c));
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < values.size(); ++c)
            buffer.insert(parts[p].channels[c],
                          Imf::Slice::Make(Imf::FLOAT, values[c].data(), headers[p].dataWindow()));
        Imf::OutputPart part(output, static_cast<int>(p));
        part.setFrameBuffer(buffer);
        part.writePixels(1);
    }
}

using Values = std::vector<float>;

class Layers : public ImageFolder {
  protected:
    void SetUp() override {
        ImageFolder::SetUp();
        write_parts(directory_ / "layers.exr",
                    {{"", {"albedo.R", "albedo.G", "albedo.B", "height.Y", "a.b.R"}}});
        write_parts(
            directory_ / "parts.exr",
            {{"depth", {"Z"}}, {"rgba", {"R", "G", "B", "deep.Y"}}, {"1", {"N.X", "N.Y", "N.Z"}}});
    }

    Image load(const std::string& name, const ImageSelection& selection) const {
        return load_image(directory_ / name, NotFinite::refuse, "t", selection);
    }
    /// The first pixel.
    Values first(const std::string& name, const ImageSelection& selection) const {
        const Image image = load(name, selection);
        return {image.values.begin(), image.values.begin() + image.channels};
    }
    std::string refused(const std::string& name, const ImageSelection& selection) const {
        try {
            load(name, selection);
        } catch (const InputError& error) {
            EXPECT_EQ(error.key, "t");
            return error.found + " / " + error.expected;
        }
        return "";
    }
};

TEST_F(Layers, ALayerIsFoundByItsName) {
    EXPECT_EQ(first("layers.exr", {"albedo", ""}), (Values{0, 1, 2}));
    EXPECT_EQ(first("layers.exr", {"height", ""}), Values{3});
    EXPECT_TRUE(load("layers.exr", {"height", ""}).luminance);
    EXPECT_EQ(first("layers.exr", {"a.b", "0"}), Values{4});
    EXPECT_NE(refused("layers.exr", {}).find("layer to be named"), std::string::npos);
    const std::string unknown = refused("layers.exr", {"heigth", ""});
    EXPECT_NE(unknown.find("\"heigth\""), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("\"height\""), std::string::npos) << unknown;
}

TEST_F(Layers, APartIsFoundByNameOrNumberOrLayer) {
    EXPECT_EQ(first("parts.exr", {"", "depth"}), Values{0});
    EXPECT_EQ(first("parts.exr", {"", "0"}), Values{0});
    EXPECT_EQ(first("parts.exr", {"", "rgba"}), (Values{10, 11, 12}));
    // A name wins over a number: the part "1" is the third.
    EXPECT_EQ(first("parts.exr", {"N", "1"}), (Values{20, 21, 22}));
    EXPECT_EQ(first("parts.exr", {"N", "2"}), (Values{20, 21, 22}));
    EXPECT_EQ(first("parts.exr", {"depth", ""}), Values{0});
    EXPECT_EQ(first("parts.exr", {"deep", ""}), Values{13});
}

TEST_F(Layers, SeveralPartsAndNoneNamedIsOneLine) {
    const std::string none = refused("parts.exr", {});
    for (const char* word : {"3 parts", "\"depth\"", "\"rgba\"", "\"1\"", "part"})
        EXPECT_NE(none.find(word), std::string::npos) << none;
    EXPECT_NE(refused("parts.exr", {"", "3"}), "");
    EXPECT_NE(refused("parts.exr", {"", "-1"}), "");
    EXPECT_NE(refused("parts.exr", {"nowhere", ""}), "");
}

/// Points and normals are three channels; what only has a Y is luminance.
testing::AssertionResult has_three(const Image& image) {
    if (image.channels == 3 && !image.luminance && image.values[0] == 0 && image.values[2] == 2)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << image.channels << " channels";
}

TEST_F(Layers, PointsAreThreeChannels) {
    write_parts(directory_ / "xyz.exr", {{"", {"X", "Y", "Z"}}});
    EXPECT_TRUE(has_three(load("xyz.exr", {})));
    Image y = load("xyz.exr", {});  // Planted::luminance_of_points
    y.channels = 1;
    y.luminance = true;
    EXPECT_FALSE(has_three(y));
    write_parts(directory_ / "xyza.exr", {{"", {"X", "Y", "Z", "A"}}});
    EXPECT_EQ(load("xyza.exr", {}).channels, 4);
    write_parts(directory_ / "xy.exr", {{"", {"X", "Y"}}});
    EXPECT_NE(refused("xy.exr", {}), "");
    EXPECT_EQ(first("parts.exr", {"N", ""}), (Values{20, 21, 22}));
}

TEST_F(Layers, OtherFormatsHaveNone) {
    write("a.png", make_png(1, 1, 8, PngColour::grey, "x"));
    EXPECT_NE(refused("a.png", {"height", ""}).find("without layers"), std::string::npos);
    EXPECT_NE(refused("a.png", {"", "0"}).find("without parts"), std::string::npos);
}

using CacheLoad =
    std::function<std::shared_ptr<const Texture>(TextureCache&, const ImageSelection&)>;

testing::AssertionResult tells_layers_apart(const CacheLoad& load) {
    TextureCache cache;
    const auto albedo = load(cache, {"albedo", ""}), height = load(cache, {"height", ""});
    if (albedo == height) return testing::AssertionFailure() << "one texture for two layers";
    if (load(cache, {"albedo", ""}) != albedo) return testing::AssertionFailure() << "not shared";
    return testing::AssertionSuccess();
}

TEST_F(Layers, TheCacheTellsLayersApart) {
    const std::filesystem::path file = directory_ / "layers.exr";
    const auto plain = [&](TextureCache& cache, const ImageSelection& selection) {
        return cache.load(file, {}, NotFinite::refuse, selection);
    };
    EXPECT_TRUE(tells_layers_apart(plain));
    EXPECT_FALSE(tells_layers_apart([&](TextureCache& cache, const ImageSelection&) {
        return plain(cache, {"albedo", ""});  // Planted::layer_not_in_key
    }));
}

}  // namespace
}  // namespace quadrel::test
