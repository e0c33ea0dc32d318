// What multilayer@published and normal-layers@published store is what their listing computes, from
// the vector of its vertex shader to the normal that it lights.
#include "relief/tangent_listings.hpp"

namespace quadrel::test::tangent {
namespace {

/// Errors planted in the listing.
struct ListingFlaws {
    bool at_the_surface = false;  ///< the ray starts at the UV
    bool full_depth = false;      ///< no depth bias
    bool one_step_more = false;
    bool from_the_top = false;  ///< seen from behind, too
    bool green_up = false;
    bool fronts_only = false;
};

/// quad_depth_relief_mapping. Above each line of code stands the line that it transcribes.
struct QuadDepth {
    Batch<float>& batch;
    int quad, linear_search_steps, binary_search_steps;
    float depth;
    ListingFlaws flaws{};
    int fetches = 0;

    Vec4 tex2D(TextureSlot slot, const Vec2& uv) {
        return quadrel::texture(*batch.bound(slot), SampleContext<Float>(), uv);
    }
    Vec4 quad_depth_map(const Vec3& s) {
        ++fetches;
        return tex2D(TextureSlot::layers, Vec2(s.x, s.y));
    }

    /// view_space, the vertex shader.
    Vec3 IN_eye() const {
        return varying(batch, quad, [](const PrimitiveVertices& row, int v) {
            // float3 tangent = mul(modelviewrot, IN.tangent.xyz); and the like
            const One3 tangent = affine(row.to_eye, three(row.tangent[v]), 0);
            const One3 binormal = affine(row.to_eye, three(row.binormal[v]), 0);
            const One3 normal = affine(row.to_eye, three(row.normal[v]), 0);
            // float3 vpos = mul(UNITY_MATRIX_MV, pos).xyz;
            const One3 vpos = affine(row.to_eye, three(row.position[v]), 1);
            // float3 eye = mul(tangentspace, vpos);
            One3 eye(dot(tangent, vpos), dot(binormal, vpos), dot(normal, vpos));
            // eye.z = -eye.z;
            eye.z = -eye.z;
            return eye;
        });
    }

    Float product(const Vec3& s) {
        // float4 t = tex2D(quad_depth_map, s.xy);
        const Vec4 t = quad_depth_map(s);
        // float4 d = s.z - t;
        Vec4 d(s.z - t.x, s.z - t.y, s.z - t.z, s.z - t.w);
        // d.xy *= d.zw;
        d.x = d.x * d.z;
        d.y = d.y * d.w;
        // d.x *= d.y;
        d.x = d.x * d.y;
        return d.x;
    }
    // void ray_intersect_rmqd_linear(quad_depth_map, inout s, inout ds)
    void ray_intersect_rmqd_linear(Vec3& s, Vec3& ds) {
        // ds /= linear_search_steps;
        ds = ds / Float(static_cast<float>(linear_search_steps));
        // for (int i = 0; i < linear_search_steps - 1; i++)
        for (int i = 0; i < linear_search_steps - (flaws.one_step_more ? 0 : 1); i++) {
            const Float d_x = product(s);
            // if (d.x > 0) s += ds;
            s = select(d_x > Float(0.0f), s + ds, s);
        }
    }
    // void ray_intersect_rmqd_binary(quad_depth_map, inout s, inout ds)
    void ray_intersect_rmqd_binary(Vec3& s, Vec3& ds) {
        // float3 ss = sign(ds.z);
        Vec3 ss(sign(ds.z));
        // for (int i = 0; i < binary_search_steps; i++)
        for (int i = 0; i < binary_search_steps; i++) {
            // ds *= 0.5;
            ds = ds * Float(0.5f);
            const Float d_x = product(s);
            // if (d.x < 0) { ss = s; s -= 2 * ds; }
            const auto inside = d_x < Float(0.0f);
            ss = select(inside, s, ss);
            s = select(inside, s - Float(2.0f) * ds, s);
            // s += ds;
            s = s + ds;
        }
        // s = ss;
        s = ss;
    }

