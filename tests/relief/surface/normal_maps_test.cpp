// Normal maps, window-space bumps and noise against the normals of the surfaces that they stand
// for.
#include "quadrel/relief/noise.hpp"
#include "relief/facet.hpp"
#include "relief/planted.hpp"
#include "relief/stage_inputs.hpp"
#include "relief/surface/normal_error.hpp"

namespace quadrel::test {
namespace {

using Surface = StageUnderTest<float>;

/// The normal of a surface with tangents u and v, on the side of N.
dvec3 normal_of(const dvec3& u, const dvec3& v, const dvec3& N) {
    const dvec3 n = cross(u, v);
    return normalize(dot(n, N) < 0 ? -n : n);
}

/// Texels c of 2 c - 1 = (x, y, z).
Map texel_map(const dvec3& t) {
    return make_map(
        2, 2, 4,
        [t](int, int, int c) { return c < 3 ? static_cast<float>(0.5 + 0.5 * t[c]) : 1.0f; },
        plain_sampler());
}

/// What `encoding` stores for the slopes s: rises over lengths on the surface, or, for 3, a tile.
dvec3 encoded(int encoding, const dvec2& s, double range) {
    const dvec3 n = normalize(dvec3(-s.x, -s.y, 1));
    if (encoding == 0) return n;
    if (encoding == 1) return {n.x, n.y, -1};  // the third channel is not read
    if (encoding == 3) return {-s.x / range, -s.y / range, 0.3};
    // z = 1 - x^2 - y^2 with (x, y) = -z s: z = (sqrt(1 + 4 |s|^2) - 1) / (2 |s|^2).
    const double q = dot(s, s), z = (std::sqrt(1 + 4 * q) - 1) / (2 * q);
    return {-s.x * z, -s.y * z, 0.7};
}

/// The stage, or one with an error in what it reads.
Surface normal_map(Planted planted) {
    const auto texels = [](float factor, float offset) {
        return Surface{"normal-map", [=](Batch<float>& b) {
                           static Map changed;
                           const float* t = b.bound(TextureSlot::normal)->view.texels;
                           changed = make_map(
                               2, 2, 4, [=](int, int, int c) { return t[c] * factor + offset; },
                               plain_sampler());
                           b.bind(TextureSlot::normal, changed.sampled);
                       }};
    };
    switch (planted) {
        case Planted::texel_not_centred:
            return texels(0.5f, 0.5f);
        case Planted::density_forgotten:  // |grad u| in place of |grad v| / |grad u x grad v|
            return {"normal-map", [](Batch<float>& b) {
                        for (int lane = 0; lane < b.lanes; ++lane)
                            for (int c = 0; c < 3; ++c) b.real(Value::J, lane, c) *= 2;
                    }};
        default:
            return {"normal-map"};
    }
}

/// Slopes along u and v, as the surface has them, over any UV map.
testing::AssertionResult shows_the_slopes(const Surface& surface, int encoding, int green,
                                          Planted planted = Planted::none) {
    for (int i = 0; i < 200; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Plane plane = random_plane(random);
        const dvec2 s(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7));
        const double range = 2, depth = 0.25;
        dvec3 texel = encoded(encoding, s, range);
        if (green < 0) texel.y *= -1;
        const Map map = texel_map(texel);
        Batch<float> batch = facet_batch(plane, plane.normal, static_cast<float>(depth), random, 4);
        batch.bind(TextureSlot::normal, map.sampled);
        const bool ignored = planted == Planted::green_ignored;
        surface.run(batch,
                    {{"encoding", encoding}, {"green", ignored ? 1 : green}, {"range", range}});
        const dvec3 tu = encoding == 3 ? plane.dPdu : normalize(plane.dPdu);
        const dvec3 tv = encoding == 3 ? plane.dPdv : normalize(plane.dPdv);
        const dvec2 rise = encoding == 3 ? s * depth : s;
        const dvec3 expected =
            normal_of(tu + plane.normal * rise.x, tv + plane.normal * rise.y, plane.normal);
        const double error = largest_error(batch, expected);
        if (!(error < 1e-5)) return testing::AssertionFailure() << i << ": off by " << error;
    }
    return testing::AssertionSuccess();
}

TEST(NormalMap, ShowsTheSlopesOfItsTexels) {
    for (int encoding = 0; encoding < 4; ++encoding) {
        for (const int green : {1, -1})
            EXPECT_TRUE(shows_the_slopes({"normal-map"}, encoding, green)) << encoding;
        EXPECT_FALSE(shows_the_slopes({"normal-map"}, encoding, -1, Planted::green_ignored));
        EXPECT_FALSE(shows_the_slopes(normal_map(Planted::texel_not_centred), encoding, 1));
    }
    EXPECT_FALSE(shows_the_slopes(normal_map(Planted::density_forgotten), 3, 1));
}

/// Twice the tiles along u: no other normal, since slopes are of lengths, not of tiles.
TEST(NormalMap, TheLengthOfATileDoesNotCount) {
    Random random(1);
    const Plane plane = random_plane(random);
    const Map map = texel_map(normalize(dvec3(0.3, -0.4, 1)));
    Batch<float> one = facet_batch(plane, plane.normal, 0.1f, random);
    one.bind(TextureSlot::normal, map.sampled);
    Batch<float> two = one;
    normal_map(Planted::density_forgotten).run(two);
    one.run("normal-map");
    for (int lane = 0; lane < one.lanes; ++lane)
        EXPECT_LT(length(one.vector3(Value::N, lane) - two.vector3(Value::N, lane)), 1e-6f);
}

/// The same surface by a texture mirrored in u: grad u and x negated. Bit for bit.
testing::AssertionResult mirrored_bits_agree(bool negate_x) {
    Random random(2);
    const Plane plane = random_plane(random);
    const dvec3 t(0.25, -0.5, 0.75);  // exact in c
    const Map map = texel_map(t), mirror = texel_map({negate_x ? -t.x : t.x, t.y, t.z});
    Batch<float> one = facet_batch(plane, leaning(plane, random, 0.2), 0.1f, random);
    Batch<float> other = one;
    one.bind(TextureSlot::normal, map.sampled);
    other.bind(TextureSlot::normal, mirror.sampled);
    for (int lane = 0; lane < one.lanes; ++lane)
        for (int c = 0; c < 3; ++c) other.real(Value::J, lane, c) *= -1;
    one.run("normal-map");
    other.run("normal-map");
    constexpr auto normals = values(Value::N);
    return same_bits<float>(one, other, normals);
}

TEST(NormalMap, MirroredMapsAgreeBitForBit) {
    EXPECT_TRUE(mirrored_bits_agree(true));
    EXPECT_FALSE(mirrored_bits_agree(false));
}

/// Encoding 4: the object's axes, towards the viewer's side of the face.
TEST(NormalMap, ObjectNormalsGoByTheNormalMatrix) {
    for (int i = 0; i < 50; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Plane plane = random_plane(random);
        const dvec3 x = random_direction(random) * 2.0, y = random_direction(random),
                    z = random_direction(random), t = random_direction(random);
        const Map map = texel_map(t);
        Batch<float> batch = facet_batch(plane, plane.normal, 0.1f, random, 8);
        batch.bind(TextureSlot::normal, map.sampled);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            batch.set(Value::object_x, lane, x);
            batch.set(Value::object_y, lane, y);
            batch.set(Value::object_z, lane, z);
            if (lane >= 4) batch.set(Value::Ng, lane, -plane.normal);  // seen from behind
        }
        batch.run("normal-map", {{"encoding", 4}});
        const dvec3 expected = normalize(x * t.x + y * t.y + z * t.z);
        EXPECT_LT(length(dvec3(batch.vector3(Value::N, 0)) - expected), 1e-5);
        EXPECT_EQ(batch.vector3(Value::N, 4), -batch.vector3(Value::N, 0));
    }
}

