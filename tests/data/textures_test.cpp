// What data/textures/README.md promises: tiles without seams, values on their grids, a sky without
// edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "data/planted.hpp"
#include "quadrel/bake/depth_layers.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/num/srgb.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "quadrel/texture/image.hpp"

namespace quadrel::test {
namespace {

const std::filesystem::path directory = std::filesystem::path(QUADREL_DATA_DIR) / "textures";

float texel(const Image& image, int x, int y, int channel = 0) {
    return image.values[(static_cast<std::size_t>(y) * image.width + x) * image.channels + channel];
}

Image height_map(const std::string& name, Planted planted = Planted::none) {
    Image image = load_image(directory / name);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        float& value = image.values[i];
        const auto x = static_cast<float>(i / image.channels % image.width);
        if (planted == Planted::seam)
            value = 0.5f * value + 0.5f * x / static_cast<float>(image.width);
        if (planted == Planted::eight_bits) value = std::round(value * 255) / 255 * 0.999f;
    }
    return image;
}

/// Mean difference between neighbouring columns x and x + 1 (the last one's neighbour is 0).
double mean_step(const Image& image, int x) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        sum += std::fabs(texel(image, x, y) - texel(image, (x + 1) % image.width, y));
    return sum / image.height;
}

/// The step across the seam is no larger than the largest inside.
testing::AssertionResult tiles(const Image& image) {
    double largest = 0;
    for (int x = 0; x + 1 < image.width; ++x) largest = std::max(largest, mean_step(image, x));
    const double seam = mean_step(image, image.width - 1);
    if (seam <= largest) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "seam " << seam << ", largest step inside " << largest;
}

testing::AssertionResult on_unorm16_grid(const Image& image) {
    for (const float value : image.values) {
        const float code = std::round(value * 65535.0f);
        if (code < 0 || code > 65535 || code / 65535.0f != value)
            return testing::AssertionFailure() << value << " is not k / 65535";
    }
    return testing::AssertionSuccess();
}

constexpr const char* heights[] = {"bricks_height.exr",    "stones_height.exr", "text_height.exr",
                                   "spikes_height.exr",    "city_height.exr",   "dunes_height.exr",
                                   "bricks_height_256.png"};

TEST(Textures, HeightsTile) {
    for (const char* name : heights) EXPECT_TRUE(tiles(height_map(name))) << name;
    EXPECT_FALSE(tiles(height_map("dunes_height.exr", Planted::seam)));
}

TEST(Textures, HeightsAreUnorm16) {
    for (const char* name : heights) EXPECT_TRUE(on_unorm16_grid(height_map(name))) << name;
    EXPECT_FALSE(on_unorm16_grid(height_map("dunes_height.exr", Planted::eight_bits)));
}

/// Every colour is the linear light of an 8-bit sRGB code, within half a unit of half precision.
testing::AssertionResult on_srgb8_grid(const Image& image, Planted planted) {
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        if (static_cast<int>(i % image.channels) == 3) continue;
        double value = image.values[i];
        if (planted == Planted::dark_colour) value = srgb_encode(value);
        const double linear = srgb_decode(std::round(srgb_encode(value) * 255) / 255);
        if (std::fabs(linear - value) > 0x1p-11 * value + 0x1p-25)
            return testing::AssertionFailure() << value << " is not an sRGB code's";
    }
    return testing::AssertionSuccess();
}

TEST(Textures, ColoursAreSrgbCodes) {
    for (const char* name : {"bricks_color.exr", "stones_color.exr", "text_color.exr",
                             "city_color.exr", "dunes_color.exr", "calibration.exr"})
        EXPECT_TRUE(on_srgb8_grid(load_image(directory / name), Planted::none)) << name;
    EXPECT_FALSE(on_srgb8_grid(load_image(directory / "dunes_color.exr"), Planted::dark_colour));
}

// Faces +X -X +Y -Y +Z -Z; a texel is found by its direction (OpenGL 4.6 core, table 8.19).
using Direction = std::array<double, 3>;
using Sky = std::array<Image, 6>;

Sky load_sky(Planted planted) {
    Sky sky;
    const char* names[6] = {"px", "nx", "py", "ny", "pz", "nz"};
    for (int f = 0; f < 6; ++f)
        sky[f] = load_image(directory / ("sky_" + std::string(names[f]) + ".exr"));
    if (planted == Planted::faces_swapped) std::swap(sky[0], sky[5]);
    if (planted == Planted::face_turned) {
        Image turned = sky[4];
        for (int y = 0; y < turned.height; ++y)
            for (int x = 0; x < turned.width; ++x)
                for (int c = 0; c < turned.channels; ++c)
                    turned.values[(y * turned.width + x) * turned.channels + c] =
                        texel(sky[4], turned.width - 1 - x, y, c);
        sky[4] = turned;
    }
    return sky;
}

