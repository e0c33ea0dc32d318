// prism-gs@published: the bits of the listing, its geometry shader's and its fragment shader's.
#include <set>

#include "effort.hpp"
#include "quadrel/raster/interpolation.hpp"
#include "relief/shell/prism_gs_listing.hpp"
#include "relief/shell/prism_rays.hpp"
#include "render/draw/shell/prism_strips.hpp"

namespace quadrel::test {
namespace {

using listings::PrismVec2;
using listings::PrismVec3;
using listings::PrismVertex;

PrismVec3 of_glm(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// A prism of the listing and of the renderer.
struct BothPrisms {
    std::vector<std::array<PrismVertex, 3>> listed;
    std::vector<StripTriangle> emitted;
    ShadedVertices vertices;

    BothPrisms(const Mesh& mesh, float depth) {
        Material material;
        material.depth = depth;
        const ShadedVertices base = shaded(mesh);
        const PrismStrips strips(mesh, base, material, glm::mat4(1.0f));
        strips.append({}, emitted);
        vertices = strips.vertices();
        std::array<PrismVec3, 3> pos, nv;
        std::array<PrismVec2, 3> uv;
        for (std::size_t i = 0; i < 3; ++i) {
            pos[i] = of_glm(base.eye[i]);
            nv[i] = normalize(of_glm(base.normal[i]));
            uv[i] = {base.uv[i].x, base.uv[i].y};
        }
        listed = listings::prism_geometry(pos, nv, uv, depth);
    }
};

/// Planted errors.
enum class PrismGsFlaw { none, higher_fragments, base_alone, inside_out, corrected_axes };

bool same_vector(const PrismVec3& a, const PrismVec3& b) {
    for (int i = 0; i < 3; ++i)
        if (std::bit_cast<std::uint32_t>(a[i] + 0.0f) != std::bit_cast<std::uint32_t>(b[i] + 0.0f))
            return false;
    return true;
}
PrismVec3 of_row(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

TEST(PrismGsPublished, EmitsTheListingsTriangles) {
    Random random(41);
    std::set<float> sides;
    for (int i = 0; i < 200; ++i) {
        const BothPrisms both(random_prism_mesh(random), static_cast<float>(random.uniform(0, 1)));
        ASSERT_EQ(both.emitted.size(), 7u);
        ASSERT_EQ(both.listed.size(), 7u);
        for (std::size_t t = 0; t < 7; ++t)
            for (std::size_t v = 0; v < 3; ++v) {
                const StripTriangle& ours = both.emitted[t];
                const PrismVertex& listed = both.listed[t][v];
                const auto& row = ours.varyings;
                EXPECT_TRUE(same_vector(of_glm(both.vertices.eye[ours.index[v]]), listed.pos));
                EXPECT_TRUE(same_vector(of_row(row.nv[v]), listed.nv));
                EXPECT_TRUE(same_vector(of_row(row.tv[v]), listed.tv));
                EXPECT_TRUE(same_vector(of_row(row.bv[v]), listed.bv));
                EXPECT_EQ(row.height[v], listed.uvh.z);
                if (t == 0) continue;
                EXPECT_EQ(row.side[v], listed.d.z);
                sides.insert(listed.d.z);
            }
    }
    EXPECT_EQ(sides.size(), 2u) << "front and back sides";
}

/// Fragments all over the prisms' triangles, some beside them as helper lanes are.
struct PrismFragments {
    Map heights;
    Batch<float> batch;
    std::vector<std::array<PrismVertex, 3>> listed;  ///< a quad each
    std::vector<bool> front;

    explicit PrismFragments(std::uint64_t seed) {
        Random random(seed * 31 + 5);
        heights = height_map(
            5 + random.below(20), 5 + random.below(20),
            [&](int, int) { return static_cast<float>(random.uniform(0, 1)); }, Wrap::repeat);
        batch.material.depth = static_cast<float>(random.uniform(0.02, 0.6));
        if (random.chance(0.05)) batch.material.depth = 0.0005f;
        batch.material.seat = 0;
        batch.primitives.resize(static_cast<std::size_t>(batch.lanes / 4));
        batch.vertices.resize(batch.primitives.size());
        batch.bind(TextureSlot::height, heights.sampled);
        for (int quad = 0; quad < batch.lanes / 4; ++quad) add_quad(quad, random);
    }

    PrismVertex fragment(int lane) {
        const auto q = static_cast<std::size_t>(lane / 4);
        const auto edge = [&](int i) { return batch.edges[i][static_cast<std::size_t>(lane)]; };
        const auto& w = batch.primitives[q].w;
        const auto b = perspective_barycentrics(EdgeValues<float>{edge(0), edge(1), edge(2)},
                                                PerVertex<float>{w[0], w[1], w[2]});
        const auto& v = listed[q];
        const auto of = [&](auto member) {
            return interpolate(b, PerVertex<PrismVec3>{v[0].*member, v[1].*member, v[2].*member});
        };
        PrismVertex in{of(&PrismVertex::pos), of(&PrismVertex::nv),  of(&PrismVertex::tv),
                       of(&PrismVertex::bv),  of(&PrismVertex::uvh), {}};
        for (int i = 0; i < 4; ++i)
            in.d[i] = interpolate(b, PerVertex<float>{v[0].d[i], v[1].d[i], v[2].d[i]});
        return in;
    }

  private:
    void add_quad(int quad, Random& random) {
        const auto q = static_cast<std::size_t>(quad);
        const BothPrisms both(random_prism_mesh(random), batch.material.depth);
        const auto t = static_cast<std::size_t>(random.below(7));
        listed.push_back(both.listed[t]);
        AssembledTriangle piece = whole_piece();
        piece.screen.front_facing = random.chance(0.6);
        front.push_back(piece.screen.front_facing);
        batch.vertices[q] = strip_row(both.emitted[t], piece);
        batch.primitives[q] = {};
        for (float& w : batch.primitives[q].w) w = static_cast<float>(random.uniform(0.5, 4));
        for (int lane = 4 * quad; lane < 4 * quad + 4; ++lane) {
            const auto l = static_cast<std::size_t>(lane);
            const double least = random.chance(0.1) ? -0.3 : 0;
            double a = random.uniform(least, 1), b = random.uniform(least, 1 - a);
            if (random.chance(0.1)) a = 0;
            batch.edges[0][l] = a;
            batch.edges[1][l] = b;
            batch.edges[2][l] = 1 - a - b;
            batch.primitive[l] = quad;
            const PrismVertex in = fragment(lane);
            batch.set(Value::P, lane, in.pos);
            batch.set(Value::uv, lane, PrismVec2(in.uvh.x, in.uvh.y));
            batch.set(Value::vertex_normal, lane, normalize(in.nv));
        }
    }
};

testing::AssertionResult gives_the_listings_bits(PrismGsFlaw flaw, int batches,
                                                 std::set<std::string>* reached = nullptr) {
    for (int i = 0; i < batches; ++i) {
        PrismFragments fragments(static_cast<std::uint64_t>(i));
        Batch<float>& batch = fragments.batch;
        for (PrimitiveVertices& row : batch.vertices) {
            auto strip = std::bit_cast<PrismStrip>(row);
            if (flaw == PrismGsFlaw::inside_out)
                for (float& side : strip.side) side = -side;
            if (flaw == PrismGsFlaw::corrected_axes)
                for (auto& tangent : strip.tv)
                    for (float& x : tangent) x *= 2;
            if (flaw == PrismGsFlaw::base_alone)
                for (float& height : strip.height) height = 0;
            row = std::bit_cast<PrimitiveVertices>(strip);
        }
        batch.run("frame-prism@published");
        batch.run("prism-gs@published", {{"quality_normal", 0.35}, {"quality_grazing", 1}});
        batch.run("displace-prism@published");
        const SampledTexture& map = fragments.heights.sampled;
        for (int lane = 0; lane < batch.lanes; ++lane) {
            listings::PrismFragment listing;
            listing.u_parallax_quality = {0.35f, 1.0f};
            listing.u_displacement_scale = batch.material.depth;
            const GeneralHeight<Quad<float>> height(map, lod_from_level(map, Quad<float>(0)));
            listing.u_displacement_map = [&](const PrismVec2& uv) {
                return height({}, vec2<Quad<float>>(Quad<float>(uv.x), Quad<float>(uv.y))).lane[0];
            };
            PrismVertex in = fragments.fragment(lane);
            if (flaw == PrismGsFlaw::higher_fragments) in.uvh.z *= 1.05f;
            const bool front = fragments.front[static_cast<std::size_t>(lane / 4)];
            const auto end = listing.main(in, front);
            const bool clipped = batch.integer(Value::hit_status, lane) == int(Status::clip);
            const PrismVec3 at(batch.real(Value::hit_uv, lane, 0),
                               batch.real(Value::hit_uv, lane, 1), batch.real(Value::hit_h, lane));
            const bool nan = at.x != at.x || end.newTexCoords.x != end.newTexCoords.x;
            const bool equal =
                nan ? at.x != at.x && end.newTexCoords.x != end.newTexCoords.x
                    : same_vector(at, end.newTexCoords) &&
                          same_vector(batch.vector3(Value::hit_P, lane), end.view_pos_displ);
            if (!equal || clipped != end.discarded ||
                batch.integer(Value::hit_fetches, lane) != end.fetches)
                return testing::AssertionFailure()
                       << "batch " << i << ", lane " << lane << ": " << at.x << " " << at.y << " "
                       << at.z << " for " << end.newTexCoords.x << " " << end.newTexCoords.y << " "
                       << end.newTexCoords.z << ", discarded " << clipped << " for "
                       << end.discarded << ", fetches " << batch.integer(Value::hit_fetches, lane)
                       << " for " << end.fetches;
            if (reached == nullptr) continue;
            const bool side = in.uvh.z > 0.0001f;
            reached->insert(side ? (in.d.z > 0 ? "front side" : "back side")
                                 : (front ? "base" : "base from behind"));
            if (side) reached->insert(clipped ? "discarded" : "kept");
            if (end.fetches == 0) reached->insert("not displaced");
        }
    }
    return testing::AssertionSuccess();
}

TEST(PrismGsPublished, GivesTheListingsBits) {
    std::set<std::string> reached;
    EXPECT_TRUE(gives_the_listings_bits(PrismGsFlaw::none, rounds(40), &reached));
    EXPECT_GE(reached.size(), sanitized ? 5u : 7u) << testing::PrintToString(reached);
    for (const PrismGsFlaw flaw : {PrismGsFlaw::higher_fragments, PrismGsFlaw::base_alone,
                                   PrismGsFlaw::inside_out, PrismGsFlaw::corrected_axes})
        EXPECT_FALSE(gives_the_listings_bits(flaw, 4)) << static_cast<int>(flaw);
}

}  // namespace
}  // namespace quadrel::test
