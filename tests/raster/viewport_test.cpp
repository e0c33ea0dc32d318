#include "quadrel/raster/viewport.hpp"

#include "raster/support.hpp"

namespace quadrel::test {
namespace {

constexpr Conventions all_conventions[] = {Conventions::gl, Conventions::vulkan, Conventions::d3d};

TEST(Viewport, CornersOfTheClipVolume) {
    const Viewport gl{40, 20, Conventions::gl}, vulkan{40, 20, Conventions::vulkan},
        d3d{40, 20, Conventions::d3d};
    const glm::dvec4 near_gl{-2, -2, -2, 2}, near_other{-2, -2, 0, 2}, far{2, 2, 2, 2};
    EXPECT_EQ(to_window(gl, near_gl).x, 0);
    EXPECT_EQ(to_window(gl, near_gl).y, 0);
    EXPECT_EQ(to_window(gl, near_gl).z, 0);
    EXPECT_EQ(to_window(vulkan, near_other).y, 0);
    EXPECT_EQ(to_window(d3d, near_other).y, 20);
    EXPECT_EQ(to_window(d3d, far).y, 0);
    for (const Viewport& viewport : {gl, vulkan, d3d}) {
        EXPECT_EQ(to_window(viewport, far).x, 40);
        EXPECT_EQ(to_window(viewport, far).z, 1);
    }
}

TEST(Viewport, ImageRowZeroIsTheTopOfTheScreen) {
    // The upper edge of the screen is clip y = +w in gl and d3d, -w in vulkan.
    for (Conventions conventions : all_conventions) {
        const Viewport viewport{8, 6, conventions};
        const double top = conventions == Conventions::vulkan ? -0.9 : 0.9;
        const int window_y = int(to_window(viewport, {0, top, 0, 1}).y);
        EXPECT_EQ(flip_row(viewport, window_y), 0);
    }
}

TEST(Viewport, FlippingIsItsOwnInverse) {
    for (Conventions conventions : all_conventions) {
        const Viewport viewport{9, 7, conventions};
        const PixelRect rect{1, 2, 5, 7};
        EXPECT_EQ(flip_rect(viewport, flip_rect(viewport, rect)), rect);
        for (int y = rect.y0; y < rect.y1; ++y)
            EXPECT_TRUE(flip_rect(viewport, rect).contains(1, flip_row(viewport, y)));
    }
}

TEST(Viewport, IntersectionsAreEmptyOrCommon) {
    EXPECT_EQ(intersect({0, 0, 4, 4}, {2, 3, 9, 9}), (PixelRect{2, 3, 4, 4}));
    EXPECT_TRUE(intersect({0, 0, 4, 4}, {4, 0, 9, 9}).empty());
}

}  // namespace
}  // namespace quadrel::test
