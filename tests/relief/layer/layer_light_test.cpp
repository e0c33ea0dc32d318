// Shadows through depth layers, and normals of the layer that is met, against the layers' own
// values in double.
#include "effort.hpp"
#include "relief/layer/layer_oracle.hpp"
#include "relief/surface_rays.hpp"

namespace quadrel::test {
namespace {

/// Hits of multilayer-exact, a plane for all of them, and a directional light on their side.
class LitLayers {
  public:
    LayerMaps maps;
    Batch<float> batch{64};

    LitLayers(const LayerMaps& of, int seed, double least_r = 0.3) : maps(of) {
        Random random(static_cast<std::uint64_t>(seed) * 31 + 7);
        fill_surface(batch, random, {.least_r = least_r, .depth = 0.1});
        for (int lane = 0; lane < batch.lanes; ++lane) {
            for (const Value v : {Value::T, Value::B, Value::frame_normal, Value::Ng})
                batch.set(v, lane, batch.vector3(v, 0));
            for (int c = 0; c < 6; ++c) batch.real(Value::J, lane, c) = batch.real(Value::J, 0, c);
        }
        maps.bind(batch);
        batch.run("multilayer-exact");
        const double azimuth = random.uniform(0, 6.28), elevation = random.uniform(0.2, 1.5);
        const dvec3 T(batch.vector3(Value::T, 0)), B(batch.vector3(Value::B, 0));
        const dvec3 N(batch.vector3(Value::frame_normal, 0));
        const dvec3 L =
            (T * quadrel::cos(azimuth) + B * quadrel::sin(azimuth)) * quadrel::cos(elevation) +
            N * quadrel::sin(elevation);
        batch.frame.lights[0].directional = 1;
        for (int c = 0; c < 3; ++c) batch.frame.lights[0].position[c] = static_cast<float>(L[c]);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            batch.set(Value::hit_P, lane, batch.vector3(Value::P, lane));
            const dvec3 u(batch.vector3(Value::J, lane, 0)), v(batch.vector3(Value::J, lane, 3));
            shifts.push_back(dvec2(dot(u, L), dot(v, L)) * (batch.material.depth / dot(L, N)));
        }
    }
    LitLayers(const LitLayers&) = delete;