TEST(NormalMap, WithoutAMapTheFramesNormal) {
    Random random(3);
    const Plane plane = random_plane(random);
    for (const char* id : {"normal-map", "normal-smooth-mcguire"}) {
        Batch<float> batch = facet_batch(plane, leaning(plane, random, 0.3), 0.1f, random);
        batch.run(id);
        for (int lane = 0; lane < batch.lanes; ++lane)
            EXPECT_EQ(batch.vector3(Value::N, lane), batch.vector3(Value::frame_normal, lane));
    }
}

/// A texel of no length, and gradients that cancel, leave the frame's normal; NaN texels stay NaN.
TEST(NormalMap, WithoutALengthTheFramesNormal) {
    Random random(9);
    const Plane plane = random_plane(random);
    for (const char* id : {"normal-map", "normal-smooth-mcguire"}) {
        const auto normal_of = [&](float texel, bool parallel) {
            const Map map = make_map(
                2, 2, 4, [&](int, int, int) { return texel; }, plain_sampler());
            Batch<float> batch = facet_batch(plane, plane.normal, 0.1f, random);
            batch.bind(TextureSlot::normal, map.sampled);
            // Nearly the same direction twice, in opposite senses, as of coarse differences.
            for (int lane = 0; lane < batch.lanes && parallel; ++lane)
                for (int c = 0; c < 3; ++c) {
                    const float u = c == 0 ? 1.0f : 1e-8f * static_cast<float>(c);
                    batch.real(Value::J, lane, c) = u;
                    batch.real(Value::J, lane, c + 3) = c == 2 ? 0 : -u;
                }
            batch.run(id);
            return std::pair(batch.vector3(Value::N, 0), batch.vector3(Value::frame_normal, 0));
        };
        const auto [centre, frame] = normal_of(0.5f, false);
        EXPECT_EQ(centre, frame) << id;
        const auto cancelled = normal_of(0.0f, true).first;
        for (int c = 0; c < 3; ++c) EXPECT_FALSE(std::isnan(cancelled[c])) << id;
        const auto [tilted, tilted_frame] = normal_of(0.9f, false);
        EXPECT_NE(tilted, tilted_frame) << id;
        EXPECT_TRUE(std::isnan(normal_of(std::nanf(""), false).first[0])) << id;
    }
}