    /// relief_map_quad_depth, up to the intersection.
    Vec3 position() {
        // float3 v = normalize(IN.eye);
        Vec3 v = normalize(IN_eye());
        // float3 s = float3(IN.texcoord, 0);
        const Vec2 texcoord = lanes2(batch, Value::uv, quad);
        Vec3 s(texcoord.x, texcoord.y, Float(0.0f));
        // float dir = v.z;
        const Float dir = v.z;
        // v.z = abs(v.z);
        v.z = abs(v.z);
        // float d = depth * (2 * v.z - v.z * v.z);
        const Float d =
            flaws.full_depth ? Float(depth) : Float(depth) * (Float(2.0f) * v.z - v.z * v.z);
        // v /= v.z;
        v = v / v.z;
        // v.xy *= d;
        v = Vec3(v.x * d, v.y * d, v.z);
        // s.xy -= v.xy * 0.5;
        if (!flaws.at_the_surface) s = Vec3(s.x - v.x * Float(0.5f), s.y - v.y * Float(0.5f), s.z);
        // if (dir < 0) { s.z = 0.996; v.z = -v.z; }
        const auto behind = dir < Float(flaws.from_the_top ? -2.0f : 0.0f);
        s.z = select(behind, Float(0.996f), s.z);
        v.z = select(behind, -v.z, v.z);
        // ray_intersect_rmqd_linear(quad_depth_map, s, v);
        ray_intersect_rmqd_linear(s, v);
        // ray_intersect_rmqd_binary(quad_depth_map, s, v);
        ray_intersect_rmqd_binary(s, v);
        return s;
    }

    // if (s.z > 0.997) discard;   if (s.z < 0.003) discard;
    static bool discards(float z) { return z > 0.997f || z < 0.003f; }

    /// Its normal at s, in tangent space.
    Vec3 normal(const Vec3& s) {
        const Vec2 xy(s.x, s.y);
        // float4 t = tex2D(quad_depth_map, s.xy);
        const Vec4 t = tex2D(TextureSlot::layers, xy);
        // float4 nx = tex2D(normal_map_x, s.xy);   float4 ny = tex2D(normal_map_y, s.xy);
        const Vec4 nx = tex2D(TextureSlot::layer_normals_x, xy);
        const Vec4 ny = tex2D(TextureSlot::layer_normals_y, xy);
        Vec3 result;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto lane = [i](const Float& x) { return x.lane[i]; };
            const auto component = [&](const Vec4& v, int m) { return lane(v[m]); };
            // float4 z = abs(s.z - t);
            const auto z = [&](int m) { return std::abs(lane(s.z) - component(t, m)); };
            // int m = 0;   if (z.y < z.x) m = 1;
            int m = 0;
            if (z(1) < z(0) && !flaws.fronts_only) m = 1;
            // if (z.z < z[m]) m = 2;
            if (z(2) < z(m)) m = 2;
            // if (z.w < z[m]) m = 3;
            if (z(3) < z(m) && !flaws.fronts_only) m = 3;
            // n.x = nx[m];   n.y = 1 - ny[m];
            float x = component(nx, m);
            float y = flaws.green_up ? component(ny, m) : 1.0f - component(ny, m);
            // n.xy = n.xy * 2 - 1;
            x = x * 2.0f - 1.0f;
            y = y * 2.0f - 1.0f;
            // n.z = sqrt(max(0, 1.0 - dot(n.xy, n.xy)));
            const float rest = 1.0f - (x * x + y * y);
            float n_z = std::sqrt(rest > 0 ? rest : 0.0f);
            // if (m == 1 || m == 3) n.z = -n.z;
            if (m == 1 || m == 3) n_z = -n_z;
            result.x.lane[i] = x;
            result.y.lane[i] = y;
            result.z.lane[i] = n_z;
        }
        return result;
    }
};

/// Thin solids, inside out in places, and their normals.
struct LayerInputs : Inputs {
    Map layers, x, y;

