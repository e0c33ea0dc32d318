// The published normals give the bits of their listings. A Float is the four fragments of a quad,
// so that texture(), dFdx() and dFdy() see their neighbours; all else is one fragment at a time.
#include "quadrel/relief/noise.hpp"
#include "relief/listing_runs.hpp"
#include "relief/planted.hpp"
#include "relief/stage_inputs.hpp"

namespace quadrel::test {
namespace {

using Float = Quad<float>;
using Vec2 = vec2<Float>;
using Vec3 = vec3<Float>;
using Vec4 = vec4<Float>;

Float lanes(Batch<float>& batch, Value v, int quad, int component) {
    return load<Float>(&batch.real(v, 4 * quad, component));
}
Vec2 lanes2(Batch<float>& batch, Value v, int quad) {
    return {lanes(batch, v, quad, 0), lanes(batch, v, quad, 1)};
}
Vec3 lanes3(Batch<float>& batch, Value v, int quad, int first = 0) {
    return {lanes(batch, v, quad, first), lanes(batch, v, quad, first + 1),
            lanes(batch, v, quad, first + 2)};
}

// ---- "Normal, Parallax and Relief mapping" (Rabbid76) -------------------------------------------

enum class Version { gather, taps, sobel };

/// main, as far as the normal depends on it, and CalculateNormal in its three versions.
struct Rabbid {
    // uniform sampler2D u_displacement_map;
    const SampledTexture* u_displacement_map;
    // uniform float u_displacement_scale;
    Float u_displacement_scale;
    Vec3 objPosEs, objNormalEs;
    Vec2 uv;         ///< the fragment's
    Vec2 texCoords;  ///< after Parallax
    bool facing[4];  ///< gl_FrontFacing

    Float h(const Vec2& at) const {
        return quadrel::texture(*u_displacement_map, SampleContext<Float>(), at).x;
    }
    Vec2 texOffs() const {
        // vec2 texOffs = 1.0 / textureSize( u_displacement_map, 0 ).xy;
        const auto size = texture_size(*u_displacement_map, 0);
        return Vec2(Float(1.0f)) /
               Vec2(Float(static_cast<float>(size.x)), Float(static_cast<float>(size.y)));
    }
    static Vec2 two(float x, float y) { return {Float(x), Float(y)}; }

    Vec3 tilted(const Vec2& deltaH) const {
        // vec2 scale = u_displacement_scale / texOffs;
        const Vec2 scale = Vec2(u_displacement_scale) / texOffs();
        // return vec4( normalize( vec3( deltaH * scale, 1.0 ) ), h_mid );
        return normalize(Vec3(deltaH * scale, Float(1.0f)));
    }

    Vec3 with_gather() const {
        // vec4 heights = textureGather( u_displacement_map, texCoords, 0 );
        const Vec4 heights = texture_gather(*u_displacement_map, SampleContext<Float>(), texCoords);
        const auto four = [](float x, float y, float z, float w) {
            return Vec4(Float(x), Float(y), Float(z), Float(w));
        };
        // vec2 deltaH = vec2(dot(heights, vec4(1.0, -1.0, -1.0, 1.0)),
        //                    dot(heights, vec4(-1.0, -1.0, 1.0, 1.0)));
        return tilted({dot(heights, four(1, -1, -1, 1)), dot(heights, four(-1, -1, 1, 1))});
    }
    Vec3 with_taps() const {
        // float h_xa = texture( u_displacement_map, texCoords.st + texOffs * vec2(-1.0, 0.0) ).r;
        const Float h_xa = h(texCoords + texOffs() * two(-1, 0));
        // float h_xb = texture( u_displacement_map, texCoords.st + texOffs * vec2( 1.0, 0.0) ).r;
        const Float h_xb = h(texCoords + texOffs() * two(1, 0));
        // float h_ya = texture( u_displacement_map, texCoords.st + texOffs * vec2( 0.0, -1.0) ).r;
        const Float h_ya = h(texCoords + texOffs() * two(0, -1));
        // float h_yb = texture( u_displacement_map, texCoords.st + texOffs * vec2( 0.0, 1.0) ).r;
        const Float h_yb = h(texCoords + texOffs() * two(0, 1));
        // vec2 deltaH = vec2(h_xa-h_xb, h_ya-h_yb);
        return tilted({h_xa - h_xb, h_ya - h_yb});
    }
    Vec3 with_sobel() const {
        Float hx[9];
        // hx[0] = texture( u_displacement_map, texCoords.st + texOffs * vec2(-1.0, -1.0) ).r;
        hx[0] = h(texCoords + texOffs() * two(-1, -1));
        // hx[1] ... vec2( 0.0, -1.0);  hx[2] ... vec2( 1.0, -1.0);  hx[3] ... vec2(-1.0, 0.0)
        hx[1] = h(texCoords + texOffs() * two(0, -1));
        hx[2] = h(texCoords + texOffs() * two(1, -1));
        hx[3] = h(texCoords + texOffs() * two(-1, 0));
        // hx[4] = texture( u_displacement_map, texCoords.st ).r;   (h_mid alone)
        // hx[5] ... vec2( 1.0, 0.0);  hx[6] ... vec2(-1.0, 1.0);  hx[7] ... vec2( 0.0, 1.0)
        hx[5] = h(texCoords + texOffs() * two(1, 0));
        hx[6] = h(texCoords + texOffs() * two(-1, 1));
        hx[7] = h(texCoords + texOffs() * two(0, 1));
        // hx[8] ... vec2( 1.0, 1.0)
        hx[8] = h(texCoords + texOffs() * two(1, 1));
        // vec2 deltaH = vec2(hx[0]-hx[2] + 2.0*(hx[3]-hx[5]) + hx[6]-hx[8],
        //                    hx[0]-hx[6] + 2.0*(hx[1]-hx[7]) + hx[2]-hx[8]);
        return tilted({hx[0] - hx[2] + 2.0f * (hx[3] - hx[5]) + hx[6] - hx[8],
                       hx[0] - hx[6] + 2.0f * (hx[1] - hx[7]) + hx[2] - hx[8]});
    }

