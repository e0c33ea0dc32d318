// What the published self-shadows and the normal of steep parallax mapping store is what their
// listings compute, from the vertices' light vector to the last look-up.
#include "relief/tangent_listings.hpp"

namespace quadrel::test::tangent {
namespace {

/// texture2D of a map in a loop: lanes that do not ask keep their last coordinate.
Vec4 texture2D(Batch<float>& batch, TextureSlot slot, const Vec2& uv) {
    return quadrel::texture(*batch.bound(slot), SampleContext<Float>(), uv);
}

void set_lanes(Batch<float>& batch, Value v, int quad, const Float& x, int component = 0) {
    for (int i = 0; i < 4; ++i) batch.real(v, 4 * quad + i, component) = x.lane[i];
}

// ---- "Steep Parallax Mapping" (McGuire and McGuire), the page's shader --------------------------

/// The march of the view, over made-up steps, which leaves its end in the batch.
struct Steep {
    Vec2 offsetCoord;
    Vec4 NB;

    Steep(Batch<float>& batch, int quad, Random& random) {
        // float height = 1.0;   vec2 offsetCoord = texCoord.xy;
        Float height(1.0f), step, looked_up(1.0f);
        offsetCoord = lanes2(batch, Value::uv, quad);
        Vec2 delta;
        const dvec2 way(random.uniform(-0.04, 0.04), random.uniform(-0.04, 0.04));
        for (int i = 0; i < 4; ++i) {
            step.lane[i] = static_cast<float>(1 / random.uniform(3, 8));
            for (int c = 0; c < 2; ++c)
                delta[c].lane[i] = static_cast<float>(way[c] * random.uniform(0.7, 1.3));
        }
        // vec4 NB = texture2D(normalBumpMap, offsetCoord);
        NB = texture2D(batch, TextureSlot::normal, offsetCoord);
        // while (NB.a < height) {
        for (auto inside = NB.a < height; any(inside); inside = inside & (NB.a < height)) {
            // height -= step;
            height = select(inside, height - step, height);
            // offsetCoord += delta;
            offsetCoord = select(inside, offsetCoord + delta, offsetCoord);
            // NB = texture2D(normalBumpMap, offsetCoord);
            NB = select(inside, texture2D(batch, TextureSlot::normal, offsetCoord), NB);
            looked_up = select(inside, looked_up + Float(1.0f), looked_up);
        }
        set_lanes(batch, Value::hit_h, quad, NB.a);
        for (int c = 0; c < 2; ++c) set_lanes(batch, Value::hit_uv, quad, offsetCoord[c], c);
        for (int i = 0; i < 4; ++i)
            batch.integer(Value::hit_steps, 4 * quad + i) = static_cast<int>(looked_up.lane[i]);
    }