    explicit LayerInputs(int seed) : Inputs(seed) {
        Random random(static_cast<std::uint64_t>(seed) + 99);
        const Map wobble = mip_map(random, 4);
        layers = make_map(
            64, 64, 4,
            [&](int column, int row, int c) {
                const auto w = [&](int channel) {
                    return wobble.sampled.view.texels[4 * (64 * row + column) + channel];
                };
                const int front = c / 2 * 2;
                const float depth = 0.2f + 0.2f * static_cast<float>(front) + 0.2f * w(front);
                return c == front ? depth : depth + 0.15f * (w(c) - 0.4f);
            },
            wobble.sampled.sampler);
        x = mip_map(random, 4);
        y = mip_map(random, 4);
        batch.bind(TextureSlot::layers, layers.sampled);
        batch.bind(TextureSlot::layer_normals_x, x.sampled);
        batch.bind(TextureSlot::layer_normals_y, y.sampled);
    }
};

bool same_float(float a, float b) {
    return a != a ? b != b : std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

struct SearchCase {
    std::string id = "multilayer@published";
    int steps = 10, halvings = 5;
    float scale = 0.1f;
    ListingFlaws flaws{};
};

/// Place, status and number of look-ups of every fragment are the listing's.
testing::AssertionResult search_equals(const SearchCase& search) {
    int hits = 0, misses = 0;
    for (int seed = 0; seed < 8; ++seed) {
        LayerInputs inputs(seed);
        Batch<float>& batch = inputs.batch;
        Parameters parameters{{"steps", search.steps}, {"binary_steps", search.halvings}};
        if (search.id == "multilayer@published") parameters["scale"] = search.scale;
        batch.run(search.id, parameters);
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            QuadDepth listing{batch,           quad,         search.steps,
                              search.halvings, search.scale, search.flaws};
            const Vec3 s = listing.position();
            for (int i = 0; i < 4; ++i) {
                const int lane = 4 * quad + i;
                const float z = s.z.lane[i];
                const Status status = QuadDepth::discards(z) ? Status::clip : Status::hit;
                const bool equal =
                    same_float(batch.real(Value::hit_s, lane), z) &&
                    same_float(batch.real(Value::hit_uv, lane, 0), s.x.lane[i]) &&
                    same_float(batch.real(Value::hit_uv, lane, 1), s.y.lane[i]) &&
                    batch.integer(Value::hit_fetches, lane) == listing.fetches &&
                    batch.integer(Value::hit_status, lane) == static_cast<int>(status);
                if (!equal)
                    return testing::AssertionFailure()
                           << search.id << ", seed " << seed << ", lane " << lane << ": "
                           << batch.real(Value::hit_s, lane) << " for " << z;
                ++(status == Status::hit ? hits : misses);
            }
        }
    }
    if (hits < 100 || misses < 20)
        return testing::AssertionFailure() << hits << " hits, " << misses << " misses";
    return testing::AssertionSuccess();
}

TEST(LayersPublished, TheSearchIsTheListing) {
    EXPECT_TRUE(search_equals({}));
    EXPECT_TRUE(search_equals({.steps = 30, .scale = -0.3f}));
    EXPECT_FALSE(search_equals({.id = "multilayer"}));
    EXPECT_FALSE(search_equals({.flaws = {.at_the_surface = true}}));
    EXPECT_FALSE(search_equals({.flaws = {.full_depth = true}}));
    EXPECT_FALSE(search_equals({.flaws = {.one_step_more = true}}));
    EXPECT_FALSE(search_equals({.flaws = {.from_the_top = true}}));
}

/// The normal at the places where the search has ended.
testing::AssertionResult normal_equals(const std::string& id, const ListingFlaws& flaws = {}) {
    for (int seed = 0; seed < 4; ++seed) {
        LayerInputs inputs(seed);
        Batch<float>& batch = inputs.batch;
        batch.run("multilayer@published");
        batch.run(id);
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            QuadDepth listing{batch, quad, 10, 5, 0.1f, flaws};
            const Vec3 n = listing.normal({lanes(batch, Value::hit_uv, quad, 0),
                                           lanes(batch, Value::hit_uv, quad, 1),
                                           lanes(batch, Value::hit_s, quad)});
            const Vec3 N = lanes3(batch, Value::T, quad) * n.x +
                           lanes3(batch, Value::B, quad) * n.y +
                           lanes3(batch, Value::frame_normal, quad) * n.z;
            if (lanes_off(batch, Value::N, quad, N, 0) > 0)
                return testing::AssertionFailure() << id << ", quad " << quad;
        }
    }
    return testing::AssertionSuccess();
}

TEST(LayersPublished, TheNormalIsTheListings) {
    EXPECT_TRUE(normal_equals("normal-layers@published"));
    EXPECT_FALSE(normal_equals("normal-layers"));
    EXPECT_FALSE(normal_equals("normal-layers@published", {.green_up = true}));
    EXPECT_FALSE(normal_equals("normal-layers@published", {.fronts_only = true}));
}