    Vec3 main(Version version) const {
        // vec3 N = normalize( objNormalEs );
        const Vec3 N = normalize(objNormalEs);
        // vec3 dp1 = dFdx( objPosEs );
        const Vec3 dp1 = dFdx(objPosEs);
        // vec3 dp2 = dFdy( objPosEs );
        const Vec3 dp2 = dFdy(objPosEs);
        // vec2 duv1 = dFdx( texCoords );
        const Vec2 duv1 = dFdx(uv);
        // vec2 duv2 = dFdy( texCoords );
        const Vec2 duv2 = dFdy(uv);
        // vec3 dp2perp = cross(dp2, N);
        const Vec3 dp2perp = cross(dp2, N);
        // vec3 dp1perp = cross(N, dp1);
        const Vec3 dp1perp = cross(N, dp1);
        // vec3 T = dp2perp * duv1.x + dp1perp * duv2.x;
        const Vec3 T = dp2perp * duv1.x + dp1perp * duv2.x;
        // vec3 B = dp2perp * duv1.y + dp1perp * duv2.y;
        const Vec3 B = dp2perp * duv1.y + dp1perp * duv2.y;
        // float invmax = inversesqrt(max(dot(T, T), dot(B, B)));
        const Float invmax = inversesqrt(max(dot(T, T), dot(B, B)));
        // mat3 tbnMat = mat3(T * invmax, B * invmax, N * u_displacement_scale);
        mat3<Float> tbnMat(T * invmax, B * invmax, N * u_displacement_scale);
        // vec4 normalVec = CalculateNormal( texCoords );
        const Vec3 normalVec = version == Version::gather ? with_gather()
                               : version == Version::taps ? with_taps()
                                                          : with_sobel();
        // tbnMat[2].xyz *= (gl_FrontFacing ? 1.0 : -1.0) * N / u_displacement_scale;
        Float sign;
        for (int i = 0; i < 4; ++i) sign.lane[i] = facing[i] ? 1.0f : -1.0f;
        tbnMat[2] *= sign * N / u_displacement_scale;
        // vec3 nvMappedEs = normalize( tbnMat * normalVec.xyz );
        return normalize(tbnMat * normalVec);
    }
};

Rabbid rabbid(Batch<float>& batch, int quad) {
    Rabbid listing{};
    listing.u_displacement_map = batch.bound(TextureSlot::height);
    listing.u_displacement_scale = Float(batch.material.depth);
    listing.objPosEs = lanes3(batch, Value::P, quad);
    listing.objNormalEs = lanes3(batch, Value::vertex_normal, quad);
    listing.uv = lanes2(batch, Value::uv, quad);
    listing.texCoords = lanes2(batch, Value::hit_uv, quad);
    for (int i = 0; i < 4; ++i) {
        const int lane = 4 * quad + i;
        const vec3<float> V = normalize(-batch.vector3(Value::P, lane));
        listing.facing[i] = !(dot(batch.vector3(Value::Ng, lane), V) < 0);
    }
    return listing;
}

/// N of the stage, or of another in its place, is that of `expected(batch, quad)`.
testing::AssertionResult equals(const std::string& id,
                                const std::function<Vec3(Batch<float>&, int)>& expected,
                                const std::function<void(Batch<float>&)>& change = {}) {
    for (int seed = 0; seed < 8; ++seed) {
        StageInputs inputs(100 + seed, SlotsBound::not_baked);
        Batch<float>& batch = inputs.batch;
        if (change) change(batch);
        batch.own_depth = true;
        for (int lane = 0; lane < batch.lanes; ++lane) {
            // Some faces from behind; a depth in tiles is another number of world units.
            if (lane / 4 % 3 == 0) batch.set(Value::Ng, lane, -batch.vector3(Value::Ng, lane));
            batch.real(Value::relief_depth, lane) = 2.5f * batch.material.depth;
        }
        batch.run(id);
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            const Vec3 n = expected(batch, quad);
            for (int i = 0; i < 12; ++i) {
                const float a = n[i % 3].lane[i / 3];
                const float b = batch.real(Value::N, 4 * quad + i / 3, i % 3);
                if (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b)) continue;
                if (a != a && b != b) continue;
                return testing::AssertionFailure()
                       << id << ": seed " << seed << ", quad " << quad << ": " << a << ", " << b;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(RabbidNormals, EqualTheListing) {
    const auto listing = [](Version version) {
        return [version](Batch<float>& b, int quad) { return rabbid(b, quad).main(version); };
    };
    EXPECT_TRUE(equals("h2n-gather@published", listing(Version::gather)));
    EXPECT_TRUE(equals("h2n-4tap@published", listing(Version::taps)));
    EXPECT_TRUE(equals("h2n-sobel@published", listing(Version::sobel)));
    EXPECT_FALSE(equals("h2n-4tap", listing(Version::taps)));
    EXPECT_FALSE(equals("h2n-gather@published", listing(Version::taps)));
    // The thickness in world units for the listing's scale.
    EXPECT_FALSE(equals("h2n-gather@published", [](Batch<float>& b, int quad) {
        Rabbid changed = rabbid(b, quad);
        changed.u_displacement_scale = lanes(b, Value::relief_depth, quad, 0);
        return changed.main(Version::gather);
    }));
    // A single ulp of the scale.
    EXPECT_FALSE(equals("h2n-sobel@published", [](Batch<float>& b, int quad) {
        Rabbid changed = rabbid(b, quad);
        changed.u_displacement_scale = changed.u_displacement_scale * Float(1 + 0x1p-23f);
        return changed.main(Version::sobel);
    }));
}

// ---- "Relief maps" (T. Renk), normal mapping ----------------------------------------------------

/// One fragment's varyings from the vertex shader: eyeNormal, eyeTangent, eyeBinormal.
struct RenkVertex {
    vec3<float> gl_Normal, tangent, binormal;
    const float (&to_object)[12];  ///< rows of the inverse modelview matrix
    vec3<float> eyeNormal, eyeTangent, eyeBinormal;

    /// gl_NormalMatrix * v: the transpose of the upper left of the inverse.
    vec3<float> gl_NormalMatrix(const vec3<float>& v) const {
        const auto row = [&](int r) {
            return vec3<float>(to_object[4 * r], to_object[4 * r + 1], to_object[4 * r + 2]);
        };
        return row(0) * v.x + row(1) * v.y + row(2) * v.z;
    }
    void main() {
        // eyeNormal = normalize(gl_NormalMatrix * gl_Normal);
        eyeNormal = normalize(gl_NormalMatrix(gl_Normal));
        // eyeTangent = normalize(gl_NormalMatrix * tangent);
        eyeTangent = normalize(gl_NormalMatrix(tangent));
        // eyeBinormal = normalize(gl_NormalMatrix * binormal);
        eyeBinormal = normalize(gl_NormalMatrix(binormal));
    }
};

using RenkVarying = vec3<float> RenkVertex::*;

/// The varying of a quad's four fragments.
Vec3 renk_varying(const Batch<float>& batch, int quad, RenkVarying varying) {
    Vec3 lanes;
    for (int i = 0; i < 4; ++i) {
        const auto at_lane =
            interpolated(batch, 4 * quad + i, [&](const PrimitiveVertices& row, int v) {
                RenkVertex vertex{as_vector(row.normal[v]),
                                  as_vector(row.tangent[v]),
                                  as_vector(row.binormal[v]),
                                  row.to_object,
                                  {},
                                  {},
                                  {}};
                vertex.main();
                return vertex.*varying;
            });
        for (int c = 0; c < 3; ++c) lanes[c].lane[i] = at_lane[c];
    }
    return lanes;
}

/// The fragment shader; `normalises`: each axis by itself, which it does not do.
Vec3 renk_normal(Batch<float>& batch, int quad, bool normalises) {
    const auto axis = [&](RenkVarying varying) {
        const Vec3 v = renk_varying(batch, quad, varying);
        return normalises ? normalize(v) : v;
    };
    const Vec3 eyeNormal = axis(&RenkVertex::eyeNormal);
    const Vec3 eyeTangent = axis(&RenkVertex::eyeTangent);
    const Vec3 eyeBinormal = axis(&RenkVertex::eyeBinormal);
    // vec4 normal_texel = texture2D(NormalTex, gl_TexCoord[0].st);
    const Vec4 normal_texel =
        quadrel::texture(*batch.bound(TextureSlot::normal), SampleContext<Float>(),
                         lanes2(batch, Value::hit_uv, quad));
    // N = normal_texel.rgb * 2.0 - 1.0;
    const Vec3 N = Vec3(normal_texel.x, normal_texel.y, normal_texel.z) * 2.0f - 1.0f;
    // N = normalize(N.x * eyeTangent + N.y * eyeBinormal + N.z * eyeNormal);
    return normalize(N.x * eyeTangent + N.y * eyeBinormal + N.z * eyeNormal);
}

TEST(RenkNormalMap, EqualsTheListing) {
    const auto bent = [](Batch<float>& batch) {
        Random random(3);
        bend_vertices(batch, random);
        for (int i = 0; i < 3; ++i) batch.vertices[0].to_object[5 * i] = 0.5f + float(i);
    };
    const auto listing = [](bool normalises) {
        return [normalises](Batch<float>& b, int quad) { return renk_normal(b, quad, normalises); };
    };
    EXPECT_TRUE(equals("normal-map-flightgear@published", listing(false), bent));
    EXPECT_FALSE(equals("normal-map-flightgear@published", listing(true), bent));
    EXPECT_FALSE(equals("normal-map", listing(false), bent));
}

// ---- "Relief maps" (T. Renk), bumpiness effect --------------------------------------------------

struct Renk {
    float scale, noise_magnitude;
    Vec3 n, lightDir;
    Vec2 Pos_xy, lightDir_xy;

    static Float Noise2D(const Vec2& p, Float scale) {
        return 0.5f + 0.5f * lattice_noise<Float>(p / scale, 0.0f, 0).value;
    }
    Float noisegrad() const {
        const Float wide = scale;
        // noisegrad = (Noise2D(Pos.xy, scale) - Noise2D(Pos.xy
        //       + (0.05 * scale) * normalize(lightDir.xy),scale))/(0.05 * scale);
        return (Noise2D(Pos_xy, wide) -
                Noise2D(Pos_xy + (Float(0.05f) * wide) * normalize(lightDir_xy), wide)) /
               (Float(0.05f) * wide);
    }
    Float NdotL() const {
        // NdotL = dot(n, lightDir);
        const Float NdotL = dot(n, lightDir);
        // NdotL = NdotL + noisegrad * noise_magnitude;
        return NdotL + noisegrad() * noise_magnitude;
    }
    /// How this room hands it on.
    Vec3 normal() const { return n + lightDir * (noisegrad() * Float(noise_magnitude)); }
};

Renk renk(Batch<float>& batch, int quad) {
    Renk listing{0.125f, 0.05f, lanes3(batch, Value::frame_normal, quad), {}, {}, {}};
    const LightUniforms& light = batch.frame.lights[0];
    const Vec3 position(light.position[0], light.position[1], light.position[2]);
    listing.lightDir = normalize(position - lanes3(batch, Value::P, quad));
    listing.Pos_xy = lanes2(batch, Value::uv, quad);
    listing.lightDir_xy = {dot(lanes3(batch, Value::J, quad), listing.lightDir),
                           dot(lanes3(batch, Value::J, quad, 3), listing.lightDir)};
    return listing;
}

TEST(RenkBumpiness, EqualsTheListing) {
    EXPECT_TRUE(equals("bump-noise@published",
                       [](Batch<float>& b, int quad) { return renk(b, quad).normal(); }));
    EXPECT_FALSE(equals("bump-noise@published", [](Batch<float>& b, int quad) {
        Renk displaced = renk(b, quad);
        displaced.Pos_xy = lanes2(b, Value::hit_uv, quad);
        return displaced.normal();
    }));
    EXPECT_FALSE(equals("bump-noise@published", [](Batch<float>& b, int quad) {
        Renk away = renk(b, quad);
        away.lightDir_xy = -away.lightDir_xy;
        return away.normal();
    }));
}

/// The dot product of what is handed on with the light is the listing's NdotL.
TEST(RenkBumpiness, TheNormalCarriesNdotL) {
    StageInputs inputs(130, SlotsBound::not_baked);
    inputs.batch.run("bump-noise@published");
    for (int quad = 0; quad < inputs.batch.lanes / 4; ++quad) {
        const Renk listing = renk(inputs.batch, quad);
        const Float got = dot(lanes3(inputs.batch, Value::N, quad), listing.lightDir);
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(got.lane[i], listing.NdotL().lane[i], 2e-6);
    }
}

}  // namespace
}  // namespace quadrel::test