/// Gradients of 1e18 a unit, whose products of four overflow in floats, say the same directions.
TEST(NormalMap, HasNoScale) {
    Random random(10);
    const Plane plane = random_plane(random);
    const Map map = make_map(
        4, 4, 4, [](int x, int y, int c) { return 0.5f + 0.1f * float((x + 2 * y + c) % 4); },
        plain_sampler());
    for (const char* id : {"normal-map", "normal-smooth-mcguire"}) {
        Batch<float> ordinary = facet_batch(plane, plane.normal, 0.1f, random);
        ordinary.bind(TextureSlot::normal, map.sampled);
        for (const int power : {-60, 60, 2}) {
            Batch<float> scaled = ordinary;
            for (int lane = 0; lane < scaled.lanes; ++lane)
                for (int c = 0; c < 6; ++c)
                    scaled.real(Value::J, lane, c) *= std::ldexp(1.0f, power);
            Batch<float> expected = ordinary;
            expected.run(id);
            scaled.run(id);
            EXPECT_TRUE(same_bits<float>(scaled, expected, values(Value::N))) << id << power;
            EXPECT_NE(scaled.vector3(Value::N, 0), scaled.vector3(Value::frame_normal, 0));
        }
    }
}

// ---- normal-smooth-mcguire ----------------------------------------------------------------------

/// The mean of two texels: the normal at the hit and the one that lies downhill.
testing::AssertionResult smooths_downhill(Planted planted) {
    // Texels alternate along u; those that lean towards +u, and the ones behind them.
    const dvec3 leans = normalize(dvec3(1, 0, 0.001)), next = normalize(dvec3(0.2, 0.6, 0.7)),
                before = normalize(dvec3(-0.5, 0.1, 0.9));
    Map map = make_map(
        8, 8, 4,
        [&](int x, int, int c) {
            const dvec3& t = x == 4 ? leans : x > 4 ? next : before;
            return c < 3 ? static_cast<float>(0.5 + 0.5 * t[c]) : 1.0f;
        },
        plain_sampler());
    map.sampled.sampler.mag = map.sampled.sampler.min = Filter::nearest;
    Random random(4);
    Plane plane = random_plane(random);
    plane.dPdv = cross(plane.normal, plane.dPdu);
    Batch<float> batch = facet_batch(plane, plane.normal, 0.1f, random, 4);
    batch.bind(TextureSlot::normal, map.sampled);
    for (int lane = 0; lane < batch.lanes; ++lane)
        batch.set(Value::hit_uv, lane, dvec2(4.5 / 8, 0.5));
    batch.run("normal-smooth-mcguire", {{"distance", 1}});
    const dvec3 other = planted == Planted::second_look_up_uphill ? before : next;
    const dvec3 t = normalize(leans + other), u = normalize(plane.dPdu);
    const dvec3 v = normalize(plane.dPdv);
    const double error = largest_error(batch, u * t.x + v * t.y + plane.normal * t.z);
    return error < 1e-5 ? testing::AssertionSuccess() : testing::AssertionFailure() << error;
}

