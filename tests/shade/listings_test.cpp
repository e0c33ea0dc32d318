// The published shadings give the bits of their listings: each transcribed as plain code for one
// fragment, its vectors in eye space, and run on random shading points.
#include "shade/lighting.hpp"

namespace quadrel::test {
namespace {

using Vec3 = vec3<float>;

/// What the listings read at one fragment.
struct Fragment {
    Vec3 N, frame_normal, P, V, base;
    Vec3 to_light[2];  ///< not normalised
    Vec3 light_diffuse[2], light_ambient;
    float visibility;
    MaterialUniforms material;
};

Fragment fragment(Batch<float>& batch, int lane, const Vec3& base) {
    Fragment f{};
    f.N = batch.vector3(Value::N, lane);
    f.frame_normal = batch.vector3(Value::frame_normal, lane);
    f.P = batch.vector3(Value::P, lane);
    f.V = normalize(Vec3(0) - f.P);
    f.base = base;
    for (int i = 0; i < 2; ++i) {
        const LightUniforms& light = batch.frame.lights[i];
        const Vec3 position(light.position[0], light.position[1], light.position[2]);
        f.to_light[i] = light.directional ? position : position - batch.vector3(Value::hit_P, lane);
        f.light_diffuse[i] = Vec3(light.diffuse[0], light.diffuse[1], light.diffuse[2]);
    }
    const float(&a)[3] = batch.frame.lights[0].ambient;
    f.light_ambient = Vec3(a[0], a[1], a[2]);
    f.visibility = batch.real(Value::shadow_visibility, lane);
    f.material = batch.material;
    return f;
}

// ---- "Parallax Mapping with Offset Limiting" (Welsh), fragment program --------------------------

/// _SAT: each component clamped to [0, 1].
Vec3 sat(const Vec3& v) { return clamp(v, 0.0f, 1.0f); }

Vec3 welsh(const Fragment& f) {
    const Vec3 normal = f.N, rgb = f.base;
    // DP3 temp, fragment.texcoord[1], fragment.texcoord[1];
    float temp = dot(f.to_light[0], f.to_light[0]);
    // RSQ temp, temp.x;
    temp = 1.0f / std::sqrt(temp);
    // MUL light0tsvec, fragment.texcoord[1], temp;
    const Vec3 light0tsvec = f.to_light[0] * temp;
    // DP3 bump, normal, light0tsvec;
    Vec3 bump = Vec3(dot(normal, light0tsvec));
    // MUL_SAT total, bump, light0color;
    Vec3 total = sat(bump * f.light_diffuse[0]);
    // DP3 temp, fragment.texcoord[2], fragment.texcoord[2];
    temp = dot(f.to_light[1], f.to_light[1]);
    // RSQ temp, temp.x;
    temp = 1.0f / std::sqrt(temp);
    // MUL light1tsvec, fragment.texcoord[2], temp;
    const Vec3 light1tsvec = f.to_light[1] * temp;
    // DP3 bump, normal, light1tsvec;
    bump = Vec3(dot(normal, light1tsvec));
    // MUL_SAT bump, bump, light1color;
    bump = sat(bump * f.light_diffuse[1]);
    // ADD_SAT total, total, bump;
    total = sat(total + bump);
    // ADD_SAT total, total, ambient;
    total = sat(total + f.light_ambient);
    // MUL_SAT result.color, rgb, total;
    return sat(rgb * total);
}

// ---- "Steep Parallax Mapping" (McGuire and McGuire), the page's shader --------------------------

Vec3 mcguire(const Fragment& f) {
    const Vec3 color = f.base;
    // tsL = normalize(tsL);
    const Vec3 tsL = normalize(f.to_light[0]);
    // const float NdotL = max(0, dot(tsN, tsL));
    const float NdotL = max(0.0f, dot(f.N, tsL));
    // vec3 lightColor = vec3(1.5, 1.5, 1) * 0.9;
    Vec3 lightColor = Vec3(1.5f, 1.5f, 1.0f) * 0.9f;
    // vec3 ambient = vec3(0.4,0.4,0.6) * 1.4;
    const Vec3 ambient = Vec3(0.4f, 0.4f, 0.6f) * 1.4f;
    // float selfShadow = 0;
    float selfShadow = 0;
    // if (NdotL > 0) {
    if (NdotL > 0) {
        // selfShadow = (NB.a < height);
        selfShadow = f.visibility;
        // lightColor = lightColor * 1.2;
        lightColor = lightColor * 1.2f;
    }
    // gl_FragColor.rgb = color * ambient + color * NdotL * selfShadow * lightColor;
    return color * ambient + color * NdotL * selfShadow * lightColor;
}

// ---- "Normal, Parallax and Relief mapping" (Rabbid76), main -------------------------------------

Vec3 rabbid(const Fragment& f) {
    const float u_ambient = f.material.ambient[0], u_diffuse = f.material.diffuse[0];
    const float u_specular = f.material.specular[0], u_shininess = f.material.shininess;
    const Vec3 color = f.base;
    // vec3 lightCol = u_ambient * color;
    Vec3 lightCol = u_ambient * color;
    // vec3 normalV = normalize( nvMappedEs );
    const Vec3 normalV = normalize(f.N);
    // vec3 lightV = normalize( -u_lightDir );
    const Vec3 lightV = normalize(f.to_light[0]);
    // float NdotL = max( 0.0, dot( normalV, lightV ) );
    const float NdotL = max(0.0f, dot(normalV, lightV));
    // lightCol += NdotL * u_diffuse * color;
    lightCol += NdotL * u_diffuse * color;
    // vec3 eyeV = normalize( -objPosEs );
    const Vec3 eyeV = normalize(-f.P);
    // vec3 halfV = normalize( eyeV + lightV );
    const Vec3 halfV = normalize(eyeV + lightV);
    // float NdotH = max( 0.0, dot( normalV, halfV ) );
    const float NdotH = max(0.0f, dot(normalV, halfV));
    // float kSpecular = ( u_shininess + 2.0 ) * pow( NdotH, u_shininess ) / ( 2.0 * 3.14159265 );
    const float kSpecular =
        (u_shininess + 2.0f) * quadrel::pow(NdotH, u_shininess) / (2.0f * 3.14159265f);
    // lightCol += kSpecular * u_specular * color;
    lightCol += kSpecular * u_specular * color;
    return lightCol;
}

// ---- GPU Gems 3, chapter 18, relief_mapping.fx: its formulas ------------------------------------

Vec3 three(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

Vec3 gems(const Fragment& f) {
    const Vec3 c = f.base, n = f.N;
    const Vec3 l = normalize(f.to_light[0]), e = -f.V;  // e: from the eye to the surface
    const float diff = clamp(dot(l, n), 0.0f, 1.0f);
    const float spec = clamp(dot(normalize(l - e), n), 0.0f, 1.0f);
    // l.z of tangent space is the cosine with the frame's normal.
    float att = 1.0f - max(0.0f, dot(l, f.frame_normal));
    att = 1.0f - att * att;
    return three(f.material.ambient) * c +
           att * (c * three(f.material.diffuse) * diff +
                  three(f.material.specular) * quadrel::pow(spec, f.material.shininess));
}

// ---- Bits ---------------------------------------------------------------------------------------

using Listing = Vec3 (*)(const Fragment&);

testing::AssertionResult equals(const std::string& id, const Listing& listing) {
    for (int i = 0; i < 200; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Batch<float> batch = random_points(random, 2);
        open_sky(batch);
        const vec4<float> texel(static_cast<float>(random.uniform(0, 1)),
                                static_cast<float>(random.uniform(0, 1)),
                                static_cast<float>(random.uniform(0, 1)), 0.5f);
        const Map map = constant_map(texel);
        batch.bind(TextureSlot::color, map.sampled);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const double length = random.uniform(0.5, 2);  // published normals need not be unit
            batch.set(Value::frame_normal, lane, random_direction(random));
            batch.set(Value::N, lane, dvec3(batch.vector3(Value::N, lane)) * length);
        }
        batch.run(id);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const Vec3 expected = listing(fragment(batch, lane, Vec3(texel)));
            if (batch.vector3(Value::color, lane) == expected) continue;
            return testing::AssertionFailure() << id << ": batch " << i << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

Vec3 welsh_unsaturated(const Fragment& f) {
    Fragment dim = f;
    dim.light_diffuse[1] = f.light_diffuse[1] * 1.0000002f;
    return welsh(dim);
}
Vec3 mcguire_in_shadow(const Fragment& f) {
    Fragment lit = f;
    lit.visibility = 1;
    return mcguire(lit);
}
Vec3 rabbid_gated(const Fragment& f) {
    Fragment dull = f;
    if (dot(f.N, f.to_light[0]) <= 0) dull.material.specular[0] = 0;
    return rabbid(dull);
}
Vec3 gems_unfaded(const Fragment& f) {
    Fragment up = f;
    up.frame_normal = normalize(f.to_light[0]);
    return gems(up);
}

TEST(PublishedShadings, EqualTheirListings) {
    EXPECT_TRUE(equals("shade-welsh@published", welsh));
    EXPECT_TRUE(equals("shade-mcguire@published", mcguire));
    EXPECT_TRUE(equals("shade-rabbid@published", rabbid));
    EXPECT_TRUE(equals("shade-gg3", gems));
}

TEST(PublishedShadings, SmallChangesShow) {
    EXPECT_FALSE(equals("shade-welsh@published", welsh_unsaturated));
    EXPECT_FALSE(equals("shade-welsh", welsh));
    EXPECT_FALSE(equals("shade-mcguire@published", mcguire_in_shadow));
    EXPECT_FALSE(equals("shade-rabbid@published", rabbid_gated));
    EXPECT_FALSE(equals("shade-gg3", gems_unfaded));
}

/// Without lights nothing of them is read, and the ambient term alone remains.
TEST(PublishedShadings, NoLightLeavesTheAmbientTerm) {
    for (const char* id : {"shade-welsh@published", "shade-mcguire@published",
                           "shade-rabbid@published", "shade-gg3"}) {
        Random random(3);
        Batch<float> batch = random_points(random, 0);
        for (int lane = 0; lane < batch.lanes; ++lane)
            batch.set(Value::frame_normal, lane, batch.vector3(Value::N, lane));
        batch.poison(Value::shadow_visibility);
        open_sky(batch);
        Batch<float> dim = batch;
        for (int lane = 0; lane < dim.lanes; ++lane) dim.real(Value::occlusion, lane) = 0.5f;
        batch.run(id);
        dim.run(id);
        for (int lane = 0; lane < batch.lanes; ++lane)
            EXPECT_EQ(dim.vector3(Value::color, lane), batch.vector3(Value::color, lane) * 0.5f)
                << id;
    }
}

}  // namespace
}  // namespace quadrel::test
