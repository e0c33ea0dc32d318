// Normals from heights against the analytic normals of the fields that they are made for, over
// sheared, anisotropic, mirrored and turned UV maps.
#include "quadrel/relief/noise.hpp"
#include "relief/facet.hpp"
#include "relief/planted.hpp"
#include "relief/stage_inputs.hpp"

namespace quadrel::test {
namespace {

using Surface = StageUnderTest<float>;

/// n = normalize(N - D (h_u grad u + h_v grad v)) of a lane's own J and N, in double.
dvec3 truth(Batch<float>& batch, int lane, const dvec2& slope) {
    const dvec3 gu(batch.vector3(Value::J, lane)), gv(batch.vector3(Value::J, lane, 3));
    const double D = batch.real(Value::relief_depth, lane);
    return normalize(dvec3(batch.vector3(Value::frame_normal, lane)) -
                     (gu * slope.x + gv * slope.y) * D);
}

/// Rounding of height differences over a texel of `size` a tile, and of the sum's parts.
double rounding(Batch<float>& batch, int lane, int size) {
    const double D = batch.real(Value::relief_depth, lane);
    const double gradient =
        length(batch.vector3(Value::J, lane)) + length(batch.vector3(Value::J, lane, 3));
    return float_roundoff * (64 + 16 * D * gradient * size);
}

// ---- Fields -------------------------------------------------------------------------------------

/// Heights a + b x + c y + d x^2 + e x y + f y^2 of x = u - 1/2, y = v - 1/2.
struct Quadric {
    double a, b, c, d, e, f;