TEST(NormalSmoothMcGuire, AddsTheNormalDownhill) {
    EXPECT_TRUE(smooths_downhill(Planted::none));
    EXPECT_FALSE(smooths_downhill(Planted::second_look_up_uphill));
}

// ---- bump-blinn ---------------------------------------------------------------------------------

/// Quads on planes, exact in double, over heights that are linear in uv: the normal of gradients
/// that N is orthogonal to (the oblique split), wherever N leans.
testing::AssertionResult blinn_tilts(int differences, double gain) {
    const dvec2 slope(0.5, -0.25);
    const Map map = height_map(32, 32, [](int x, int y) {
        return static_cast<float>(x) / 64 + 0.5f - static_cast<float>(y) / 128;
    });
    for (int i = 0; i < 100; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Plane plane = random_plane(random);
        plane.uv0 = dvec2(0.5, 0.5);
        const dvec3 N = leaning(plane, random, 0.3);
        Batch<double> batch(4);
        batch.material.depth = 0.25f;
        batch.bind(TextureSlot::height, map.sampled);
        const double down = random.chance(0.5) ? 1 : -1;
        for (int lane = 0; lane < 4; ++lane) {
            const dvec3 P = on_plane(plane, dvec2(lane % 2, lane / 2 * down), 1.0 / 10000);
            batch.set(Value::P, lane, P);
            batch.set(Value::uv, lane, plane.uv(P));
            batch.set(Value::hit_uv, lane, plane.uv(P));
            batch.set(Value::frame_normal, lane, N);
            batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
        }
        batch.run("differentiate");
        batch.run("bump-blinn", {{"differences", differences}});
        const auto J = ExactJacobian::from_edges(plane.dPdu, plane.dPdv, {1, 0}, {0, 1});
        const dvec3 g = (J.grad_u * slope.x + J.grad_v * slope.y) * (0.25 * gain);
        const dvec3 oblique = g - plane.normal * (dot(g, N) / dot(plane.normal, N));
        const double error = length(dvec3(batch.vector3(Value::N, 0)) - normalize(N - oblique));
        if (!(error < 1e-8)) return testing::AssertionFailure() << i << ": off by " << error;
    }
    return testing::AssertionSuccess();
}

TEST(BumpBlinn, TiltsByTheGradientAcrossTheNormal) {
    for (const int differences : {0, 1}) {
        EXPECT_TRUE(blinn_tilts(differences, 1)) << differences;
        EXPECT_FALSE(blinn_tilts(differences, -1)) << differences;
    }
}

/// Differences of the quad: both lanes of a row share one. Three fetches: each lane has its own.
TEST(BumpBlinn, QuadsShareTheirDifferences) {
    StageInputs inputs(9, SlotsBound::not_baked);
    Batch<float>& quad = inputs.batch;
    for (int lane = 0; lane < quad.lanes; ++lane)
        quad.set(Value::frame_normal, lane, quad.vector3(Value::frame_normal, lane / 4 * 4));
    for (const Value v : {Value::dPdx, Value::dPdy})
        for (int lane = 0; lane < quad.lanes; ++lane)
            quad.set(v, lane, quad.vector3(v, lane / 4 * 4));
    Batch<float> three = quad;
    quad.frame.derivatives = DerivativeMode::coarse;
    quad.run("bump-blinn", {{"differences", 0}});
    three.run("bump-blinn", {{"differences", 1}});
    int differ = 0;
    for (int lane = 0; lane < quad.lanes; ++lane) {
        const int first = lane / 4 * 4;
        if (quad.integer(Value::frame_status, lane) != quad.integer(Value::frame_status, first))
            continue;
        EXPECT_EQ(quad.vector3(Value::N, lane), quad.vector3(Value::N, first));
        differ += three.vector3(Value::N, lane) != three.vector3(Value::N, first);
    }
    EXPECT_GT(differ, quad.lanes / 2);
}

/// The same quads with lengths in units of 2^-power, stretched along one axis, over steep heights.
Batch<float> stretched_quads(const Map& map, int power) {
    Random random(3);
    Batch<float> batch(64);
    const float unit = std::ldexp(1.0f, power);
    batch.material.depth = unit / 64;
    batch.bind(TextureSlot::height, map.sampled);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.set(Value::dPdx, lane, dvec3(8192.0 * unit, unit / 4, 0));
        batch.set(Value::dPdy, lane, dvec3(0, unit, unit / 8));
        batch.set(Value::dUVdx, lane, dvec2(1.0 / 64, 0));
        batch.set(Value::dUVdy, lane, dvec2(0, 1.0 / 64));
        batch.set(Value::hit_uv, lane, dvec2(random.uniform(0, 1), random.uniform(0, 1)));
        batch.set(Value::frame_normal, lane, dvec3(0, 0.6f, 0.8f));
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
    }
    return batch;
}

