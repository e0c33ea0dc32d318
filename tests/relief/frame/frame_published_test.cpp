// The published frames give the bits of their listings.
#include "relief/frame/frame_listings.hpp"
#include "relief/frame/frame_support.hpp"
#include "relief/listing_runs.hpp"

namespace quadrel::test {
namespace {

listings::Varyings varyings(Batch<float>& batch, int lane) {
    return {batch.vector3(Value::P, lane),    batch.vector3(Value::dPdx, lane),
            batch.vector3(Value::dPdy, lane), batch.vector3(Value::vertex_normal, lane),
            batch.vector2(Value::uv, lane),   batch.vector2(Value::dUVdx, lane),
            batch.vector2(Value::dUVdy, lane)};
}

testing::AssertionResult equal(const char* what, float stage, float listed) {
    const bool both_nan = stage != stage && listed != listed;
    if (both_nan || std::bit_cast<std::uint32_t>(stage) == std::bit_cast<std::uint32_t>(listed))
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << what << " " << stage << " is not " << listed;
}
template <int size>
testing::AssertionResult equal(const char* what, const vec<size, float>& stage,
                               const vec<size, float>& listed) {
    for (int c = 0; c < size; ++c)
        if (const auto result = equal(what, stage[c], listed[c]); !result) return result;
    return testing::AssertionSuccess();
}

/// Vertices with axes that have nothing in common.
void set_vertices(Batch<float>& batch, Random& random) {
    const auto axes = [&] {
        return VertexAxes{random_direction(random), random_direction(random),
                          random_direction(random)};
    };
    for (int quad = 0; quad < batch.lanes / 4; ++quad)
        set_quad_vertices(batch, quad, random_direction(random) * 3.0, {axes(), axes(), axes()});
    bend_vertices(batch, random);
}

using Check = testing::AssertionResult (*)(Batch<float>&, int lane);

/// Random quads, degenerate and back-facing ones among them; `check` compares a lane of the frame
/// with the listing.
testing::AssertionResult equals_listing(const Frame& frame, Check check) {
    for (int i = 0; i < 40; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Batch<float> batch;
        batch.material.depth = i % 8 == 0 ? 0.0005f : static_cast<float>(random.uniform(0.01, 1));
        fill_quads(batch, random);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            if (lane / 4 % 8 == 1)
                batch.set(Value::vertex_normal, lane, -batch.vector3(Value::vertex_normal, lane));
            if (lane / 4 % 16 == 2) batch.set(Value::uv, lane, vec2<float>(0.5f, 0.25f));
        }
        set_vertices(batch, random);
        batch.run("differentiate");
        frame.run(batch);
        for (int lane = 0; lane < batch.lanes; ++lane)
            if (const auto result = check(batch, lane); !result)
                return testing::AssertionFailure()
                       << frame.id << ", lane " << lane << ": " << result.message();
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult as_schueler(Batch<float>& batch, int lane) {
    const auto v = varyings(batch, lane);
    const auto N = normalize(v.normal);
    const auto TBN = listings::cotangent_frame(N, v);
    if (const auto r = equal("T", batch.vector3(Value::T, lane), TBN[0]); !r) return r;
    if (const auto r = equal("B", batch.vector3(Value::B, lane), TBN[1]); !r) return r;
    // The view vector along the columns.
    const auto V = normalize(-v.position);
    const vec2<float> along(dot(V, TBN[0]), dot(V, TBN[1]));
    return equal("K", batch.vector2(Value::K, lane),
                 -(along * batch.material.depth) / dot(V, TBN[2]));
}

testing::AssertionResult as_rabbid(Batch<float>& batch, int lane) {
    listings::ParallaxMain listing;
    listing.u_displacement_scale = batch.material.depth;
    listing.main(varyings(batch, lane));
    if (const auto r = equal("T", batch.vector3(Value::T, lane), listing.tbnMat[0]); !r) return r;
    if (const auto r = equal("B", batch.vector3(Value::B, lane), listing.tbnMat[1]); !r) return r;
    return equal("K", batch.vector2(Value::K, lane), listing.texStep);
}

/// The fragment program's coordinates for a height of 1 without bias: K back from the polygon.
testing::AssertionResult as_welsh(Batch<float>& batch, int lane) {
    listings::WelshFragment listing;
    listing.texcoord3 = vertex_eye(batch, lane);
    listing.texcoord0 = {0, 0};
    listing.texel = 1;
    listing.scale = batch.material.depth;
    listing.main();
    if (const auto r = equal("V_t.z", batch.real(Value::r, lane), listing.eyevecs.z); !r) return r;
    return equal("K", batch.vector2(Value::K, lane), -listing.newtexcoord);
}

/// A frame of which one lane of a batch is a single ulp off.
Frame one_ulp_off(const char* id, Value v) {
    return {id, {}, [v](Batch<float>& batch) {
                float& x = batch.real(v, 37);
                x = std::nextafter(x, 2.0f);
            }};
}

TEST(PublishedFrames, EqualTheirListings) {
    const std::pair<const char*, Check> rows[] = {{"frame-cot@published", as_schueler},
                                                  {"frame-inverse-tbn@published", as_rabbid},
                                                  {"frame-vertex@published", as_welsh}};
    for (const auto& [id, check] : rows) {
        EXPECT_TRUE(equals_listing({id}, check));
        EXPECT_FALSE(equals_listing(one_ulp_off(id, Value::K), check)) << id;
    }
    EXPECT_FALSE(equals_listing(one_ulp_off("frame-cot@published", Value::B), as_schueler));
}

TEST(PublishedFrames, CorrectionsAreNotTheListings) {
    EXPECT_FALSE(equals_listing({"frame-cot"}, as_schueler));
    EXPECT_FALSE(equals_listing({"frame-inverse-tbn"}, as_rabbid));
    EXPECT_FALSE(equals_listing({"frame-vertex"}, as_welsh));
}

/// The whole program: what a height of h moves the coordinates by is that of the ray at that
/// height, with the seat at -bias / scale.
TEST(FrameVertexPublished, ScaleAndBiasAreDepthAndSeat) {
    Random random(2);
    Batch<float> batch(16);
    batch.material.depth = 0.04f;
    fill_quads(batch, random);
    for (int quad = 0; quad < batch.lanes / 4; ++quad)
        set_quad_vertices(batch, quad, dvec3(-0.3, 0.4, -0.5 - 0.1 * quad),
                          VertexAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    batch.run("frame-vertex@published");
    const double seat = 0.5;
    for (const float height : {0.0f, 0.3f, 1.0f}) {
        for (int lane = 0; lane < batch.lanes; ++lane) {
            listings::WelshFragment listing;
            listing.texcoord3 = vertex_eye(batch, lane);
            listing.texcoord0 = {0.25f, 0.5f};
            listing.texel = height;
            listing.scale = 0.04f;
            listing.bias = -0.02f;
            listing.main();
            const dvec2 on_ray =
                dvec2(0.25, 0.5) + dvec2(batch.vector2(Value::K, lane)) * (seat - height);
            EXPECT_LT(length(on_ray - dvec2(listing.newtexcoord)), 1e-7) << lane;
        }
    }
}

}  // namespace
}  // namespace quadrel::test
