// The stages around the algorithms: interpolation, differences, level of detail, displacement, and
// those that do nothing.
#include "relief/triangle.hpp"

namespace quadrel::test {
namespace {

using Stage = StageUnderTest<float>;

Stage after(const char* id, void (*change)(Batch<float>&, int)) {
    return {
        id, {}, [change](Batch<float>& b) { each_lane(b, [&](int lane) { change(b, lane); }); }};
}

// ---- interpolate --------------------------------------------------------------------------------

template <int size>
bool within(const vec<size, float>& value, const Interpolated<size>& exact) {
    for (int c = 0; c < size; ++c) {
        if (!(std::abs(value[c] - exact.value[c]) <= exact.error[c])) return false;
    }
    return true;
}

/// Every varying within the bound of interpolation.hpp, the barycentrics those of the position.
testing::AssertionResult varyings_are_exact(const Stage& stage) {
    for (int i = 0; i < 100; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Triangle t = random_triangle(random, 0.3);
        Batch<float> batch(64);
        fill_quads_of(batch, t, random);
        stage.run(batch);
        const std::array<vec3<float>, 3> units = {vec3<float>(1, 0, 0), vec3<float>(0, 1, 0),
                                                  vec3<float>(0, 0, 1)};
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const auto exact = [&](const auto& attribute) {
                return interpolate_exactly(batch, lane, t, attribute);
            };
            if (within(batch.vector3(Value::P, lane), exact(t.P)) &&
                within(batch.vector3(Value::vertex_normal, lane), exact(t.normal)) &&
                within(batch.vector2(Value::uv, lane), exact(t.uv)) &&
                within(batch.vector3(Value::bary, lane), exact(units)) &&
                batch.vector3(Value::Ng, lane) == vec3<float>(t.face_normal())) {
                continue;
            }
            return testing::AssertionFailure() << "triangle " << i << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(Interpolate, VaryingsAreExact) {
    EXPECT_TRUE(varyings_are_exact({"interpolate"}));
    EXPECT_FALSE(varyings_are_exact(after("interpolate", [](Batch<float>& b, int lane) {
        std::swap(b.real(Value::bary, lane, 0), b.real(Value::bary, lane, 1));
    })));
    EXPECT_FALSE(varyings_are_exact(after("interpolate", [](Batch<float>& b, int lane) {
        b.set(Value::vertex_normal, lane, b.vector3(Value::P, lane));
    })));
}

// ---- differentiate ------------------------------------------------------------------------------

/// Coarse: one difference per quad, of its first row and column; fine: one per row and column.
testing::AssertionResult differences_are(const Stage& stage, DerivativeMode mode) {
    Random random(2);
    Batch<float> batch;
    fill_quads(batch, random);
    batch.frame.derivatives = mode;
    stage.run(batch);
    const bool fine = mode == DerivativeMode::fine;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const int first = lane & ~3, row = first + (fine ? lane & 2 : 0);
        const int column = first + (fine ? lane & 1 : 0);
        const auto of = [&](Value v, int a, int b) {
            return batch.vector3(v, b) - batch.vector3(v, a);
        };
        const auto uv = [&](int a, int b) {
            return batch.vector2(Value::uv, b) - batch.vector2(Value::uv, a);
        };
        if (batch.vector3(Value::dPdx, lane) == of(Value::P, row, row + 1) &&
            batch.vector3(Value::dPdy, lane) == of(Value::P, column, column + 2) &&
            batch.vector2(Value::dUVdx, lane) == uv(row, row + 1) &&
            batch.vector2(Value::dUVdy, lane) == uv(column, column + 2)) {
            continue;
        }
        return testing::AssertionFailure() << "lane " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(Differentiate, TakesTheDifferencesOfTheMode) {
    const Stage always_coarse = {
        "differentiate", [](Batch<float>& b) { b.frame.derivatives = DerivativeMode::coarse; }};
    EXPECT_TRUE(differences_are({"differentiate"}, DerivativeMode::fine));
    EXPECT_TRUE(differences_are({"differentiate"}, DerivativeMode::coarse));
    EXPECT_FALSE(differences_are(always_coarse, DerivativeMode::fine));
}

// ---- lod ----------------------------------------------------------------------------------------

/// A footprint of 2^k texels: lambda is k, the level k within the chain.
testing::AssertionResult levels_follow_the_footprint(const Stage& stage, TextureSlot slot) {
    Random random(3);
    SamplerState trilinear;
    const Map map = make_map(
        64, 64, 1, [](int, int, int) { return 0.5f; }, trilinear);
    const Map decoy = make_map(
        16, 16, 4, [](int, int, int) { return 0.5f; }, trilinear);
    for (int k = -3; k <= 9; ++k) {
        const double footprint = std::ldexp(1.0, k);
        Batch<float> batch(16);
        each_lane(batch, [&](int lane) {
            batch.set(Value::dUVdx, lane, dvec2(footprint / 64, 0));
            batch.set(Value::dUVdy, lane, dvec2(0, footprint / 128));
        });
        if (slot == TextureSlot::height) batch.bind(TextureSlot::color, decoy.sampled);
        batch.bind(slot, map.sampled);
        stage.run(batch);
        const int level = std::clamp(k, 0, 6);
        if (batch.real(Value::lod_rho, 0) == static_cast<float>(footprint) &&
            batch.real(Value::lod_lambda, 0) == static_cast<float>(k) &&
            batch.real(Value::lod_level, 0) == static_cast<float>(level) &&
            batch.real(Value::lod_frac, 0) == 0) {
            continue;
        }
        return testing::AssertionFailure() << "a footprint of 2^" << k << " texels";
    }
    return testing::AssertionSuccess();
}

TEST(LevelOfDetail, FollowsTheFootprint) {
    EXPECT_TRUE(levels_follow_the_footprint({"lod"}, TextureSlot::height));
    EXPECT_TRUE(levels_follow_the_footprint({"lod"}, TextureSlot::color));
    const auto unclamped = [](Batch<float>& b, int lane) {
        b.real(Value::lod_level, lane) = b.real(Value::lod_lambda, lane);
    };
    EXPECT_FALSE(levels_follow_the_footprint(after("lod", unclamped), TextureSlot::height));
}

// ---- Tangents of frame-gram ---------------------------------------------------------------------

/// T and B are the unit directions of growing u and v, mirrored and sheared maps included.
testing::AssertionResult tangents_follow_the_map(const Stage& stage) {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const Plane plane = random_plane(random);
        if (dot(plane.normal, normalize(-plane.origin)) < 0.3) continue;
        Batch<float> batch(16);
        for (int quad = 0; quad < 4; ++quad) {
            Random lean(1);
            fill_quad(batch, quad, plane, lean, 0, 0.02);
        }
        batch.run("differentiate");
        stage.run(batch);
        const dvec3 T(batch.vector3(Value::T, 0)), B(batch.vector3(Value::B, 0));
        if (length(T - normalize(plane.dPdu)) < 1e-3 && length(B - normalize(plane.dPdv)) < 1e-3) {
            continue;
        }
        return testing::AssertionFailure() << "plane " << i;
    }
    return testing::AssertionSuccess();
}

TEST(FrameGram, TangentsFollowTheMap) {
    EXPECT_TRUE(tangents_follow_the_map({"frame-gram"}));
    EXPECT_FALSE(tangents_follow_the_map({"frame-thesis"}));
}

// ---- displace -----------------------------------------------------------------------------------

/// On the view ray, and hit.depth below the polygon along the frame's normal.
testing::AssertionResult hits_lie_on_the_view_ray(const Stage& stage) {
    Random random(5);
    Batch<float> batch;
    fill_quads(batch, random);
    batch.run("differentiate");
    batch.run("frame-gram");
    each_lane(batch, [&](int lane) {
        batch.real(Value::hit_depth, lane) = static_cast<float>(random.uniform(-0.2, 0.2));
    });
    stage.run(batch);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        if (batch.integer(Value::frame_status, lane) != static_cast<int>(Status::hit)) continue;
        const dvec3 P(batch.vector3(Value::P, lane)), hit(batch.vector3(Value::hit_P, lane));
        const dvec3 N(batch.vector3(Value::frame_normal, lane));
        const double moved = length(hit - P), scale = length(P) + moved;
        const double aside = length(cross(hit - P, normalize(P)));
        const double depth_error = std::abs(dot(P - hit, N) - batch.real(Value::hit_depth, lane));
        if (aside <= 1e-6 * scale && depth_error <= 1e-6 * scale) continue;
        return testing::AssertionFailure() << "lane " << lane << ": " << depth_error;
    }
    return testing::AssertionSuccess();
}

TEST(Displace, HitsLieOnTheViewRay) {
    EXPECT_TRUE(hits_lie_on_the_view_ray({"displace"}));
    EXPECT_FALSE(hits_lie_on_the_view_ray(
        {"displace",
         [](Batch<float>& b) {
             each_lane(b, [&](int lane) { b.real(Value::hit_depth, lane) *= -1; });
         },
         [](Batch<float>& b) {
             each_lane(b, [&](int lane) { b.real(Value::hit_depth, lane) *= -1; });
         }}));
}

// ---- Stages that do nothing ---------------------------------------------------------------------

TEST(TraceNone, StaysOnThePolygon) {
    Random random(6);
    Batch<float> batch;
    fill_quads(batch, random);
    batch.run("frame-none");
    batch.material.seat = 0.75f;
    batch.run("trace-none");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        EXPECT_EQ(batch.vector2(Value::hit_uv, lane), batch.vector2(Value::uv, lane));
        EXPECT_EQ(batch.real(Value::hit_s, lane), 0.25f);
        EXPECT_EQ(batch.real(Value::hit_h, lane), 0.75f);
        EXPECT_EQ(batch.real(Value::hit_depth, lane), 0);
        EXPECT_EQ(batch.integer(Value::hit_status, lane), static_cast<int>(Status::hit));
        EXPECT_EQ(batch.integer(Value::hit_fetches, lane), 0);
    }
}

TEST(FrameNone, IsTheNormalOnTheViewersSide) {
    Random random(7);
    Batch<float> batch;
    fill_quads(batch, random, 0.1);
    each_lane(batch, [&](int lane) {
        if (lane / 4 % 2 == 0) return;
        for (const Value v : {Value::Ng, Value::vertex_normal}) {
            batch.set(v, lane, -batch.vector3(v, lane));
        }
    });
    batch.run("frame-none");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const auto vertex = normalize(batch.vector3(Value::vertex_normal, lane));
        const float side = lane / 4 % 2 == 0 ? 1.0f : -1.0f;
        EXPECT_EQ(batch.vector3(Value::frame_normal, lane), vertex * side);
        EXPECT_EQ(batch.vector2(Value::K, lane), vec2<float>(0));
        EXPECT_EQ(batch.real(Value::r, lane), 1);
    }
}

/// Under an orthographic eye every lane looks along the same direction.
TEST(FrameGram, OrthographicEyesHaveOneDirection) {
    Random random(8);
    const Plane plane = random_plane(random);
    Batch<float> batch(16);
    for (int quad = 0; quad < 4; ++quad) fill_quad(batch, quad, plane, random, 0);
    batch.frame.orthographic = 1;
    const dvec3 eye = normalize(plane.normal + dvec3(0.1, 0.2, 0.3));
    for (int c = 0; c < 3; ++c) batch.frame.eye[c] = static_cast<float>(eye[c]);
    batch.run("differentiate");
    batch.run("frame-gram");
    for (int lane = 0; lane < 16; ++lane) {
        EXPECT_NEAR(batch.real(Value::r, lane), dot(eye, plane.normal), 1e-6);
    }
}

}  // namespace
}  // namespace quadrel::test