    std::vector<dvec2> shifts;  ///< K of each lane's light ray
    bool hit(int lane) {
        return batch.integer(Value::hit_status, lane) == static_cast<int>(Status::hit);
    }
};

/// How far a point at depth s is inside of a solid; below 0 outside.
double depth_inside(const oracle::LayerField& field, const dvec2& uv, double s) {
    double most = -1;
    for (int pair = 0; pair < field.layers(); pair += 2) {
        const auto at = [&](int layer) {
            const oracle::Field& of = field.layer(layer);
            return static_cast<double>(
                of.bilinear(uv.x * of.width - 0.5L, uv.y * of.height - 0.5L));
        };
        most = std::max(most, std::min(s - at(pair), at(pair + 1) - s));
    }
    return most;
}

enum class Lit { dark, clear, undecided };

/// By dense samples from the layer that a lane has met; what lies within rounding is undecided.
Lit light_of(LitLayers& lit, const oracle::LayerField& field, int lane) {
    const dvec2 uv(lit.batch.vector2(Value::hit_uv, lane));
    const dvec2 K = lit.shifts[static_cast<std::size_t>(lane)];
    const double top = lit.batch.real(Value::hit_s, lane);
    bool close = false;
    constexpr int samples = 800;
    for (int k = 1; k <= samples; ++k) {
        const double t = top * k / samples;
        const double inside = depth_inside(field, uv + K * t, top - t);
        if (inside > 1e-3) return Lit::dark;
        close |= inside > (k < samples / 50 ? 1e-5 : -1e-3);
    }
    return close ? Lit::undecided : Lit::clear;
}

testing::AssertionResult shadows_as_the_layers_do(const StageUnderTest<float>& shadow,
                                                  const Parameters& parameters = {}) {
    int dark = 0, clear = 0, undecided = 0;
    const char* const names[] = {"grid", "white noise", "sheet", "ceiling", "flakes"};
    for (int seed = 0; seed < (sanitized ? 5 : 15); ++seed) {
        LitLayers lit(layer_maps(names[seed % 5], seed), seed);
        const oracle::LayerField field(lit.maps.layers.sampled, 4);
        std::vector<Lit> truth;
        for (int lane = 0; lane < lit.batch.lanes; ++lane)
            truth.push_back(lit.hit(lane) ? light_of(lit, field, lane) : Lit::undecided);
        shadow.run(lit.batch, parameters);
        for (int lane = 0; lane < lit.batch.lanes; ++lane) {
            const Lit expected = truth[static_cast<std::size_t>(lane)];
            dark += expected == Lit::dark;
            clear += expected == Lit::clear;
            undecided += expected == Lit::undecided && lit.hit(lane);
            const float found = lit.batch.real(Value::shadow_visibility, lane);
            if (expected == Lit::undecided || found == (expected == Lit::dark ? 0.0f : 1.0f))
                continue;
            return testing::AssertionFailure() << names[seed % 5] << " " << seed << ", lane "
                                               << lane << ": visibility " << found;
        }
    }
    if (dark < (sanitized ? 5 : 30) || clear < 40 || undecided > dark + clear)
        return testing::AssertionFailure()
               << dark << " dark, " << clear << " clear, " << undecided << " undecided";
    return testing::AssertionSuccess();
}

/// Another map's layers in place of those that are judged.
std::function<void(Batch<float>&)> over_changed_layers(
    const std::function<Depths(const Depths&)>& change) {
    auto kept = std::make_shared<Map>();
    return [=](Batch<float>& batch) {
        *kept = changed_layers(Map{nullptr, *batch.bound(TextureSlot::layers)}, change);
        batch.bind(TextureSlot::layers, kept->sampled);
    };
}

TEST(LayerLight, ShadowsAreThoseOfTheLayers) {
    EXPECT_TRUE(shadows_as_the_layers_do({"shadow-layers-exact"}));
    // Short solids are missed by what marches.
    EXPECT_FALSE(shadows_as_the_layers_do({"shadow-layers"}, {{"steps", 8}}));
    EXPECT_FALSE(
        shadows_as_the_layers_do({"shadow-layers-exact", over_changed_layers([](const Depths& d) {
                                      return Depths{d[0], d[0], d[2], d[3]};
                                  })}));
    EXPECT_FALSE(
        shadows_as_the_layers_do({"shadow-layers-exact", over_changed_layers([](const Depths& d) {
                                      return Depths{d[1], d[0], d[3], d[2]};
                                  })}));
}

/// A march of small steps is dark where the exact shadow is, but for what is thinner than they.
TEST(LayerLight, SmallStepsComeDownOnTheExactShadow) {
    int same_lanes = 0, lanes = 0;
    for (int seed = 0; seed < rounds(10); ++seed) {
        LitLayers lit(layer_maps(seed % 2 == 0 ? "grid" : "ceiling", seed), seed);
        Batch<float> exact = lit.batch;
        exact.run("shadow-layers-exact");
        lit.batch.run("shadow-layers", {{"steps", 4000}});
        for (int lane = 0; lane < exact.lanes; ++lane) {
            if (!lit.hit(lane)) continue;
            ++lanes;
            same_lanes += lit.batch.real(Value::shadow_visibility, lane) ==
                          exact.real(Value::shadow_visibility, lane);
        }
    }
    EXPECT_GT(lanes, rounds(100));
    EXPECT_GE(same_lanes, lanes - lanes / 20);
}

/// Lights behind the surface are dark, and without depth nothing shadows.
TEST(LayerLight, LightsBehindAreDark) {
    for (const char* id : {"shadow-layers", "shadow-layers-exact"}) {
        LitLayers lit(layer_maps("grid"), 3);
        Batch<float> behind = lit.batch, flat = lit.batch;
        for (float& x : behind.frame.lights[0].position) x = -x;
        behind.run(id);
        flat.material.depth = 0;
        flat.run(id);
        for (int lane = 0; lane < flat.lanes; ++lane) {
            EXPECT_EQ(behind.real(Value::shadow_visibility, lane), 0);
            EXPECT_EQ(flat.real(Value::shadow_visibility, lane), 1);
        }
    }
}

// ---- Normals ------------------------------------------------------------------------------------

/// At each hit, the gradient of the layer that is met by differences within its cell; backs face
/// down.
testing::AssertionResult has_the_normals_of_the_layers(const StageUnderTest<float>& surface) {
    int fronts = 0, backs = 0;
    const char* const names[] = {"flakes", "white noise", "flakes", "sheet"};
    for (int seed = 0; seed < 16; ++seed) {
        LitLayers lit(layer_maps(names[seed % 4], seed), seed, 0.1);
        Batch<float>& b = lit.batch;
        const oracle::LayerField field(lit.maps.layers.sampled, 4);
        surface.run(b);
        for (int lane = 0; lane < b.lanes; ++lane) {
            if (!lit.hit(lane) || b.integer(Value::hit_flags, lane) & HitFlag::ambiguous) continue;
            const dvec2 uv(b.vector2(Value::hit_uv, lane));
            const double x = uv.x * 16 - 0.5, y = uv.y * 16 - 0.5, e = 1e-5;
            const auto from_border = [](double at) { return std::abs(at - std::round(at)); };
            if (from_border(x) < 1e-3 || from_border(y) < 1e-3) continue;
            double next[2] = {1, 1};
            int met = 0;
            for (int layer = 0; layer < 4; ++layer) {
                const double away = std::abs(double(field.layer(layer).bilinear(x, y)) -
                                             b.real(Value::hit_s, lane));
                if (away < next[0]) {
                    next[1] = next[0];
                    next[0] = away;
                    met = layer;
                } else {
                    next[1] = std::min(next[1], away);
                }
            }
            if (next[1] < 1e-3) continue;  // two layers meet
            const oracle::Field& of = field.layer(met);
            const double du = double(of.bilinear(x + e, y) - of.bilinear(x - e, y)) * 16 / (2 * e);
            const double dv = double(of.bilinear(x, y + e) - of.bilinear(x, y - e)) * 16 / (2 * e);
            const dvec3 u(b.vector3(Value::J, lane, 0)), v(b.vector3(Value::J, lane, 3));
            const dvec3 N(b.vector3(Value::frame_normal, lane));
            const double D = b.material.depth;
            const dvec3 up = normalize(N + (u * du + v * dv) * D);
            const dvec3 expected = met % 2 == 0 ? up : -up;
            met % 2 == 0 ? ++fronts : ++backs;
            const double off = length(dvec3(b.vector3(Value::N, lane)) - expected);
            if (off > 1e-3)
                return testing::AssertionFailure()
                       << names[seed % 4] << ", lane " << lane << ", layer " << met << ": " << off;
        }
    }
    if (fronts < 50 || backs < 5)
        return testing::AssertionFailure() << fronts << " fronts, " << backs << " backs";
    return testing::AssertionSuccess();
}

TEST(LayerLight, NormalsAreThoseOfTheLayerThatIsMet) {
    EXPECT_TRUE(has_the_normals_of_the_layers({"h2n-layers"}));
    const auto turned = [](Batch<float>& b) {
        for (int lane = 0; lane < b.lanes; ++lane)
            b.set(Value::N, lane, -b.vector3(Value::N, lane));
    };
    EXPECT_FALSE(has_the_normals_of_the_layers({"h2n-layers", {}, turned}));
    EXPECT_FALSE(
        has_the_normals_of_the_layers({"h2n-layers", over_changed_layers([](const Depths& d) {
                                           return Depths{d[1], d[0], d[3], d[2]};
                                       })}));
    EXPECT_FALSE(has_the_normals_of_the_layers({"surface-none"}));
}

}  // namespace
}  // namespace quadrel::test