    // vec3 tsN = NB.xyz * 2 - 1;
    Vec3 tsN() const { return Vec3(NB) * Float(2.0f) - Vec3(Float(1.0f)); }
};

struct SelfShadow {
    Float NdotL, selfShadow;
};

SelfShadow mcguire_shadow(Batch<float>& batch, int quad, const Steep& view, const Flaws& flaws,
                          float bumpScale) {
    // tsL = normalize(tsL);
    const Vec3 tsL = normalize(mcguire_light(batch, quad, flaws));
    // const float NdotL = max(0, dot(tsN, tsL));
    const Float NdotL = max(Float(0.0f), dot(view.tsN(), tsL));
    // const int numShadowSteps = mix(60,5,tsL.z);
    const Float numShadowSteps = trunc(mix(Float(60.0f), Float(5.0f), tsL.z));
    // step = 1.0 / numShadowSteps;
    const Float step = Float(1.0f) / numShadowSteps;
    // delta = vec2(tsL.x, -tsL.y) * bumpScale / (numShadowSteps * tsL.z);
    const Vec2 delta = Vec2(tsL.x, -tsL.y) * Float(bumpScale) / (numShadowSteps * tsL.z);
    // height = NB.a + step * 0.1;
    Float NB = view.NB.a, height = NB + step * Float(0.1f);
    Vec2 offsetCoord = view.offsetCoord;
    // if (NdotL > 0) {
    const auto lit = NdotL > Float(0.0f);
    // while ((NB.a < height) && (height < 1)) {
    auto inside = lit & (NB < height) & (height < Float(1.0f));
    for (; any(inside); inside = inside & (NB < height) & (height < Float(1.0f))) {
        // height += step;
        height = select(inside, height + step, height);
        // offsetCoord += delta;
        offsetCoord = select(inside, offsetCoord + delta, offsetCoord);
        // NB = texture2D(normalBumpMap, offsetCoord);
        NB = select(inside, texture2D(batch, TextureSlot::normal, offsetCoord).a, NB);
    }
    // selfShadow = (NB.a < height);
    return {NdotL, select(lit & (NB < height), Float(1.0f), Float(0.0f))};
}

/// The numbers x, y, z of N = x T + y B + z F for what the stage is to store: the page's y is
/// against B.
Vec3 along_frame(Batch<float>& batch, int quad, const Vec3& tsN) {
    return lanes3(batch, Value::T, quad) * tsN.x - lanes3(batch, Value::B, quad) * tsN.y +
           lanes3(batch, Value::frame_normal, quad) * tsN.z;
}

struct Planted {
    Flaws flaws{};
    const char *surface = "normal-mcguire@published", *shadow = "shadow-march-mcguire@published";
    bool final_footprint = false;  ///< the normal's neighbours are where they ended
    float bump_scale = 0.08f;
};

testing::AssertionResult mcguire_equals(const Planted& planted, int batches = 8) {
    int normals_off = 0, shadows_off = 0, dark = 0, marched = 0, lanes = 0;
    for (int seed = 0; seed < batches; ++seed) {
        Inputs inputs(seed);
        Batch<float>& batch = inputs.batch;
        Random random(static_cast<std::uint64_t>(seed) + 900);
        batch.frame.lights[0].directional = seed % 4 == 3;
        std::vector<Steep> views;
        for (int quad = 0; quad < batch.lanes / 4; ++quad) views.emplace_back(batch, quad, random);
        Batch<float> given = batch;
        if (planted.final_footprint)
            for (int lane = 0; lane < batch.lanes; ++lane)
                batch.integer(Value::hit_steps, lane) = 1;
        batch.run(planted.surface);
        Parameters scale;
        if (std::string(planted.shadow).find('@') != std::string::npos)
            scale = {{"bump_scale", planted.bump_scale}};
        batch.run(planted.shadow, scale);
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            const Steep& view = views[static_cast<std::size_t>(quad)];
            normals_off +=
                lanes_off(batch, Value::N, quad, along_frame(batch, quad, view.tsN()), 1e-3f);
            const SelfShadow expected = mcguire_shadow(given, quad, view, planted.flaws, 0.08f);
            for (int i = 0; i < 4; ++i) {
                const float found = batch.real(Value::shadow_visibility, 4 * quad + i);
                dark += expected.NdotL.lane[i] > 0 && expected.selfShadow.lane[i] == 0;
                marched += expected.NdotL.lane[i] > 0;
                if (std::abs(expected.NdotL.lane[i]) == 0 || expected.NdotL.lane[i] > 1e-3f)
                    shadows_off += found != expected.selfShadow.lane[i];
            }
        }
        lanes += batch.lanes;
    }
    EXPECT_GT(dark, lanes / 20);
    EXPECT_GT(marched - dark, lanes / 20);
    if (200 * normals_off > lanes) return testing::AssertionFailure() << normals_off << " normals";
    if (100 * shadows_off > lanes) return testing::AssertionFailure() << shadows_off << " shadows";
    return testing::AssertionSuccess();
}

TEST(SteepListing, NormalsAndShadowsAreThePages) { EXPECT_TRUE(mcguire_equals({}, 24)); }

TEST(SteepListing, ErrorsAreCaught) {
    EXPECT_FALSE(mcguire_equals({.final_footprint = true}));
    EXPECT_FALSE(mcguire_equals({.surface = "normal-map"}));
    EXPECT_FALSE(mcguire_equals({.surface = "normal-welsh@published"}));
    EXPECT_FALSE(mcguire_equals({.flaws = {.light_of_the_displaced_point = true}}));
    EXPECT_FALSE(mcguire_equals({.flaws = {.light_of_the_fragment = true}}));
    EXPECT_FALSE(mcguire_equals({.shadow = "shadow-march-mcguire"}));
    EXPECT_FALSE(mcguire_equals({.bump_scale = 0.1f}));
}

// ---- DirectX SDK, ParallaxOcclusionMapping.fx ---------------------------------------------------

/// Out.vLightTS of RenderSceneVS, interpolated. `matrix_first`: as the sample does with the view.
Vec3 dxsdk_light(Batch<float>& batch, int quad, bool matrix_first) {
    const LightUniforms& light = batch.frame.lights[0];
    const float(&m)[9] = batch.frame.eye_to_world;
    const auto to_world = [&](const One3& v) {
        return One3(dot(One3(m[0], m[1], m[2]), v), dot(One3(m[3], m[4], m[5]), v),
                    dot(One3(m[6], m[7], m[8]), v));
    };
    return varying(batch, quad, [&](const PrimitiveVertices& row, int v) {
        const auto axis = [&](const float(&a)[3]) {
            // float3 vTangentWS  = mul( vInTangentOS,  (float3x3) g_mWorld ); ... normalize
            return normalize(to_world(affine(row.to_eye, three(a), 0)));
        };
        const One3 vTangentWS = axis(row.tangent[v]), vBinormalWS = axis(row.binormal[v]);
        const One3 vNormalWS = axis(row.normal[v]);
        // float3 vLightWS = g_LightDir;   (a point's, from the vertex)
        const One3 from = affine(row.to_eye, three(row.position[v]), 1);
        const One3 vLightWS =
            to_world(light.directional ? three(light.position) : three(light.position) - from);
        if (matrix_first)
            return One3(dot(vTangentWS, vLightWS), dot(vBinormalWS, vLightWS),
                        dot(vNormalWS, vLightWS));
        // float3x3 mWorldToTangent = float3x3( vTangentWS, vBinormalWS, vNormalWS );
        // Out.vLightTS = mul( vLightWS, mWorldToTangent );
        return vTangentWS * vLightWS.x + vBinormalWS * vLightWS.y + vNormalWS * vLightWS.z;
    });
}

Float dxsdk_shadow(Batch<float>& batch, int quad, bool matrix_first) {
    // float3 vLightTS  = normalize( i.vLightTS );
    const Vec3 vLightTS = normalize(dxsdk_light(batch, quad, matrix_first));
    // float2 vLightRayTS = vLightTS.xy * g_fHeightMapScale;
    const Vec2 vLightRayTS = Vec2(vLightTS.x, vLightTS.y) * Float(batch.material.depth);
    const Vec2 texSampleBase = lanes2(batch, Value::hit_uv, quad);
    const auto tex2Dgrad = [&](const Vec2& uv) {
        return texture_grad(*batch.bound(TextureSlot::height), SampleContext<Float>(), uv,
                            lanes2(batch, Value::dUVdx, quad), lanes2(batch, Value::dUVdy, quad))
            .x;
    };
    // float sh0 =  tex2Dgrad( tNormalHeightMap, texSampleBase, dx, dy ).a;
    const Float sh0 = tex2Dgrad(texSampleBase);
    // float shA = (tex2Dgrad( ..., texSampleBase + vLightRayTS * 0.88, dx, dy ).a - sh0 - 0.88 ) *
    //     1 * g_fShadowSoftening;   ... sh4, 0.22 and 12
    const auto sh = [&](float at, float weight) {
        return (tex2Dgrad(texSampleBase + vLightRayTS * Float(at)) - sh0 - Float(at)) *
               Float(weight) * Float(0.58f);
    };
    const Float shA = sh(0.88f, 1), sh9 = sh(0.77f, 2), sh8 = sh(0.66f, 4), sh7 = sh(0.55f, 6);
    const Float sh6 = sh(0.44f, 8), sh5 = sh(0.33f, 10), sh4 = sh(0.22f, 12);
    // fOcclusionShadow = 1 - max( max( max( max( max( max( shA, sh9 ), ...
    const Float fOcclusionShadow =
        Float(1.0f) - max(max(max(max(max(max(shA, sh9), sh8), sh7), sh6), sh5), sh4);
    // fOcclusionShadow = fOcclusionShadow * 0.6 + 0.4;
    return fOcclusionShadow * Float(0.6f) + Float(0.4f);
}

testing::AssertionResult dxsdk_equals(const std::string& id, bool matrix_first) {
    int off = 0, lanes = 0;
    for (int seed = 0; seed < 16; ++seed) {
        Inputs inputs(seed);
        Batch<float>& batch = inputs.batch;
        Random random(static_cast<std::uint64_t>(seed));
        const dvec3 x = random_direction(random);
        const dvec3 y = normalize(cross(x, random_direction(random))), z = cross(x, y);
        for (int c = 0; c < 3; ++c)
            for (int row = 0; row < 3; ++row)
                batch.frame.eye_to_world[3 * row + c] = static_cast<float>((row == 0   ? x
                                                                            : row == 1 ? y
                                                                                       : z)[c]);
        batch.material.depth = 0.07f;
        batch.frame.lights[0].directional = seed % 2;
        for (int lane = 0; lane < batch.lanes; ++lane) batch.real(Value::hit_s, lane) = 0.5f;
        batch.run(id);
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            const Float expected = dxsdk_shadow(batch, quad, matrix_first);
            for (int i = 0; i < 4; ++i)
                off += batch.real(Value::shadow_visibility, 4 * quad + i) != expected.lane[i];
        }
        lanes += batch.lanes;
    }
    if (off == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << id << ": " << off << " of " << lanes;
}

TEST(DxSdkListing, TheSoftShadowIsTheSamples) {
    EXPECT_TRUE(dxsdk_equals("shadow-soft-pom@published", false));
    EXPECT_FALSE(dxsdk_equals("shadow-soft-pom@published", true));
    EXPECT_FALSE(dxsdk_equals("shadow-soft-pom", false));
}

}  // namespace
}  // namespace quadrel::test::tangent