// ---- The corrected normal -----------------------------------------------------------------------

/// Maps of the normals that the layers themselves have at this depth over square texture space.
struct MadeNormals {
    Map x, y;

    MadeNormals(const SampledTexture& layers, float depth, bool lost_back) {
        const TextureView& view = layers.view;
        const int width = view.width[0], height = view.height[0];
        const auto at = [&](int i, int j, int c) {
            const int column = (i + width) % width, row = (j + height) % height;
            return view.texels[view.offset[0] + (row * width + column) * 4 + c];
        };
        const auto component = [&](int i, int j, int c, bool of_x) {
            const auto side = static_cast<float>(of_x ? width : height);
            const float slope =
                0.5f * side * depth *
                (of_x ? at(i + 1, j, c) - at(i - 1, j, c) : at(i, j + 1, c) - at(i, j - 1, c));
            const float other =
                0.5f * static_cast<float>(of_x ? height : width) * depth *
                (of_x ? at(i, j + 1, c) - at(i, j - 1, c) : at(i + 1, j, c) - at(i - 1, j, c));
            const float sign = c % 2 == 1 && !lost_back ? -1.0f : 1.0f;
            return 0.5f + 0.5f * sign * slope / std::sqrt(1 + slope * slope + other * other);
        };
        x = make_map(
            width, height, 4, [&](int i, int j, int c) { return component(i, j, c, true); },
            layers.sampler);
        y = make_map(
            width, height, 4, [&](int i, int j, int c) { return component(i, j, c, false); },
            layers.sampler);
    }
};

/// Of gentle layers, maps made of their slopes give the normals that the slopes have.
testing::AssertionResult maps_give_the_slopes(bool lost_back) {
    const Map layers = make_map(
        32, 32, 4,
        [](int i, int j, int c) {
            const auto wave = [](int k) { return std::abs(static_cast<float>(k - 16)) / 16; };
            return 0.1f + 0.2f * static_cast<float>(c) + 0.05f * wave(i) - 0.04f * wave(j);
        },
        plain_sampler());
    Random random(8);
    Batch<float> batch(64);
    fill_surface(batch, random, {.least_r = 0.3, .depth = 0.25});
    const MadeNormals normals(layers.sampled, batch.material.depth, lost_back);
    batch.bind(TextureSlot::layers, layers.sampled);
    batch.bind(TextureSlot::layer_normals_x, normals.x.sampled);
    batch.bind(TextureSlot::layer_normals_y, normals.y.sampled);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.set(Value::hit_uv, lane,
                  dvec2((random.below(13) + 2) / 32.0 + 1 / 64.0,
                        (random.below(13) + 18) / 32.0 + 1 / 64.0));
        const int layer = static_cast<int>(random.below(4));
        batch.real(Value::hit_s, lane) = 0.1f + 0.2f * static_cast<float>(layer);
        // Rays that come from outside: backs, whose slopes are -0.1 and -0.08, are met from below.
        batch.set(Value::K, lane, layer % 2 == 1 ? dvec2(-10) : dvec2(0));
    }
    Batch<float> slopes = batch;
    slopes.run("h2n-layers");
    batch.run("normal-layers");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const dvec3 found(batch.vector3(Value::N, lane)), expected(slopes.vector3(Value::N, lane));
        if (length(found - expected) > 1e-3)
            return testing::AssertionFailure()
                   << "lane " << lane << ": " << length(found - expected);
    }
    return testing::AssertionSuccess();
}

TEST(NormalLayers, MapsOfSlopesGiveTheirNormals) {
    EXPECT_TRUE(maps_give_the_slopes(false));
    EXPECT_FALSE(maps_give_the_slopes(true));
}

TEST(NormalLayers, WithoutMapsTheNormalIsTheFrames) {
    LayerInputs inputs(2);
    inputs.batch.unbind(TextureSlot::layer_normals_y);
    for (const char* id : {"normal-layers", "normal-layers@published"}) {
        inputs.batch.run("multilayer@published");
        inputs.batch.run(id);
        for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
            EXPECT_EQ(inputs.batch.vector3(Value::N, lane),
                      inputs.batch.vector3(Value::frame_normal, lane));
        }
    }
}

}  // namespace
}  // namespace quadrel::test::tangent
