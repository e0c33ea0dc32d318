// Images that are handed out band by band.
#include "film/preview_sink.hpp"
#include "quadrel/film/preview.hpp"
#include "render/bands/draw_bands.hpp"
#include "render/bands/joined.hpp"

namespace quadrel::render_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;

TEST(RenderInBands, HandsOutRowsFromTheTop) {
    const Scene scene = varied_scene(1, Conventions::gl, 37, 300);
    RenderOptions options;
    int next = 0, bands = 0;
    render_in_bands(scene, options, [&](const Film& band) {
        EXPECT_EQ(band.window.y0, std::exchange(next, band.window.y1));
        EXPECT_LT(band.window.height(), 100) << "memory is that of a band";
        ++bands;
    });
    EXPECT_EQ(next, scene.height);
    EXPECT_GE(bands, 4);
    EXPECT_TRUE(same_bits(render(scene, options), joined_bands(scene, options)));
}

TEST(RenderInBands, WhatIsThrownEndsTheDrawing) {
    const Scene scene = varied_scene(1, Conventions::gl, 37, 4000);
    RenderOptions options;
    options.threads = 2;
    double share = 0;
    options.progress = [&](double done) { share = done; };
    const auto refuse = [](const Film&) { throw std::out_of_range("no room"); };
    EXPECT_THROW(render_in_bands(scene, options, refuse), std::out_of_range);
    EXPECT_LT(share, 0.5);
}

/// Groups that are shown pixel by pixel, and those whose values are spread.
TEST(PreviewOfBands, IsThatOfTheFilm) {
    const TemporaryFolder folder;
    const Scene scene = varied_scene(1, Conventions::gl, 37, 151);
    for (const std::vector<std::string>& channels :
         std::vector<std::vector<std::string>>{{},
                                               {"N", "Z"},
                                               {"hit.status", "Z"},
                                               {"P.Y", "P"},
                                               {"P.Z"},
                                               {"depth", "B", "G", "R"}}) {
        RenderOptions options;
        options.channels = channels;
        write_png(folder / "film.png", preview(render(scene, options)));
        render_bands(scene, options, [&](const Film& layout) {
            return png_file_sink(folder / "bands.png", layout);
        });
        EXPECT_EQ(file_bytes(folder / "bands.png"), file_bytes(folder / "film.png"))
            << fmt::format("{}", fmt::join(channels, " "));
    }
}

}  // namespace
}  // namespace quadrel::render_tests
