// The published stages, chained, give the bits of the listing.
#include "effort.hpp"
#include "relief/inputs.hpp"
#include "relief/planted.hpp"
#include "relief/thesis_listing.hpp"

namespace quadrel::test {
namespace {

using thesis::Float;

/// The chain under test: stages by id, with a chance to tamper after each.
struct Chain {
    std::vector<std::string> stages = {"differentiate",        "frame-thesis",
                                       "linear-thesis",        "displace",
                                       "h2n-thesis@published", "shadow-march-thesis@published",
                                       "occlusion-none",       "shade-thesis@published"};
    DerivativeMode derivatives = DerivativeMode::fine;
    std::function<void(const std::string&, Batch<float>&)> after{};

    void run(Batch<float>& batch) const {
        batch.frame.derivatives = derivatives;
        for (const std::string& id : stages) {
            batch.run(id);
            if (after) after(id, batch);
        }
    }
};

Float lanes(Batch<float>& batch, Value v, int quad, int component) {
    return load<Float>(&batch.real(v, 4 * quad, component));
}
thesis::Vec3 lanes3(Batch<float>& batch, Value v, int quad) {
    return {lanes(batch, v, quad, 0), lanes(batch, v, quad, 1), lanes(batch, v, quad, 2)};
}

/// The listing with the uniforms of the batch and the varyings of one of its quads.
thesis::ParallaxFrag listing(Batch<float>& batch, int quad) {
    thesis::ParallaxFrag frag;
    frag.MaxParallaxOffset = batch.material.depth;
    for (int i = 0; i < 3; ++i) {
        frag.Light0_Ambient[i] = batch.frame.lights[0].ambient[i];
        frag.Light0_Specular[i] = batch.frame.lights[0].specular[i];
        frag.Material_Specular[i] = batch.material.specular[i];
        frag.EC_LightPosition[i] = batch.frame.lights[0].position[i];
    }
    frag.Color_Map.bound = batch.bound(TextureSlot::color);
    frag.Emissive_Map.bound = batch.bound(TextureSlot::emissive);
    frag.Environment_Map.bound = batch.bound(TextureSlot::environment);
    frag.Gloss_Map.bound = batch.bound(TextureSlot::gloss);
    frag.Normal_Map.bound = batch.bound(TextureSlot::height);
    frag.EC_SurfacePosition = lanes3(batch, Value::P, quad);
    frag.EC_SurfaceNormal = lanes3(batch, Value::vertex_normal, quad);
    frag.vST = {lanes(batch, Value::uv, quad, 0), lanes(batch, Value::uv, quad, 1)};
    frag.main();
    return frag;
}

/// Component `component` of a value, as the listing has it.
struct Expected {
    Value value;
    int component;
    Float of_listing;
};

void expect(std::vector<Expected>& list, Value v, const Float& x) { list.push_back({v, 0, x}); }
template <int size>
void expect(std::vector<Expected>& list, Value v, const vec<size, Float>& x) {
    for (int c = 0; c < size; ++c) list.push_back({v, c, x[c]});
}

template <int size>
void mark_nan(Float& flags, const vec<size, Float>& coordinate) {
    for (int c = 0; c < size; ++c)
        for (int i = 0; i < 4; ++i)
            if (coordinate[c].lane[i] != coordinate[c].lane[i])
                flags.lane[i] = float(HitFlag::nan_look_up);
}

/// nan-look-up where the listing looks up at NaN, or by a mip level that follows from one.
Float look_up_flags(const thesis::ParallaxFrag& f) {
    Float flags(0);
    mark_nan(flags, f.UV);
    const SampledTexture* cube = f.Environment_Map.bound;
    if (!cube) return flags;
    for (const thesis::Vec3& direction : {f.Reflect, f.Refract}) {
        mark_nan(flags, direction);
        if (cube->view.levels == 1) continue;
        mark_nan(flags, thesis::dFdx(direction));
        mark_nan(flags, thesis::dFdy(direction));
    }
    return flags;
}

/// Everything that a stage hands on and the listing computes.
std::vector<Expected> expectations(const thesis::ParallaxFrag& f) {
    std::vector<Expected> list;
    const thesis::Vec3 N = normalize(f.EC_SurfaceNormal);
    expect(list, Value::dPdx, thesis::dFdx(f.EC_SurfacePosition));
    expect(list, Value::dPdy, thesis::dFdy(f.EC_SurfacePosition));
    expect(list, Value::dUVdx, thesis::dFdx(f.vST));
    expect(list, Value::dUVdy, thesis::dFdy(f.vST));
    expect(list, Value::T, f.T_Flat_Shading);
    expect(list, Value::B, f.B_Flat_Shading);
    expect(list, Value::frame_normal, N);
    expect(list, Value::r, dot(-N, -f.E));
    expect(list, Value::uv_rate, f.dUVdSR);
    expect(list, Value::K, f.dUVdSR * f.ParallaxScalar);
    expect(list, Value::hit_uv, f.UV);
    expect(list, Value::hit_flags, look_up_flags(f));
    expect(list, Value::hit_depth, f.Offset);
    expect(list, Value::hit_P, f.P);
    expect(list, Value::N, f.N);
    expect(list, Value::shadow_visibility, f.Light_Intensity);
    expect(list, Value::light_ambient, f.Ambient_Color);
    expect(list, Value::light_diffuse, f.Diffuse_Color);
    expect(list, Value::light_specular, f.Specular_Color);
    expect(list, Value::light_emissive, f.Emissive_Color);
    expect(list, Value::light_reflection, f.Reflection_Color);
    expect(list, Value::light_refraction, f.Refraction_Color);
    expect(list, Value::color, f.gl_FragColor);
    // A fragment that breaks with Sample = k has made k + 1 tests, one that never breaks 129; each
    // step of the light's march lowers Light_H by one OffsetPerSample.
    expect(list, Value::hit_steps, min(f.Sample + Float(1.0f), Float(129.0f)));
    expect(list, Value::shadow_steps, (f.Curr_Offset - f.Light_H) * Float(128.0f));
    return list;
}

bool equal(Batch<float>& batch, const Expected& expected, int lane, float listed) {
    if (info(expected.value).kind == ValueKind::integer) {
        return static_cast<float>(batch.integer(expected.value, lane)) == listed;
    }
    const std::uint64_t bits =
        listed != listed ? ~std::uint64_t(0) : std::bit_cast<std::uint32_t>(listed);
    return batch.bits(expected.value, lane, expected.component) == bits;
}

testing::AssertionResult quad_equals_listing(Batch<float>& batch, int quad) {
    for (const Expected& expected : expectations(listing(batch, quad))) {
        for (int i = 0; i < 4; ++i) {
            const float listed = expected.of_listing.lane[i];
            if (equal(batch, expected, 4 * quad + i, listed)) continue;
            return testing::AssertionFailure()
                   << info(expected.value).name << "[" << expected.component << "], lane " << i
                   << " of quad " << quad << " is not " << listed;
        }
    }
    return testing::AssertionSuccess();
}

/// Random quads, maps, materials and lights; one in twenty quads' vertex normals turned away.
struct Inputs {
    Random random;
    Batch<float> batch;
    RandomMaterial material;

