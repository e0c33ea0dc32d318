// The relief's depth: in tiles of the texture, and faded at grazing angles.
#include "quadrel/scene/load.hpp"
#include "relief/frame/frame_support.hpp"
#include "scene/degrees.hpp"
#include "scene/support.hpp"

namespace quadrel::test {
namespace {

using Depth = StageUnderTest<float>;

/// depth-graded, or with an error.
Depth graded(Planted planted = Planted::none) {
    Depth depth{"depth-graded"};
    switch (planted) {
        case Planted::tile_of_the_u_axis:
            depth.after = [](Batch<float>& b) {
                each_lane(b, [&](int lane) {
                    b.real(Value::relief_depth, lane) =
                        b.material.depth / length(b.vector3(Value::face_J, lane));
                });
            };
            break;
        case Planted::fade_upside_down:
            depth.before = [](Batch<float>& b) { b.material.fade_from = 2 * b.material.fade_from; };
            break;
        case Planted::back_faces_kept:
            depth.before = [](Batch<float>& b) {
                each_lane(b, [&](int lane) { b.set(Value::Ng, lane, -b.vector3(Value::P, lane)); });
            };
            break;
        default:
            break;
    }
    return depth;
}

/// A batch on one plane, seen from the front.
Batch<float> on(const Plane& plane) {
    Batch<float> batch(16);
    each_lane(batch, [&](int lane) {
        batch.set(Value::P, lane, plane.origin);
        batch.set(Value::Ng, lane, plane.normal);
        batch.set(Value::vertex_normal, lane, plane.normal * 1.7);
        set_plane_frame(batch, lane, plane);
    });
    return batch;
}

TEST(DepthConstant, IsTheMaterials) {
    Batch<float> batch(16);
    batch.own_depth = true;
    batch.material.depth = 0.3f;
    batch.run("depth-constant");
    each_lane(batch, [&](int lane) { EXPECT_EQ(batch.real(Value::relief_depth, lane), 0.3f); });
}

// ---- In tiles -----------------------------------------------------------------------------------

/// depth * root of the unit square's area, whatever the shape of the tile.
testing::AssertionResult counts_in_tiles(const Depth& stage) {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Plane plane = random_plane(random);
        Batch<float> batch = on(plane);
        batch.material.depth = static_cast<float>(random.uniform(0.01, 1));
        batch.material.depth_in_tiles = 1;
        stage.run(batch);
        const double tile = std::sqrt(length(cross(plane.dPdu, plane.dPdv)));
        const double ratio = batch.real(Value::relief_depth, 5) / (batch.material.depth * tile);
        if (!(std::abs(ratio - 1) < 1e-5)) return testing::AssertionFailure() << "times " << ratio;
    }
    return testing::AssertionSuccess();
}

TEST(DepthGraded, CountsInTiles) {
    EXPECT_TRUE(counts_in_tiles(graded()));
    EXPECT_FALSE(counts_in_tiles(graded(Planted::tile_of_the_u_axis)));
}

TEST(DepthGraded, DegenerateMapsHaveNoDepth) {
    Random random(4);
    Batch<float> batch = on(random_plane(random));
    batch.material.depth = 0.2f;
    batch.material.depth_in_tiles = 1;
    each_lane(batch, [&](int lane) {
        for (int c = 3; c < 6; ++c) batch.real(Value::face_J, lane, c) = 0;
    });
    batch.run("depth-graded");
    EXPECT_EQ(batch.real(Value::relief_depth, 0), 0);
}

// ---- Fading -------------------------------------------------------------------------------------

/// The depth on a plane whose normal is `degrees` from the view vector.
float depth_at(const Depth& stage, double degrees, double from, double to, bool back = false) {
    const auto angle = sin_cos_degrees(degrees);
    Plane plane;
    plane.origin = dvec3(0, 0, -2);
    plane.normal = dvec3(angle.sine, 0, angle.cosine);
    plane.dPdu = dvec3(0, 1, 0);
    plane.dPdv = cross(plane.normal, plane.dPdu);
    if (back) plane.normal = -plane.normal;
    Batch<float> batch = on(plane);
    batch.material.depth = 0.8f;
    batch.material.fade_from = static_cast<float>(sin_cos_degrees(from).cosine);
    batch.material.fade_to = static_cast<float>(sin_cos_degrees(to).cosine);
    stage.run(batch);
    return batch.real(Value::relief_depth, 3);
}

/// Whole up to `from`, none from `to` on, linear in the cosine between, back faces alike.
testing::AssertionResult fades(const Depth& stage) {
    for (const auto& [from, to] : {std::pair{40.0, 80.0}, {0.0, 90.0}, {75.0, 76.0}}) {
        const double whole = sin_cos_degrees(from).cosine, none = sin_cos_degrees(to).cosine;
        for (double degrees = 0; degrees < 89.5; degrees += 0.5) {
            for (const bool back : {false, true}) {
                const double cosine = sin_cos_degrees(degrees).cosine;
                const double part = std::clamp((cosine - none) / (whole - none), 0.0, 1.0);
                const double depth = depth_at(stage, degrees, from, to, back);
                if (std::abs(depth - 0.8 * part) < 1e-5) continue;
                return testing::AssertionFailure() << depth << " at " << degrees;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(DepthGraded, FadesBetweenTheAngles) {
    EXPECT_TRUE(fades(graded()));
    EXPECT_FALSE(fades(graded(Planted::fade_upside_down)));
    EXPECT_FALSE(fades(graded(Planted::back_faces_kept)));
}

TEST(DepthGraded, DoesNotFadeUnlessAsked) {
    EXPECT_EQ(depth_at(graded(), 89, 90, 90), 0.8f);
    EXPECT_EQ(depth_at(graded(), 10, 40, 80), 0.8f);
    EXPECT_EQ(depth_at(graded(), 85, 40, 80), 0.0f);
}

/// The faded depth is what frames multiply by: half of the depth, half of K.
TEST(DepthGraded, ReachesTheShift) {
    Random random(6);
    Batch<float> batch(16);
    for (int quad = 0; quad < 4; ++quad) fill_quad(batch, quad, random_plane(random), random);
    batch.own_depth = true;
    batch.run("differentiate");
    const auto K_with = [&](float depth) {
        each_lane(batch, [&](int lane) { batch.real(Value::relief_depth, lane) = depth; });
        batch.run("frame-gram");
        return batch.vector2(Value::K, 0);
    };
    const auto whole = K_with(0.5f), half = K_with(0.25f);
    EXPECT_EQ(half, whole * 0.5f);
}

// ---- The keys -----------------------------------------------------------------------------------

Material material_of(const std::string& relief) {
    const TemporaryFolder folder;
    return load_scene(
               folder.write("s.json", R"({"quadrel": 1, "material": {"relief": )" + relief + "}}"))
        .materials[0];
}

TEST(DepthKeys, AreRead) {
    const Material tiles = material_of(R"({"depth": {"thickness": 0.02, "tile": 2}})");
    EXPECT_TRUE(tiles.depth_in_tiles);
    EXPECT_EQ(tiles.depth, 0.01f);
    EXPECT_FALSE(material_of(R"({"depth": 0.02})").depth_in_tiles);
    const Material faded = material_of(R"({"grazing_fade": [60, 85]})");
    EXPECT_EQ(faded.fade_from, 60);
    EXPECT_EQ(faded.fade_to, 85);
}

TEST(DepthKeys, MistakesAreTheUsers) {
    for (const char* relief :
         {R"({"depth": {"thickness": 0.02}})", R"({"depth": {"tile": 2}})",
          R"({"depth": {"thickness": -1, "tile": 2}})", R"({"depth": {"thickness": 1, "tile": 0}})",
          R"({"depth": {"thickness": 1, "tile": 2, "height": 3}})", R"({"grazing_fade": [85, 60]})",
          R"({"grazing_fade": [60, 60]})", R"({"grazing_fade": [60, 91]})",
          R"({"grazing_fade": [-1, 60]})", R"({"grazing_fade": 60})"})
        EXPECT_THROW(material_of(relief), InputError) << relief;
}

}  // namespace
}  // namespace quadrel::test