    static Quadric random(Random& random, bool planar) {
        const auto part = [&] { return random.uniform(-1, 1); };
        const double bend = planar ? 0 : 1;
        return {0.5, part(), part(), bend * part(), bend * part(), bend * part()};
    }
    double height(const dvec2& uv) const {
        const double x = uv.x - 0.5, y = uv.y - 0.5;
        return a + b * x + c * y + d * x * x + e * x * y + f * y * y;
    }
    dvec2 slope(const dvec2& uv) const {
        const double x = uv.x - 0.5, y = uv.y - 0.5;
        return {b + 2 * d * x + e * y, c + e * x + 2 * f * y};
    }
    Map map(int width, int height_texels) const {
        return height_map(width, height_texels, [&](int x, int y) {
            return static_cast<float>(height({(x + 0.5) / width, (y + 0.5) / height_texels}));
        });
    }
};

/// Where a stage's differences of a quadric are exact: h_u at `first`, h_v at `second`.
struct ExactAt {
    dvec2 first, second;
};
using Where = std::function<ExactAt(const dvec2& uv, const dvec2& middle)>;

ExactAt at_the_hit(const dvec2& uv, const dvec2&) { return {uv, uv}; }
ExactAt amid_the_texels(const dvec2&, const dvec2& middle) { return {middle, middle}; }
/// The slope of a bilinear patch in u is that of the chord, at the hit's v.
ExactAt on_the_patch(const dvec2& uv, const dvec2& middle) {
    return {{middle.x, uv.y}, {uv.x, middle.y}};
}

/// The middle of the four texels around uv.
dvec2 middle_of_cell(const dvec2& uv, int width, int height) {
    return {(std::floor(uv.x * width - 0.5) + 1) / width,
            (std::floor(uv.y * height - 0.5) + 1) / height};
}

testing::AssertionResult normals_of_quadrics(const Surface& surface, const Where& where,
                                             bool planar) {
    for (int i = 0; i < 100; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Quadric field = Quadric::random(random, planar);
        const int width = 12 + random.below(20), height = 12 + random.below(20);
        const Map map = field.map(width, height);
        const Plane plane = random_plane(random);
        Batch<float> batch = facet_batch(plane, leaning(plane, random, 0.3),
                                         static_cast<float>(random.uniform(0.01, 0.5)), random);
        batch.bind(TextureSlot::height, map.sampled);
        surface.run(batch);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const dvec2 uv(batch.vector2(Value::hit_uv, lane));
            const ExactAt at = where(uv, middle_of_cell(uv, width, height));
            const dvec2 slope(field.slope(at.first).x, field.slope(at.second).y);
            const dvec3 n(batch.vector3(Value::N, lane));
            const double error = length(n - truth(batch, lane, slope));
            if (!(error <= rounding(batch, lane, std::max(width, height)))) {
                return testing::AssertionFailure() << "map " << i << ": " << error;
            }
        }
    }
    return testing::AssertionSuccess();
}

void exchange_axes(Batch<float>& b) {
    for (int lane = 0; lane < b.lanes; ++lane)
        for (int c = 0; c < 3; ++c)
            std::swap(b.real(Value::J, lane, c), b.real(Value::J, lane, 3 + c));
}

/// Heights read by a stage with an error in what it is given or in what it gives.
Surface flawed_heights(const std::string& id, Planted planted) {
    const auto scaled = [id](float factor) {
        return Surface{id, [factor](Batch<float>& b) { b.material.depth *= factor; },
                       [factor](Batch<float>& b) {
                           b.material.depth /= factor;
                           for (int lane = 0; lane < b.lanes; ++lane)
                               b.real(Value::relief_depth, lane) = b.material.depth;
                       }};
    };
    switch (planted) {
        case Planted::slope_upside_down:
            return scaled(-1);
        case Planted::gain_of_two:
            return scaled(2);
        case Planted::axes_exchanged:
            return {id, exchange_axes, exchange_axes};
        default:
            return {id};
    }
}

struct Row {
    const char* id;
    Where where;
};
const std::vector<Row> height_rows = {{"h2n-4tap", at_the_hit},
                                      {"h2n-sobel", at_the_hit},
                                      {"h2n-gather", amid_the_texels},
                                      {"h2n-patch", on_the_patch}};

TEST(NormalsFromHeights, AreThoseOfPlanesAndQuadrics) {
    for (const auto& [id, where] : height_rows) {
        EXPECT_TRUE(normals_of_quadrics({id}, where, true)) << id;
        EXPECT_TRUE(normals_of_quadrics({id}, where, false)) << id;
        for (const Planted planted : {Planted::slope_upside_down, Planted::gain_of_two})
            EXPECT_FALSE(normals_of_quadrics(flawed_heights(id, planted), where, true)) << id;
    }
    // Neither the listing's gains nor its frame.
    for (const char* id : {"h2n-4tap@published", "h2n-sobel@published", "h2n-gather@published"})
        EXPECT_FALSE(normals_of_quadrics(
            {id,
             [](Batch<float>& b) {
                 for (const Value v : {Value::dPdx, Value::dPdy, Value::vertex_normal})
                     for (int lane = 0; lane < b.lanes; ++lane)
                         b.set(v, lane,
                               v == Value::vertex_normal ? b.vector3(Value::Ng, lane)
                               : v == Value::dPdx        ? vec3<float>(1, 0, 0)
                                                         : vec3<float>(0, 1, 0));
             }},
            at_the_hit, true))
            << id;
}

/// In double the normals of an exact ramp are off by double's rounding alone.
testing::AssertionResult exact_in_double(const std::string& id, double gain) {
    const Quadric ramp{0.5, 0.5, -0.25, 0, 0, 0};
    const Map map = ramp.map(32, 32);
    for (int i = 0; i < 20; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Plane plane = random_plane(random);
        Batch<float> single = facet_batch(plane, leaning(plane, random, 0.3), 0.25f, random);
        single.bind(TextureSlot::height, map.sampled);
        Batch<double> wide = in_double(single);
        wide.run(id);
        for (int lane = 0; lane < wide.lanes; ++lane) {
            single.real(Value::relief_depth, lane) = single.material.depth;
            const dvec3 n = truth(single, lane, ramp.slope({0.5, 0.5}) * gain);
            const double error = length(wide.vector3(Value::N, lane) - n);
            if (!(error < 1e-12)) return testing::AssertionFailure() << "off by " << error;
        }
    }
    return testing::AssertionSuccess();
}

TEST(NormalsFromHeights, AreExactInDouble) {
    for (const auto& [id, where] : height_rows) {
        EXPECT_TRUE(exact_in_double(id, 1)) << id;
        EXPECT_FALSE(exact_in_double(id, 1 + 1e-9)) << id;
    }
}

/// A gather does not know the slope at the hit, nor does a patch: only central differences do.
TEST(NormalsFromHeights, CellsAreConstantOrChords) {
    EXPECT_FALSE(normals_of_quadrics({"h2n-gather"}, at_the_hit, false));
    EXPECT_FALSE(normals_of_quadrics({"h2n-patch"}, at_the_hit, false));
    EXPECT_FALSE(normals_of_quadrics({"h2n-patch"}, amid_the_texels, false));
}

/// Slopes of noise that is sampled finely, at every stage that reads them from texels.
testing::AssertionResult follows_sampled_noise(const Surface& surface) {
    static const Map map = height_map(512, 512, [](int x, int y) {
        const dvec2 uv((x + 0.5) / 512, (y + 0.5) / 512);
        return static_cast<float>(noise_field<double>(uv, 4, 2).value);
    });
    Random random(1);
    const Plane plane = random_plane(random);
    Batch<float> batch = facet_batch(plane, plane.normal, 0.2f, random, batch_lanes);
    batch.bind(TextureSlot::height, map.sampled);
    surface.run(batch);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const dvec2 uv(batch.vector2(Value::hit_uv, lane));
        const dvec2 slope = noise_field<double>(uv, 4, 2).gradient;
        const double error =
            length(dvec3(batch.vector3(Value::N, lane)) - truth(batch, lane, slope));
        if (!(error < 0.03)) return testing::AssertionFailure() << "off by " << error;
    }
    return testing::AssertionSuccess();
}

