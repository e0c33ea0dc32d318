// Depth layers out of their order or range are refused where a scene loads them.
#include <gtest/gtest.h>

#include "film/films.hpp"
#include "film/image_film.hpp"
#include "quadrel/error.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::render_tests {
namespace {

/// What is said of a map whose texel 1,0 has these depths; empty where it is rendered.
std::string refusal_of(float front, float back, const std::string& swizzle = "") {
    const testing_films::TemporaryFolder folder;
    Image image;
    image.width = image.height = 2;
    image.channels = 2;
    image.values = {0.25f, 0.5f, front, back, 0.25f, 0.25f, 0, 1};
    write_exr(folder / "layers.exr", image_film(image, false), {});
    std::vector<std::string> overrides{"size=[8,8]", "textures.layers.format=float",
                                       "textures.layers.file=" + (folder / "layers.exr").string()};
    if (!swizzle.empty()) overrides.push_back("textures.layers.swizzle=" + swizzle);
    try {
        render(load_scene("rows/dual-depth", overrides), {});
    } catch (const InputError& error) {
        EXPECT_EQ(error.key, "textures.layers");
        return error.what();
    }
    return "";
}

TEST(LayerOrder, DepthsOutOfOrderOrRangeAreRefused) {
    EXPECT_EQ(refusal_of(0.25f, 0.75f), "");
    EXPECT_EQ(refusal_of(0.5f, 0.5f), "");
    const std::pair<float, float> bad[] = {{0.75f, 0.25f}, {0.5f, 1.5f}, {-0.25f, 0.5f}};
    for (const auto& [front, back] : bad)
        EXPECT_NE(refusal_of(front, back).find("at texel 1,0, expected depths in [0, 1]"),
                  std::string::npos)
            << front << " " << back;
    // Arranged by the scene itself.
    EXPECT_EQ(refusal_of(0.25f, 0.75f, "gr"), "");
}

}  // namespace
}  // namespace quadrel::render_tests