    explicit Inputs(int seed) : random(static_cast<std::uint64_t>(seed)), material(random, batch) {
        fill_quads(batch, random);
        for (int quad = 0; quad < batch_quads; ++quad) {
            if (!random.chance(0.05)) continue;
            for (int lane = 4 * quad; lane < 4 * quad + 4; ++lane) {
                batch.set(Value::vertex_normal, lane, -batch.vector3(Value::vertex_normal, lane));
            }
        }
    }
};

testing::AssertionResult published_equals_listing(const Chain& chain, int batches) {
    for (int i = 0; i < batches; ++i) {
        Inputs inputs(i);
        chain.run(inputs.batch);
        for (int quad = 0; quad < batch_quads; ++quad) {
            const auto result = quad_equals_listing(inputs.batch, quad);
            if (!result) return testing::AssertionFailure() << result.message() << ", batch " << i;
        }
    }
    return testing::AssertionSuccess();
}

/// An error planted behind a stage: what it does to the values of a lane.
struct Tampering {
    Planted planted;
    std::string behind;
    void (*change)(Batch<float>& batch, int lane);
};

const std::vector<Tampering>& tamperings() {
    using B = Batch<float>;
    static const std::vector<Tampering> list = {
        {Planted::one_ulp_in_rate, "frame-thesis",
         [](B& b, int lane) {
             float& x = b.real(Value::uv_rate, lane, 1);
             if (lane == 37) x = std::nextafter(x, 2.0f);
         }},
        {Planted::swapped_tangents, "frame-thesis",
         [](B& b, int lane) {
             const auto px = b.vector3(Value::dPdx, lane);
             b.set(Value::dPdx, lane, b.vector3(Value::dPdy, lane));
             b.set(Value::dPdy, lane, px);
         }},
        {Planted::step_not_taken, "linear-thesis",
         [](B& b, int lane) { b.real(Value::hit_depth, lane) -= 1.0f / 128; }},
        {Planted::steps_from_zero, "linear-thesis",
         [](B& b, int lane) { b.integer(Value::hit_steps, lane) -= 1; }},
        {Planted::point_on_the_polygon, "displace",
         [](B& b, int lane) { b.set(Value::hit_P, lane, b.vector3(Value::P, lane)); }},
        {Planted::normalised_normal, "h2n-thesis@published",
         [](B& b, int lane) { b.set(Value::N, lane, normalize(b.vector3(Value::N, lane))); }},
        {Planted::clamped_diffuse, "shade-thesis@published",
         [](B& b, int lane) {
             const auto diffuse = b.vector3(Value::light_diffuse, lane);
             b.set(Value::light_diffuse, lane, max(diffuse, 0.0f));
         }},
        {Planted::nan_not_flagged, "shade-thesis@published",
         [](B& b, int lane) { b.integer(Value::hit_flags, lane) = 0; }},
        {Planted::colour_in_rgba_order, "shade-thesis@published",
         [](B& b, int lane) {
             const auto c = b.vector3(Value::light_ambient, lane);
             b.set(Value::light_ambient, lane, vec3<float>(c.z, c.x, c.y));
         }},
    };
    return list;
}

void tamper(Planted planted, const std::string& behind, Batch<float>& batch) {
    for (const Tampering& t : tamperings()) {
        if (t.planted != planted || t.behind != behind) continue;
        for (int lane = 0; lane < batch.lanes; ++lane) t.change(batch, lane);
    }
}

Chain chain(Planted planted) {
    Chain c;
    if (planted == Planted::coarse_derivatives) c.derivatives = DerivativeMode::coarse;
    if (planted == Planted::gram_tangents) c.stages[1] = "frame-gram";
    if (planted == Planted::corrected_shadow) c.stages[5] = "shadow-march-thesis";
    c.after = [planted](const std::string& id, Batch<float>& b) { tamper(planted, id, b); };
    return c;
}

TEST(Published, EqualsTheListingBitForBit) {
    constexpr int batches = 320;
    static_assert(batches * batch_quads > 20000);
    EXPECT_TRUE(published_equals_listing(chain(Planted::none), rounds(batches)));
}

TEST(Published, ErrorsAreCaught) {
    for (const Planted planted :
         {Planted::coarse_derivatives, Planted::gram_tangents, Planted::swapped_tangents,
          Planted::one_ulp_in_rate, Planted::step_not_taken, Planted::point_on_the_polygon,
          Planted::normalised_normal, Planted::corrected_shadow, Planted::clamped_diffuse,
          Planted::colour_in_rgba_order, Planted::steps_from_zero, Planted::nan_not_flagged}) {
        EXPECT_FALSE(published_equals_listing(chain(planted), 5)) << static_cast<int>(planted);
    }
}

/// How often the fragments of a batch took the listing's branches.
struct Branches {
    int unfinished = 0, shadowed = 0, lit = 0, unlit = 0, total_reflection = 0, flipped = 0;