TEST(NormalsFromHeights, FollowNoise) {
    for (const auto& [id, where] : height_rows) {
        EXPECT_TRUE(follows_sampled_noise({id})) << id;
        for (const Planted planted :
             {Planted::slope_upside_down, Planted::gain_of_two, Planted::axes_exchanged})
            EXPECT_FALSE(follows_sampled_noise(flawed_heights(id, planted))) << id;
    }
}

// ---- Mirrored maps and turned UV maps -----------------------------------------------------------

/// Multiples of 2^-8 in the middle half of the map, so that 1 - u is exact.
void snap_hits(Batch<float>& batch) {
    for (int lane = 0; lane < batch.lanes; ++lane) {
        for (int c = 0; c < 2; ++c) {
            float& x = batch.real(Value::hit_uv, lane, c);
            x = std::round(x * 256) / 256 + 1.0f / 1024;
        }
    }
}

/// Heights in steps of 2^-8, mirrored in u or not.
Map stepped_map(std::uint64_t seed, bool mirrored) {
    Random random(seed);
    std::vector<float> rows;
    for (int i = 0; i < 256; ++i) rows.push_back(static_cast<float>(random.below(257)) / 256);
    return height_map(16, 16, [&](int x, int y) {
        return rows[static_cast<std::size_t>(16 * y + (mirrored ? 15 - x : x))];
    });
}

/// The same surface by a map mirrored in u, or by J turned a quarter with the map's axes: all
/// differences are exact, so the bits are the same.
testing::AssertionResult mirrored_bits_agree(const std::string& id, bool mirror_map) {
    Random random(4);
    const Map map = stepped_map(5, false), mirror = stepped_map(5, mirror_map);
    const Plane plane = random_plane(random);
    Batch<float> one = facet_batch(plane, leaning(plane, random, 0.2), 0.1f, random, batch_lanes);
    snap_hits(one);
    Batch<float> other = one;
    one.bind(TextureSlot::height, map.sampled);
    other.bind(TextureSlot::height, mirror.sampled);
    for (int lane = 0; lane < one.lanes; ++lane) {
        for (int c = 0; c < 3; ++c) other.real(Value::J, lane, c) *= -1;
        other.real(Value::hit_uv, lane) = 1 - one.real(Value::hit_uv, lane);
    }
    one.run(id);
    other.run(id);
    constexpr auto normals = values(Value::N);
    return same_bits<float>(one, other, normals);
}