Direction direction_of(int face, double s, double t) {
    switch (face) {
        case 0:
            return {1, -t, -s};
        case 1:
            return {-1, -t, s};
        case 2:
            return {s, 1, t};
        case 3:
            return {s, -1, -t};
        case 4:
            return {s, -t, 1};
        default:
            return {-s, -t, -1};
    }
}

/// The nearest texel's green in the direction d.
float look_up(const Sky& sky, const Direction& d) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::fabs(d[i]) > std::fabs(d[axis])) axis = i;
    const int face = 2 * axis + (d[axis] < 0 ? 1 : 0);
    // The tables' inverse: s and t are the coordinates of direction_of's unit vectors.
    const double m = std::fabs(d[axis]);
    const Direction origin = direction_of(face, 0, 0), s1 = direction_of(face, 1, 0),
                    t1 = direction_of(face, 0, 1);
    double s = 0, t = 0;
    for (int i = 0; i < 3; ++i) {
        s += d[i] / m * (s1[i] - origin[i]);
        t += d[i] / m * (t1[i] - origin[i]);
    }
    const int n = sky[face].width;
    const auto index = [n](double v) {
        return std::clamp(static_cast<int>((v + 1) / 2 * n), 0, n - 1);
    };
    return texel(sky[face], index(s), index(t), 1);
}

/// Mean difference of texels along a line of constant s near `s`, one texel apart.
double mean_step_at(const Sky& sky, int face, double s, bool vertical) {
    const int n = sky[face].width;
    double sum = 0;
    for (int k = 0; k < n; ++k) {
        const double t = 2 * (k + 0.5) / n - 1, half = 1.0 / n;
        const Direction a =
            vertical ? direction_of(face, s - half, t) : direction_of(face, t, s - half);
        const Direction b =
            vertical ? direction_of(face, s + half, t) : direction_of(face, t, s + half);
        sum += std::fabs(look_up(sky, a) - look_up(sky, b));
    }
    return sum / n;
}

/// Steps across the edges of every face are like those next to them.
testing::AssertionResult seamless(const Sky& sky) {
    for (int face = 0; face < 6; ++face)
        for (const bool vertical : {false, true})
            for (const double side : {-1.0, 1.0}) {
                const double texel_size = 2.0 / sky[face].width;
                const double edge = mean_step_at(sky, face, side, vertical);
                double inside = 0;
                for (int k = 1; k <= 8; ++k)
                    inside = std::max(
                        inside, mean_step_at(sky, face, side * (1 - k * texel_size), vertical));
                if (edge > 1.5 * inside + 0.01)
                    return testing::AssertionFailure() << "face " << face << " side " << side
                                                       << ": " << edge << " against " << inside;
            }
    return testing::AssertionSuccess();
}

TEST(Textures, SkyHasNoEdges) {
    EXPECT_TRUE(seamless(load_sky(Planted::none)));
    EXPECT_FALSE(seamless(load_sky(Planted::faces_swapped)));
    EXPECT_FALSE(seamless(load_sky(Planted::face_turned)));
}

/// What the mesh gives on any machine.
testing::AssertionResult has_the_depths_of_the_mesh(const std::string& mesh, int solids) {
    DepthLayerOptions options;
    options.width = options.height = 96;
    options.solids = solids;
    const DepthLayers made =
        peel_depth_layers(load_mesh(directory.parent_path() / "meshes" / mesh), options);
    const Film kept = read_exr(directory / "spring_layers.exr").film;
    if (made.deeper != 0) return testing::AssertionFailure() << made.deeper << " texels are deeper";
    for (const Plane& plane : kept.planes) {
        const Plane* const other = made.film.find(plane.name);
        if (other == nullptr || other->bits != plane.bits)
            return testing::AssertionFailure() << plane.name;
    }
    return testing::AssertionSuccess();
}

TEST(Textures, SpringLayersAreThoseOfTheMesh) {
    EXPECT_TRUE(has_the_depths_of_the_mesh("spring.obj", 6));
    EXPECT_FALSE(has_the_depths_of_the_mesh("spring.obj", 4)) << "four solids";
}

}  // namespace
}  // namespace quadrel::test
