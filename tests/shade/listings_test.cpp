// The published shadings give what their listings give: each transcribed for the four fragments of
// a quad, from the vertex program to the colour, over random triangles, objects and maps.
#include "relief/tangent_listings.hpp"

namespace quadrel::test::tangent {
namespace {

/// texture(map, uv), with the quad's own differences of uv.
Vec4 TEX(Batch<float>& batch, TextureSlot slot, int quad, const Flaws& flaws) {
    const Vec2 uv = lanes2(batch, Value::hit_uv, quad);
    if (!flaws.undisplaced_gradients) return quadrel::texture(*batch.bound(slot), {}, uv);
    return texture_grad(*batch.bound(slot), SampleContext<Float>(), uv,
                        lanes2(batch, Value::dUVdx, quad), lanes2(batch, Value::dUVdy, quad));
}

// ---- "Parallax Mapping with Offset Limiting" (Welsh), both programs
// ------------------------------

/// _SAT: each component clamped to [0, 1].
Vec3 SAT(const Vec3& v) { return clamp(v, Float(0.0f), Float(1.0f)); }

Vec3 welsh(Batch<float>& batch, int quad, const Flaws& flaws) {
    const auto texcoord = [&](int i) {
        const LightUniforms& light = batch.frame.lights[i];
        return in_tangent_space(batch, quad, flaws, [&](const PrimitiveVertices& row, int v) {
            // DP4 light0pos.x, mvi[0], state.light[0].position;   .y, .z likewise
            const float w = light.directional ? 0.0f : 1.0f;
            const One3 light0pos = affine(row.to_object, three(light.position), w);
            // SUB light0vec, light0pos, vertex.position;
            One3 from = three(row.position[v]);
            if (flaws.light_of_the_displaced_point) from += displacement(batch, quad, row);
            return light0pos - from;
        });
    };
    // TEX rgb, newtexcoord, texture[0], 2D;
    const Vec3 rgb(TEX(batch, TextureSlot::color, quad, flaws));
    // TEX normal, newtexcoord, texture[1], 2D;
    Vec3 normal(TEX(batch, TextureSlot::normal, quad, flaws));
    // MAD normal, normal, 2.0, -1.0;
    normal = normal * Float(2.0f) - Vec3(Float(1.0f));
    // DP3 temp, normal, normal; RSQ temp, temp.r; MUL normal, normal, temp;
    normal = normalize(normal);
    Vec3 total(Float(0.0f));
    for (int i = 0; i < 2; ++i) {
        // DP3 temp, fragment.texcoord[1], fragment.texcoord[1]; RSQ; MUL light0tsvec, ..., temp;
        const Vec3 light0tsvec = normalize(texcoord(i));
        // DP3 bump, normal, light0tsvec;
        const Float bump = dot(normal, light0tsvec);
        // MUL_SAT total, bump, light0color;     MUL_SAT bump, bump, light1color;
        const Vec3 lit = SAT(all(three(batch.frame.lights[i].diffuse)) * bump);
        // ADD_SAT total, total, bump;
        total = i == 0 ? lit : SAT(total + lit);
    }
    // ADD_SAT total, total, ambient;
    total = SAT(total + all(three(batch.frame.lights[0].ambient)));
    // MUL_SAT result.color, rgb, total;
    return SAT(rgb * total);
}

// ---- "Steep Parallax Mapping" (McGuire and McGuire), the page's shader --------------------------

/// From the texel that the march ended on, here of the final coordinate, to the colour.
Vec3 mcguire(Batch<float>& batch, int quad, const Flaws& flaws) {
    // const vec3 color = texture2D(texture, offsetCoord).rgb;
    const Vec3 color(TEX(batch, TextureSlot::color, quad, flaws));
    // tsL = normalize(tsL);
    const Vec3 tsL = normalize(mcguire_light(batch, quad, flaws));
    // vec3 tsN = NB.xyz * 2 - 1;
    const Vec3 tsN =
        Vec3(TEX(batch, TextureSlot::normal, quad, flaws)) * Float(2.0f) - Vec3(Float(1.0f));
    // const float NdotL = max(0, dot(tsN, tsL));
    const Float NdotL = max(Float(0.0f), dot(tsN, tsL));
    // vec3 lightColor = vec3(1.5, 1.5, 1) * 0.9;
    const One3 lightColor = One3(1.5f, 1.5f, 1.0f) * 0.9f;
    // vec3 ambient = vec3(0.4,0.4,0.6) * 1.4;
    const One3 ambient = One3(0.4f, 0.4f, 0.6f) * 1.4f;
    // float selfShadow = 0;   if (NdotL > 0) {   selfShadow = (NB.a < height);
    const auto lit = NdotL > Float(0.0f);
    const Float selfShadow = select(lit, lanes(batch, Value::shadow_visibility, quad), Float(0.0f));
    // lightColor = lightColor * 1.2;
    const Vec3 brighter = all(lightColor) * select(lit, Float(1.2f), Float(1.0f));
    // gl_FragColor.rgb = color * ambient + color * NdotL * selfShadow * lightColor;
    return color * all(ambient) + color * NdotL * selfShadow * brighter;
}

// ---- GPU Gems 3, chapter 18, relief_mapping.fx: vertex_shader and normal_mapping
// -----------------

Vec3 gems(Batch<float>& batch, int quad, const Flaws& flaws) {
    const LightUniforms& light = batch.frame.lights[0];
    const auto tangentspace = [&](const auto& vector) {
        return varying(batch, quad, [&](const PrimitiveVertices& row, int v) {
            // tangent, binormal and normal by modelviewrot; mul(tangentspace, vector)
            const One3 x = vector(row, v);
            return One3(dot(affine(row.to_eye, three(row.tangent[v]), 0), x),
                        dot(affine(row.to_eye, three(row.binormal[v]), 0), x),
                        dot(affine(row.to_eye, three(row.normal[v]), 0), x));
        });
    };
    const auto vpos = [](const PrimitiveVertices& row, int v) {
        return affine(row.to_eye, three(row.position[v]), 1);
    };
    // light of the vertices, not of the displaced point
    const Vec3 l = normalize(tangentspace([&](const PrimitiveVertices& row, int v) {
        if (light.directional) return three(light.position);
        One3 from = vpos(row, v);
        if (flaws.light_of_the_displaced_point)
            from += batch.vector3(Value::hit_P, 4 * quad) - batch.vector3(Value::P, 4 * quad);
        return three(light.position) - from;
    }));
    const Vec3 e = normalize(tangentspace(vpos));
    const Vec3 c(TEX(batch, TextureSlot::color, quad, flaws));
    const Vec3 n = normalize(Vec3(TEX(batch, TextureSlot::normal, quad, flaws)) * Float(2.0f) -
                             Vec3(Float(1.0f)));
    const auto saturate = [](Float x) { return clamp(x, Float(0.0f), Float(1.0f)); };
    const Float diff = saturate(dot(l, n)), spec = saturate(dot(normalize(l - e), n));
    Float att = Float(1.0f) - max(Float(0.0f), l.z);
    att = Float(1.0f) - att * att;
    const MaterialUniforms& m = batch.material;
    return all(three(m.ambient)) * c +
           (c * all(three(m.diffuse)) * diff +
            all(three(m.specular)) * quadrel::pow(spec, Float(m.shininess))) *
               att;
}

// ---- "Normal, Parallax and Relief mapping" (Rabbid76), main -------------------------------------

Vec3 rabbid(Batch<float>& batch, int quad, const Flaws& flaws) {
    const MaterialUniforms& m = batch.material;
    const Vec3 nvMappedEs = lanes3(batch, Value::N, quad), objPosEs = lanes3(batch, Value::P, quad);
    // vec3 color = texture( u_texture, texCoords.st ).rgb;
    const Vec3 color(TEX(batch, TextureSlot::color, quad, flaws));
    // vec3 lightCol = u_ambient * color;
    Vec3 lightCol = color * Float(m.ambient[0]);
    // vec3 normalV = normalize( nvMappedEs );
    const Vec3 normalV = normalize(nvMappedEs);
    // vec3 lightV = normalize( -u_lightDir );
    const Vec3 lightV = normalize(all(three(batch.frame.lights[0].position)));
    // float NdotL = max( 0.0, dot( normalV, lightV ) );
    const Float NdotL = max(Float(0.0f), dot(normalV, lightV));
    // lightCol += NdotL * u_diffuse * color;
    lightCol += color * (NdotL * Float(m.diffuse[0]));
    // vec3 eyeV = normalize( -objPosEs );
    const Vec3 eyeV = normalize(-objPosEs);
    // vec3 halfV = normalize( eyeV + lightV );
    const Vec3 halfV = normalize(eyeV + lightV);
    // float NdotH = max( 0.0, dot( normalV, halfV ) );
    const Float NdotH = max(Float(0.0f), dot(normalV, halfV));
    // float kSpecular = ( u_shininess + 2.0 ) * pow( NdotH, u_shininess ) / ( 2.0 * 3.14159265 );
    const Float kSpecular = Float(m.shininess + 2.0f) * quadrel::pow(NdotH, Float(m.shininess)) /
                            Float(2.0f * 3.14159265f);
    // lightCol += kSpecular * u_specular * color;
    lightCol += color * (kSpecular * Float(m.specular[0]));
    return lightCol;
}

// ---- Stages against listings --------------------------------------------------------------------

using Listing = Vec3 (*)(Batch<float>&, int quad, const Flaws&);

/// A surface stage, a shading and what they are to give. The colours agree up to rounding of the
/// way there and back that a normal takes from tangent space to eye space.
struct Published {
    std::string surface, shading;
    Listing listing;
    float tolerance;
    bool directional = false;  ///< the listing's light, and no other
};
const Published of_welsh{"normal-welsh@published", "shade-welsh@published", welsh, 2e-5f};
const Published of_mcguire{"normal-mcguire@published", "shade-mcguire@published", mcguire, 4e-5f};
const Published of_gems{"normal-welsh@published", "shade-gg3", gems, 1e-3f};
const Published of_rabbid{"", "shade-rabbid@published", rabbid, 2e-6f, true};

testing::AssertionResult equals(const Published& published, const Flaws& flaws = {},
                                int batches = 8) {
    int off = 0, lanes = 0;
    for (int seed = 0; seed < batches; ++seed) {
        Inputs inputs(seed);
        Batch<float>& batch = inputs.batch;
        for (LightUniforms& light : batch.frame.lights)
            light.directional = published.directional || seed % 4 == 3;
        if (published.surface.empty()) {
            Random random(static_cast<std::uint64_t>(seed));
            for (int lane = 0; lane < batch.lanes; ++lane)
                batch.set(Value::N, lane, random_direction(random) * random.uniform(0.5, 2));
        } else {
            batch.run(published.surface);
        }
        batch.run(published.shading);
        for (int quad = 0; quad < batch.lanes / 4; ++quad)
            off += lanes_off(batch, Value::color, quad, published.listing(batch, quad, flaws),
                             published.tolerance);
        lanes += batch.lanes;
    }
    // A cosine of a rounding turns McGuire's light on; a coordinate near the horizon, everything.
    if (200 * off <= lanes) return testing::AssertionSuccess();
    return testing::AssertionFailure() << published.shading << ": " << off << " of " << lanes;
}

TEST(PublishedShadings, EqualTheirListings) {
    for (const Published& published : {of_welsh, of_mcguire, of_gems, of_rabbid})
        EXPECT_TRUE(equals(published, {}, 24));
}

TEST(PublishedShadings, ErrorsAreCaught) {
    for (const Published& published : {of_welsh, of_mcguire, of_gems}) {
        EXPECT_FALSE(equals(published, {.light_of_the_displaced_point = true}));
        EXPECT_FALSE(equals(published, {.undisplaced_gradients = true}));
    }
    EXPECT_FALSE(equals(of_welsh, {.light_of_the_fragment = true}));
    EXPECT_FALSE(equals(of_mcguire, {.light_of_the_fragment = true}));
    EXPECT_FALSE(equals(of_rabbid, {.undisplaced_gradients = true}));
    Published other = of_welsh;
    other.shading = "shade-welsh";
    EXPECT_FALSE(equals(other));
    other = of_mcguire;
    other.surface = "normal-welsh@published";  // y the other way, and normalised
    EXPECT_FALSE(equals(other));
    other = of_gems;
    other.surface = "normal-mcguire@published";
    EXPECT_FALSE(equals(other));
    other = of_rabbid;
    other.shading = "shade-rabbid";
    EXPECT_FALSE(equals(other));
}

}  // namespace
}  // namespace quadrel::test::tangent