TEST(NormalsFromHeights, MirroredMapsAgreeBitForBit) {
    for (const auto& [id, where] : height_rows) {
        EXPECT_TRUE(mirrored_bits_agree(id, true)) << id;
        EXPECT_FALSE(mirrored_bits_agree(id, false)) << id;
    }
}

/// A sampler that mirrors shows the same surface as a map that holds its own mirror image.
testing::AssertionResult wraps_agree(const std::string& id, Wrap wrap) {
    const Map half = stepped_map(6, false);
    Map mirroring = half;
    mirroring.sampled.sampler.wrap_u = wrap;
    const float* texels = half.sampled.view.texels;
    const Map whole =
        height_map(32, 16, [&](int x, int y) { return texels[16 * y + (x < 16 ? x : 31 - x)]; });
    Random random(7);
    const Plane plane = random_plane(random);
    Batch<float> one = facet_batch(plane, plane.normal, 0.1f, random, batch_lanes);
    snap_hits(one);
    Batch<float> two = one;
    for (int lane = 0; lane < one.lanes; ++lane) {  // two tiles of the half are one of the whole
        one.real(Value::hit_uv, lane) *= 2;
        for (int c = 0; c < 3; ++c) two.real(Value::J, lane, c) *= 0.5f;
    }
    one.bind(TextureSlot::height, mirroring.sampled);
    two.bind(TextureSlot::height, whole.sampled);
    one.run(id);
    two.run(id);
    constexpr auto normals = values(Value::N);
    return same_bits<float>(one, two, normals);
}

TEST(NormalsFromHeights, MirroringSamplersAgreeBitForBit) {
    for (const auto& [id, where] : height_rows) {
        EXPECT_TRUE(wraps_agree(id, Wrap::mirrored_repeat)) << id;
        EXPECT_FALSE(wraps_agree(id, Wrap::repeat)) << id;
    }
}

// ---- Where nothing tilts ------------------------------------------------------------------------

/// Depth 0, and lanes without a frame: the frame's normal, bit for bit.
testing::AssertionResult keeps_the_frames_normal(const std::string& id, float depth,
                                                 Status status) {
    Random random(3);
    StageInputs inputs(3, SlotsBound::not_baked);
    Batch<float>& batch = inputs.batch;
    batch.material.depth = depth;
    for (int lane = 0; lane < batch.lanes; ++lane)
        batch.integer(Value::frame_status, lane) = static_cast<int>(status);
    batch.run(id);
    for (int lane = 0; lane < batch.lanes; ++lane)
        if (batch.vector3(Value::N, lane) != batch.vector3(Value::frame_normal, lane))
            return testing::AssertionFailure() << "lane " << lane;
    return testing::AssertionSuccess();
}

TEST(NormalsFromHeights, WithoutDepthOrFrameNothingTilts) {
    for (const char* id : {"h2n-4tap", "h2n-sobel", "h2n-gather", "h2n-patch", "bump-blinn"}) {
        EXPECT_TRUE(keeps_the_frames_normal(id, 0, Status::hit)) << id;
        EXPECT_TRUE(keeps_the_frames_normal(id, 0.3f, Status::no_frame)) << id;
        EXPECT_FALSE(keeps_the_frames_normal(id, 0.3f, Status::hit)) << id;
    }
    EXPECT_TRUE(keeps_the_frames_normal("bump-noise", 0.3f, Status::no_frame));
    EXPECT_TRUE(keeps_the_frames_normal("normal-map", 0.3f, Status::no_frame));
}

}  // namespace
}  // namespace quadrel::test
