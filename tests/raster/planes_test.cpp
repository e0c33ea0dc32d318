// Attribute planes of implementations, judged by what the implementations themselves drew.
#include "quadrel/raster/planes.hpp"

#include <algorithm>
#include <bit>
#include <span>

#include "raster/exact_interpolation.hpp"

namespace quadrel::test {
namespace {

using Pair = std::array<float, 2>;

struct DrawnVertex {
    glm::vec4 clip;
    Pair value;
};
struct DrawnPixel {
    int x, y;
    Pair value;
};
/// On 64x64 pixels: window y up where llvmpipe drew it, down where SwiftShader did.
using DrawnTriangle = std::array<DrawnVertex, 3>;
const DrawnTriangle drawn_triangles[] = {
    {{
        {{0x1.33af2p-1f, 0x1.99112p-2f, 0x1.db3036p-2f, 0x1.28fe22p+1f},
         {0x1.2f6aa8p+0f, 0x1.3385dep+1f}},
        {{0x1.97f08ep-1f, -0x1.e5ceb2p-1f, 0x1.9b7a66p-2f, 0x1.012c8p+1f},
         {-0x1.fd37b6p+1f, 0x1.31ca5p+3f}},
        {{-0x1.51a328p-4f, 0x1.3e6d16p-4f, 0x1.ba736ep-4f, 0x1.148826p-1f},
         {-0x1.332a88p+3f, 0x1.287156p+1f}},
    }},
    {{
        {{-0x1.d04ddep-4f, 0x1.d96cc4p-2f, 0x1.99999ap-3f, 0x1p+0f},
         {-0x1.eb765ap-6f, -0x1.90424ap-1f}},
        {{-0x1.143374p-1f, -0x1.389612p-1f, 0x1.99999ap-3f, 0x1p+0f},
         {-0x1.76dc62p-8f, 0x1.981f0ep-2f}},
        {{0x1.131556p-2f, -0x1.6811bcp-2f, 0x1.99999ap-3f, 0x1p+0f},
         {-0x1.23977ap-4f, 0x1.0744e6p-1f}},
    }},
    {{
        {{0x1.a8b1e4p+0f, -0x1.87536ep-1f, 0x1.b40064p-2f, 0x1.10803ep+1f},
         {-0x1.4008ecp+2f, -0x1.2bc204p+2f}},
        {{-0x1.3f7ffap+0f, 0x1.1edff6p-1f, 0x1.5d824ep-2f, 0x1.b4e2e2p+0f},
         {0x1.2c54c4p+3f, 0x1.d85c0ap+0f}},
        {{-0x1.f05d14p-2f, -0x1.5cdb1ep-1f, 0x1.4e9716p-3f, 0x1.a23cdap-1f},
         {-0x1.1d79ep+3f, 0x1.8b09bep+1f}},
    }},
};

/// What was read back of each triangle's two varyings.
using DrawnPixels = std::array<DrawnPixel, 6>;

/// By llvmpipe (Mesa 22.3.6, LLVM 15, 256-bit vectors), OpenGL 4.5, into RGBA32F.
const DrawnPixels by_llvmpipe[] = {
    {{
        {44, 17, {-0x1.fa8a1cp+1f, 0x1.290058p+3f}},
        {42, 25, {-0x1.65dc4cp+1f, 0x1.9e6128p+2f}},
        {38, 29, {-0x1.92fc1cp+2f, 0x1.fc8676p+1f}},
        {35, 32, {-0x1.e2be1cp+2f, 0x1.8a8794p+1f}},
        {40, 34, {-0x1.cd094ep-1f, 0x1.b99548p+1f}},
        {40, 36, {0x1.c49136p-1f, 0x1.66d3b4p+1f}},
    }},
    {{
        {15, 13, {-0x1.e3a21ap-8f, 0x1.7a0044p-2f}},
        {19, 20, {-0x1.fd97e4p-7f, 0x1.3374fp-3f}},
        {32, 23, {-0x1.904978p-5f, 0x1.06aca8p-2f}},
        {36, 27, {-0x1.dba25cp-5f, 0x1.4b55cp-3f}},
        {29, 33, {-0x1.335d02p-5f, -0x1.b01cp-3f}},
        {28, 46, {-0x1.f29fep-6f, -0x1.88dac8p-1f}},
    }},
    {{
        {13, 5, {-0x1.1cc55ep+3f, 0x1.86b1cep+1f}},
        {41, 15, {-0x1.c9dd12p+2f, -0x1.66014ap-3f}},
        {28, 20, {-0x1.21422ap+2f, 0x1.127d22p+0f}},
        {27, 24, {-0x1.3cc8cap+1f, 0x1.ad95ep-1f}},
        {29, 29, {0x1.d1ad14p-1f, -0x1.110c44p-4f}},
        {10, 41, {0x1.18fc52p+3f, 0x1.a69df8p+0f}},
    }},
};

/// By SwiftShader (5.0, Subzero, as Chromium ships it: 4 sub-pixel bits), Vulkan, the same.
const DrawnPixels by_swiftshader[] = {
    {{
        {44, 17, {-0x1.f9260ap+1f, 0x1.29170ap+3f}},
        {42, 25, {-0x1.6737f6p+1f, 0x1.9dcfap+2f}},
        {38, 29, {-0x1.9378a2p+2f, 0x1.fc2906p+1f}},
        {35, 32, {-0x1.e3296cp+2f, 0x1.8a7012p+1f}},
        {40, 34, {-0x1.e40bd6p-1f, 0x1.b88adcp+1f}},
        {40, 36, {0x1.a1efc6p-1f, 0x1.65efeep+1f}},
    }},
    {{
        {15, 13, {-0x1.e0ec48p-8f, 0x1.78bea6p-2f}},
        {18, 20, {-0x1.a5f3ccp-7f, 0x1.0d71dap-3f}},
        {32, 23, {-0x1.8fd834p-5f, 0x1.063ec8p-2f}},
        {36, 27, {-0x1.db31acp-5f, 0x1.4b09d8p-3f}},
        {29, 33, {-0x1.332122p-5f, -0x1.b006b8p-3f}},
        {28, 46, {-0x1.f29bcp-6f, -0x1.88808p-1f}},
    }},
    {{
        {13, 5, {-0x1.1cd0bcp+3f, 0x1.869ec6p+1f}},
        {40, 15, {-0x1.c68c4p+2f, -0x1.dd92p-6f}},
        {27, 20, {-0x1.20796p+2f, 0x1.31654p+0f}},
        {26, 24, {-0x1.3ee7bap+1f, 0x1.f2c6c8p-1f}},
        {29, 29, {0x1.d41614p-1f, -0x1.0c636ep-4f}},
        {10, 41, {0x1.190142p+3f, 0x1.a77868p+0f}},
    }},
};

template <Number F, class Value>
std::array<F, 2> both(const DrawnTriangle& drawn, Value value) {
    std::array<F, 2> out;
    for (std::size_t i = 0; i < 2; ++i)
        out[i] =
            value(PerVertex<F>{F(drawn[0].value[i]), F(drawn[1].value[i]), F(drawn[2].value[i])});
    return out;
}

RasterState drawn_by(Interpolation form) {
    RasterState state;
    const bool llvmpipe = form == Interpolation::llvmpipe;
    state.viewport = {64, 64, llvmpipe ? Conventions::gl : Conventions::vulkan};
    state.subpixel_bits = llvmpipe ? 8 : 4;
    return state;
}

ScreenTriangle set_up_whole(const DrawnTriangle& drawn, const RasterState& state) {
    std::vector<AssembledTriangle> pieces;
    PrimitiveCounts counts;
    assemble_triangle({drawn[0].clip, drawn[1].clip, drawn[2].clip}, state, pieces, counts);
    EXPECT_EQ(pieces.size(), 1u);
    return pieces.at(0).screen;
}

/// The float at offset i of a set-up, in every lane.
auto reader(const PlaneSetup& setup) {
    const auto floats = std::bit_cast<std::array<float, 16>>(setup);
    return [floats](int i) { return Quad<float>(floats[std::size_t(i)]); };
}

enum class PlantedPlane {
    none,
    rotated,          ///< anchored at another vertex
    centre_of_pixel,  ///< pixel coordinates at centres
    snapped,          ///< planes of the snapped vertices
    fine_grid         ///< vertices snapped to another grid
};

/// The set-up of a triangle, with an error planted.
PlaneSetup set_up_planes(Interpolation form, const DrawnTriangle& drawn, PlantedPlane planted) {
    RasterState state = drawn_by(form);
    if (planted == PlantedPlane::fine_grid) state.subpixel_bits = 7;
    ScreenTriangle triangle = set_up_whole(drawn, state);
    if (planted == PlantedPlane::snapped)
        for (ScreenVertex& v : triangle.vertex) {
            v.window_x = float(v.x) / 256;
            v.window_y = float(v.y) / 256;
        }
    return plane_setup(form, triangle, planted == PlantedPlane::centre_of_pixel ? 4 : 1);
}

/// At a pixel, whose quad's lane it is.
Quad<float> value_at(Interpolation form, const PlaneSetup& setup, const PerVertex<Quad<float>>& v,
                     int x, int y) {
    using F = Quad<float>;
    const F px(float(x) + 0.5f), py(float(y) + 0.5f), right(float(x & 1)), lower(float(y & 1));
    return form == Interpolation::llvmpipe
               ? llvmpipe_value(v, px, py, reader(setup))
               : swiftshader_value(v, px, py, right, lower, reader(setup));
}

/// Every value that was read back, bit for bit.
testing::AssertionResult has_the_bits(Interpolation form, std::span<const DrawnPixels> all,
                                      PlantedPlane planted) {
    for (std::size_t t = 0; t < all.size(); ++t) {
        DrawnTriangle drawn = drawn_triangles[t];
        if (planted == PlantedPlane::rotated)
            std::rotate(drawn.begin(), drawn.begin() + 1, drawn.end());
        const PlaneSetup setup = set_up_planes(form, drawn, planted);
        for (const DrawnPixel& pixel : all[t]) {
            const auto got = both<Quad<float>>(drawn, [&](const auto& value) {
                return value_at(form, setup, value, pixel.x, pixel.y);
            });
            for (std::size_t i = 0; i < 2; ++i)
                if (got[i].lane[0] != pixel.value[i])
                    return testing::AssertionFailure()
                           << pixel.x << ", " << pixel.y << ": " << got[i].lane[0] << " for "
                           << pixel.value[i];
        }
    }
    return testing::AssertionSuccess();
}

/// How far the planes lie from the exact values at covered pixels, in ulps of the largest value
/// at a vertex.
double largest_error(Interpolation form, const DrawnTriangle& drawn) {
    const ScreenTriangle t = set_up_whole(drawn, drawn_by(form));
    const PlaneSetup setup = plane_setup(form, t, 1);
    const Values v{drawn[0].value[0], drawn[1].value[0], drawn[2].value[0]};
    const PerVertex<Quad<float>> value{v[0], v[1], v[2]};
    double worst = 0;
    for (int i = 0; i < 64 * 64; ++i) {
        const int x = i % 64, y = i / 64;
        if (!coverage_mask(t, x, y, 1)) continue;
        const float got = value_at(form, setup, value, x, y).lane[0];
        const std::size_t lane = std::size_t((y & 1) * 2 + (x & 1));
        const auto exact = exact_value(t, edge_values(t, quad_centres(x & ~1, y & ~1)), lane, v);
        if (exact) worst = std::max(worst, error_of(*exact, got) / float_ulp(exact->largest));
    }
    return worst;
}

TEST(Planes, LlvmpipesBits) {
    const auto check = [](PlantedPlane planted) {
        return has_the_bits(Interpolation::llvmpipe, by_llvmpipe, planted);
    };
    EXPECT_TRUE(check(PlantedPlane::none));
    for (PlantedPlane planted :
         {PlantedPlane::rotated, PlantedPlane::centre_of_pixel, PlantedPlane::snapped})
        EXPECT_FALSE(check(planted)) << int(planted);
}

TEST(Planes, SwiftShadersBits) {
    const auto check = [](PlantedPlane planted) {
        return has_the_bits(Interpolation::swiftshader, by_swiftshader, planted);
    };
    EXPECT_TRUE(check(PlantedPlane::none));
    EXPECT_FALSE(check(PlantedPlane::fine_grid));
}

/// Half of a square that faces the eye, on 64x64 pixels: two vertices tie in y and all in w. Drawn
/// by the same SwiftShader through zink and through ANGLE, OpenGL, window y up, where flat values
/// are those of the last vertex, with which the sorting begins.
const DrawnTriangle half_square{{
    {{-0x1.6d9b1cp+0f, -0x1.6d9b1cp+0f, 0x1.667968p+1f, 3}, {0, 0}},
    {{0x1.6d9b1cp+0f, -0x1.6d9b1cp+0f, 0x1.667968p+1f, 3}, {1, 0}},
    {{0x1.6d9b1cp+0f, 0x1.6d9b1cp+0f, 0x1.667968p+1f, 3}, {1, 1}},
}};
const DrawnPixels of_half_square{{
    {44, 44, {0x1.d1d608p-1f, 0x1.d1d608p-1f}},
    {33, 33, {0x1.192e2ap-1f, 0x1.192e2ap-1f}},
    {29, 29, {0x1.ac10c8p-2f, 0x1.ac10c8p-2f}},
    {26, 26, {0x1.47582p-2f, 0x1.47582p-2f}},
    {20, 20, {0x1.f79b38p-4f, 0x1.f79b38p-4f}},
    {17, 17, {0x1.92e28p-6f, 0x1.92e28p-6f}},
}};

TEST(Planes, SwiftShadersBitsWhereVerticesTie) {
    const auto has_bits = [](const DrawnTriangle& drawn) {
        RasterState state = drawn_by(Interpolation::swiftshader);
        state.viewport.conventions = Conventions::gl;
        const PlaneSetup setup =
            plane_setup(Interpolation::swiftshader, set_up_whole(drawn, state), 1);
        return std::all_of(
            of_half_square.begin(), of_half_square.end(), [&](const DrawnPixel& pixel) {
                const auto got = both<Quad<float>>(drawn, [&](const auto& value) {
                    return value_at(Interpolation::swiftshader, setup, value, pixel.x, pixel.y);
                });
                return got[0].lane[0] == pixel.value[0] && got[1].lane[0] == pixel.value[1];
            });
    };
    EXPECT_TRUE(has_bits(half_square));
    DrawnTriangle rotated = half_square;
    std::rotate(rotated.begin(), rotated.begin() + 1, rotated.end());
    EXPECT_FALSE(has_bits(rotated));
}

/// llvmpipe's planes follow the unsnapped vertices, SwiftShader's the snapped ones within
/// roundings.
TEST(Planes, FollowTheExactValues) {
    for (const DrawnTriangle& drawn : drawn_triangles) {
        EXPECT_LT(largest_error(Interpolation::swiftshader, drawn), 100);
        EXPECT_GT(largest_error(Interpolation::swiftshader, drawn), 0.51);
        EXPECT_GT(largest_error(Interpolation::llvmpipe, drawn), 100);
    }
}

}  // namespace
}  // namespace quadrel::test