/// Neither 4e-12 units a pixel nor 4e12 change a bit.
testing::AssertionResult blinn_has_no_scale(const StageUnderTest<float>& stage) {
    Random random(4);
    const Map map =
        height_map(16, 16, [&](int, int) { return static_cast<float>(random.uniform(-5e5, 5e5)); });
    Batch<float> one = stretched_quads(map, 0);
    stage.run(one);
    for (const int power : {-60, -38, 38}) {
        Batch<float> other = stretched_quads(map, power);
        stage.run(other);
        const auto same = same_bits(one, other, std::array{Value::N});
        if (!same) return testing::AssertionFailure() << same.message() << ", 2^" << power;
    }
    for (int lane = 0; lane < one.lanes; ++lane) {
        const double size = length(dvec3(one.vector3(Value::N, lane)));
        if (!(std::abs(size - 1) < 1e-6)) return testing::AssertionFailure() << size;
    }
    return testing::AssertionSuccess();
}

/// As it was: products of three lengths in the units of the world.
void blinn_without_scaling(Batch<float>& batch, const Parameters& parameters) {
    batch.run("bump-blinn", parameters);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const vec3<float> N = batch.vector3(Value::frame_normal, lane);
        const vec3<float> px = batch.vector3(Value::dPdx, lane);
        const float det = dot(px, cross(batch.vector3(Value::dPdy, lane), N));
        if (!(det * det > 0)) batch.set(Value::N, lane, N * std::numeric_limits<float>::infinity());
    }
}

TEST(BumpBlinn, HasNoScale) {
    EXPECT_TRUE(blinn_has_no_scale({"bump-blinn"}));
    EXPECT_FALSE(blinn_has_no_scale({"bump-blinn", {}, {}, blinn_without_scaling}));
}

// ---- bump-noise ---------------------------------------------------------------------------------

testing::AssertionResult noise_tilts(double gain) {
    for (int i = 0; i < 20; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Plane plane = random_plane(random);
        Batch<float> batch = facet_batch(plane, plane.normal, 0.1f, random);
        batch.run("bump-noise", {{"scale", 0.25}, {"height", 0.05}, {"octaves", 2}});
        const auto J = ExactJacobian::from_edges(plane.dPdu, plane.dPdv, {1, 0}, {0, 1});
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const dvec2 uv(batch.vector2(Value::hit_uv, lane));
            const dvec2 slope = noise_field(uv, 4, 2).gradient * (0.05 * gain);
            const dvec3 n = normalize(plane.normal - J.grad_u * slope.x - J.grad_v * slope.y);
            const double error = length(dvec3(batch.vector3(Value::N, lane)) - n);
            if (!(error < 1e-4)) return testing::AssertionFailure() << i << ": off by " << error;
        }
    }
    return testing::AssertionSuccess();
}

TEST(BumpNoise, TiltsByTheNoisesGradient) {
    EXPECT_TRUE(noise_tilts(1));
    EXPECT_FALSE(noise_tilts(2));
}

/// Overhead light: the listing divides 0 by 0, the correction does not ask for the light.
TEST(BumpNoise, ALightAtTheZenith) {
    Random random(5);
    Plane plane = random_plane(random);
    plane.normal = {0, 0, 1};
    plane.dPdu = {1, 0, 0};
    plane.dPdv = {0, 1, 0};
    Batch<float> batch = facet_batch(plane, plane.normal, 0.1f, random);
    LightUniforms& light = batch.frame.lights[0];
    light.directional = 1;
    for (int c = 0; c < 3; ++c) light.position[c] = c == 2 ? 1.0f : 0.0f;
    Batch<float> published = batch;
    batch.run("bump-noise");
    published.run("bump-noise@published");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        EXPECT_NEAR(length(batch.vector3(Value::N, lane)), 1, 1e-6);
        const auto n = published.vector3(Value::N, lane);
        EXPECT_NE(n.z, n.z);
    }
}

}  // namespace
}  // namespace quadrel::test