    void count(const thesis::ParallaxFrag& f) {
        const Float gate = dot(f.L, f.N_Flat_Shading);
        const Float side = dot(cross(f.T_Flat_Shading, f.B_Flat_Shading), f.N_Flat_Shading);
        for (int k = 0; k < 4; ++k) {
            unfinished += f.Sample.lane[k] == 129.0f;
            unlit += gate.lane[k] <= 0.01f;
            lit += f.Light_Intensity.lane[k] == 1.0f;
            shadowed += gate.lane[k] > 0.01f && f.Light_Intensity.lane[k] == 0.0f;
            total_reflection += f.Refract.x.lane[k] != f.Refract.x.lane[k];
            flipped += side.lane[k] < 0;
        }
    }
};

TEST(Published, InputsReachEveryBranch) {
    Branches reached;
    for (int i = 0; i < 40; ++i) {
        Inputs inputs(i);
        for (int quad = 0; quad < batch_quads; ++quad) reached.count(listing(inputs.batch, quad));
    }
    EXPECT_GT(reached.unfinished, 100);
    EXPECT_GT(reached.shadowed, 100);
    EXPECT_GT(reached.lit, 100);
    EXPECT_GT(reached.unlit, 100);
    EXPECT_GT(reached.total_reflection, 100);
    EXPECT_GT(reached.flipped, 100);
}

}  // namespace
}  // namespace quadrel::test
