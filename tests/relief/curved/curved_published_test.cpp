// curved-quadric@published stores what its listing computes, from the vector of its vertex shader
// to the place that it looks up.
#include "effort.hpp"
#include "relief/listing_runs.hpp"

namespace quadrel::test {
namespace {

/// Relief_Correct_Silhouettes. Above each line of code stands the line that it transcribes.
struct CorrectSilhouettes {
    int linear_search_steps = 40, binary_search_steps = 8;
    float Depth = 0.1f, Tile = 4, Curvature = 1;
    bool second_of_y = false;  ///< an error: the curvature along y instead of z
    bool exact_way = false;    ///< another: no 0.001 at its end

    static Vec3 view(const Batch<float>& batch, int lane) {
        return interpolated(batch, lane, [](const PrimitiveVertices& row, int v) {
            const Vec3 binormal = as_vector(row.binormal[v]);
            // float3 osEyeVec = _ObjectSpaceCameraPos - In.vertex.xyz;
            const Vec3 osEyeVec = Vec3(0, 0, 0) - as_vector(row.position[v]);
            // tangentspace[0] = In.tangent.xyz;   [1] = -In_binormal;   [2] = In.normal;
            // Out.view = mul(tangentspace, osEyeVec);
            return Vec3(dot(as_vector(row.tangent[v]), osEyeVec), dot(-binormal, osEyeVec),
                        dot(as_vector(row.normal[v]), osEyeVec));
        });
    }

    static Vec3 ray_position(float t, const Vec2& tx, const Vec3& v, float dataz) {
        // float3 r = v * t;
        Vec3 r = v * t;
        // r.z -= t * t * dataz;
        r.z -= t * t * dataz;
        // r.xy += tx;
        r.x += tx.x;
        r.y += tx.y;
        return r;
    }

    float ray_intersect_rm_curved(const std::function<float(const Vec3&)>& depth, const Vec2& tx,
                                  const Vec3& v, float tmax, float dataz) const {
        // float t = 0.0;
        float t = 0.0f;
        // float size = (tmax + 0.001) / linear_search_steps;
        float size = (tmax + (exact_way ? 0.0f : 0.001f)) / static_cast<float>(linear_search_steps);
        // for (int i = 0; i < linear_search_steps; i++)
        for (int i = 0; i < linear_search_steps; i++) {
            // float3 p = ray_position(t, tx, v, dataz);
            const Vec3 p = ray_position(t, tx, v, dataz);
            // float4 tex = tex2D(reliefmap, p.xy);   if (p.z < tex.w) t += size;
            if (p.z < depth(p)) t += size;
        }
        // for (int i = 0; i < binary_search_steps; i++)
        for (int i = 0; i < binary_search_steps; i++) {
            // size *= 0.5;
            size *= 0.5f;
            // float3 p = ray_position(t, tx, v, dataz);
            const Vec3 p = ray_position(t, tx, v, dataz);
            // float4 tex = tex2D(reliefmap, p.xy);   if (p.z < tex.w) t += 2 * size;
            if (p.z < depth(p)) t += 2 * size;
            // t -= size;
            t -= size;
        }
        return t;
    }

    End main_relief(const Vec3& IN_view, const Vec2& texcoord, const Sampler& heights) const {
        End end;
        const auto depth = [&](const Vec3& p) {
            end.map = heights(Vec2(p.x, p.y));
            ++end.fetches;
            return 1.0f - end.map;
        };
        // float3 v = normalize(IN.view);
        Vec3 v = normalize(IN_view);
        // Out.scale = float3(In.tangent.w, 1, _Depth) / _Tile;
        const Vec3 scale(-1.0f / Tile, 1.0f / Tile, Depth / Tile);
        // float3 mapping = 1.0 / IN.scale;
        const Vec3 mapping(1.0f / scale.x, 1.0f / scale.y, 1.0f / scale.z);
        // float dataz = IN.curvature.x * v.x * v.x + IN.curvature.y * v.z * v.z;
        const float other = second_of_y ? v.y : v.z;
        float dataz = Curvature * v.x * v.x + Curvature * other * other;
        // dataz = sign(dataz) * max(abs(dataz), 0.001);
        dataz = sign(dataz) * max(std::abs(dataz), 0.001f);
        // float d = v.z * v.z - 4 * dataz * IN.scale.z;
        float d = v.z * v.z - 4 * dataz * scale.z;
        // float tmax = 50;
        float tmax = 50;
        // if (d > 0) tmax = min(tmax, (-v.z + sqrt(d)) / (-2 * dataz));
        if (d > 0) tmax = min(tmax, (-v.z + std::sqrt(d)) / (-2 * dataz));
        // d = v.z / dataz;   if (d > 0) tmax = min(tmax, d);
        d = v.z / dataz;
        if (d > 0) tmax = min(tmax, d);
        // v *= mapping;   dataz *= mapping.z;
        v = Vec3(v.x * mapping.x, v.y * mapping.y, v.z * mapping.z);
        dataz *= mapping.z;
        // float t = ray_intersect_rm_curved(_ReliefMap, IN.texcoord, v, tmax, dataz);
        const float t = ray_intersect_rm_curved(depth, texcoord, v, tmax, dataz);
        // float3 p = ray_position(t, IN.texcoord, v, dataz);
        const Vec3 p = ray_position(t, texcoord, v, dataz);
        end.uv = {p.x, p.y};
        end.s = p.z;
        return end;
    }
};

Listing silhouettes(const CorrectSilhouettes& shader) {
    const auto run = [shader](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& sampler) {
            const int lane = 4 * quad + i;
            return shader.main_relief(CorrectSilhouettes::view(b, lane), b.vector2(Value::uv, lane),
                                      sampler);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    return {"curved-quadric@published",
            run,
            {{"steps", shader.linear_search_steps},
             {"binary_steps", shader.binary_search_steps},
             {"scale", shader.Depth},
             {"tile", shader.Tile},
             {"curvature", shader.Curvature}}};
}

/// With vectors along which the listing's branches go all ways.
TEST(CurvedPublished, TheSearchIsTheListing) {
    for (const float curvature : {1.0f, -0.5f, 20.0f, 0.0f}) {
        CorrectSilhouettes shader{12, 5, 0.2f, 1.5f, curvature};
        const Listing listing = silhouettes(shader);
        EXPECT_TRUE(equals_listing(listing, {listing.id}, rounds(8))) << curvature;
    }
    const Listing listing = silhouettes({});
    EXPECT_TRUE(equals_listing(listing, {listing.id}, 1));
    for (const Planted planted : {Planted::one_sample_early, Planted::steps_counted_once})
        EXPECT_FALSE(equals_listing(listing, flawed(listing.id, planted), 1));
    EXPECT_TRUE(notices_the_ray(listing));
    const Listing of_y = silhouettes({.second_of_y = true}),
                  exact = silhouettes({.exact_way = true});
    EXPECT_FALSE(equals_listing(of_y, {of_y.id}, 4));
    EXPECT_FALSE(equals_listing(exact, {exact.id}, 4));
}

/// A ray over a convex quadric that comes out at the top misses; over a flat one none does.
TEST(CurvedPublished, RaysLeaveConvexSurfaces) {
    Inputs inputs(3);
    const auto misses = [&](double curvature) {
        Batch<float> batch = inputs.batch;
        const Map low = flat_map(0.1f);
        batch.bind(TextureSlot::height, low.sampled);
        batch.run("curved-quadric@published", {{"curvature", curvature}, {"scale", 1}});
        int count = 0;
        for (int lane = 0; lane < batch.lanes; ++lane)
            count += batch.integer(Value::hit_status, lane) == static_cast<int>(Status::clip);
        return count;
    };
    EXPECT_GT(misses(10), misses(0.1) + 8);
}

}  // namespace
}  // namespace quadrel::test
