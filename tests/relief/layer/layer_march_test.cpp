// Marches through depth layers: the first sample of their lattice that is inside of a solid, halved
// towards the one before; dual-depth@published by its listing.
#include "effort.hpp"
#include "relief/layer/layer_oracle.hpp"
#include "relief/listing_runs.hpp"

namespace quadrel::test {
namespace {

// ---- The corrected rows -------------------------------------------------------------------------

/// How many of the layers are at or above depth s of a ray; less by `off` where that is close.
int layers_passed(const oracle::LayerField& field, const oracle::Ray& ray, oracle::Real s,
                  oracle::Real off) {
    const oracle::LayerRay<oracle::Real> along(field.layer(0), ray);
    int passed = 0;
    for (int layer = 0; layer < field.layers(); ++layer)
        passed +=
            field.layer(layer).bilinear(along.x + along.dx * s, along.y + along.dy * s) <= s - off;
    return passed;
}

/// Whether s is inside of a solid; 2: rounding may decide.
int inside_at(const oracle::LayerField& field, const oracle::Ray& ray, oracle::Real s) {
    const int low = layers_passed(field, ray, s, 1e-5L),
              high = layers_passed(field, ray, s, -1e-5L);
    return low == high ? low % 2 : 2;
}

using MarchChange = std::function<void(Batch<float>&)>;

/// Over any layers: the hit is in the first step whose end is inside, at its end or, halved, before
/// it; no such step is a miss.
testing::AssertionResult keeps_to_its_lattice(const std::string& id, int steps, int halvings,
                                              const MarchChange& before = {},
                                              const MarchChange& after = {}) {
    int hits = 0, misses = 0;
    for (std::size_t k = 0; k < layer_kinds().size() * std::size_t(rounds(4)); ++k) {
        Random random(static_cast<std::uint64_t>(k) + 3);
        const LayerMaps maps = random_layer_maps(random, layer_kinds()[k % layer_kinds().size()]);
        Batch<float> rays(64);
        fill_stress_rays(rays, maps.layers, random);
        rays.material.seat = static_cast<float>(random.below(5)) / 4;
        maps.bind(rays);
        Batch<float> given = rays;
        if (before) before(rays);
        rays.run(id, {{"steps", steps}, {"binary_steps", halvings}});
        if (after) after(rays);
        const oracle::LayerField field(maps.layers.sampled, layers_searched(id));
        for (int lane = 0; lane < rays.lanes; ++lane) {
            const oracle::Ray ray = oracle_ray(given, lane);
            int first = 0, close = 0;
            for (; first <= steps; ++first) {
                const int inside = inside_at(field, ray, oracle::Real(first) / steps);
                close += inside == 2;
                if (inside == 1) break;
            }
            if (close > 0) continue;
            const bool hit = first <= steps;
            hit ? ++hits : ++misses;
            const auto status = static_cast<Status>(rays.integer(Value::hit_status, lane));
            const double s = rays.real(Value::hit_s, lane), end = double(first) / steps;
            const bool in_step = hit ? s <= end && (s > end - 1.0 / steps || first == 0) : s == 1;
            const bool at_end = halvings > 0 || !hit || s == static_cast<float>(end);
            if (status != (hit ? Status::hit : Status::clip) || !in_step || !at_end)
                return testing::AssertionFailure()
                       << id << ", map " << k << ", lane " << lane << ": " << s << " for " << end;
            if (hit && inside_at(field, ray, rays.real(Value::hit_s, lane)) == 0)
                return testing::AssertionFailure() << id << ", lane " << lane << ": outside";
        }
    }
    if (hits < rounds(300) || misses < rounds(40))
        return testing::AssertionFailure() << hits << " hits, " << misses << " misses";
    return testing::AssertionSuccess();
}

TEST(LayerMarch, TheFirstSampleInsideIsTheHit) {
    for (const char* id : {"dual-depth", "multilayer"}) {
        EXPECT_TRUE(keeps_to_its_lattice(id, 64, 0));
        EXPECT_TRUE(keeps_to_its_lattice(id, 16, 6));
        const auto late = [](Batch<float>& b) {
            for (int lane = 0; lane < b.lanes; ++lane) b.real(Value::hit_s, lane) += 1.0f / 16;
        };
        const auto no_miss = [](Batch<float>& b) {
            for (int lane = 0; lane < b.lanes; ++lane)
                b.integer(Value::hit_status, lane) = static_cast<int>(Status::hit);
        };
        const auto moved = [](Batch<float>& b) {
            for (int lane = 0; lane < b.lanes; ++lane) b.real(Value::uv, lane, 0) += 0.1f;
        };
        EXPECT_FALSE(keeps_to_its_lattice(id, 16, 6, {}, late));
        EXPECT_FALSE(keeps_to_its_lattice(id, 16, 6, {}, no_miss));
        EXPECT_FALSE(keeps_to_its_lattice(id, 16, 6, moved));
    }
    // With half of the layers, or parity of three.
    EXPECT_FALSE(keeps_to_its_lattice("multilayer", 16, 6, [](Batch<float>& b) {
        static Map lost;
        const Map whole{nullptr, *b.bound(TextureSlot::layers)};
        lost = changed_layers(whole, [](const Depths& d) { return Depths{d[0], d[1], 1, 1}; });
        b.bind(TextureSlot::layers, lost.sampled);
    }));
    EXPECT_FALSE(keeps_to_its_lattice("multilayer", 16, 6, [](Batch<float>& b) {
        static Map odd;
        const Map whole{nullptr, *b.bound(TextureSlot::layers)};
        odd = changed_layers(whole, [](const Depths& d) { return Depths{d[1], d[2], d[3], 2}; });
        b.bind(TextureSlot::layers, odd.sampled);
    }));
}

/// Halving comes down on the exact entry where the step holds but one.
TEST(LayerMarch, HalvingComesDownOnTheEntry) {
    for (const char* name : {"slabs", "ceiling"}) {
        const LayerMaps maps = layer_maps(name);
        Random random(9);
        Batch<float> rays;
        fill_stress_rays(rays, maps.layers, random);
        maps.bind(rays);
        Batch<float> exact = rays;
        exact.run("multilayer-exact");
        rays.run("multilayer", {{"steps", 512}, {"binary_steps", 10}});
        int compared = 0;
        for (int lane = 0; lane < rays.lanes; ++lane) {
            const dvec2 K(rays.vector2(Value::K, lane));
            if (std::abs(K.x) + std::abs(K.y) > 1) continue;
            ++compared;
            EXPECT_NEAR(rays.real(Value::hit_s, lane), exact.real(Value::hit_s, lane), 1e-5)
                << name << ", lane " << lane;
        }
        EXPECT_GT(compared, 100);
    }
}

TEST(LayerMarch, BrokenLayersAreNan) {
    Random random(2);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Map broken = make_map(
        4, 4, 4, [&](int, int, int c) { return c == 1 ? nan : 0.5f; }, plain_sampler());
    for (const char* id : {"dual-depth", "multilayer", "dual-depth@published"}) {
        Batch<float> rays(64);
        fill_surface(rays, random);
        rays.bind(TextureSlot::layers, broken.sampled);
        rays.run(id);
        const bool reads_it = std::string(id) != "dual-depth@published";
        EXPECT_EQ(rays.integer(Value::hit_status, 0) == static_cast<int>(Status::nan), reads_it);
    }
}

// ---- The listing --------------------------------------------------------------------------------

/// ET:Legacy, reliefMapping_fp.glsl, RayIntersectDisplaceMap with RM_DOUBLEDEPTH: its steps in its
/// order, in words of this project. `front` and `back` read alpha and blue at one coordinate.
struct LegacySearch {
    float depth_step, size, depth = 0, best = 1;
    int fetches = 0;

    explicit LegacySearch(int linear_steps)
        : depth_step(1.0f / static_cast<float>(linear_steps)), size(depth_step) {}

    template <class Look>
    float run(int linear_steps, int binary_steps, const Look& look) {
        // From the front: steps of depth, all but the last; the first at or below alpha is kept.
        for (int i = 0; i < linear_steps - 1; ++i) {
            depth += size;
            const auto [front, back] = look(depth);
            ++fetches;
            if (best > 0.996f && depth >= front) best = depth;
        }
        depth = best;
        // Around it: half steps, back only where both tests hold, one inside the other.
        for (int i = 0; i < binary_steps; ++i) {
            size *= 0.5f;
            const auto [front, back] = look(depth);
            ++fetches;
            if (depth >= front) {
                if (depth <= back) {
                    best = depth;
                    depth -= 2.0f * size;
                }
            }
            depth += size;
        }
        return best;
    }
};

/// Both look-ups of a depth, alpha first. All four fragments of a quad make the same number of
/// look-ups, so that each of them has the gradients of its neighbours' coordinates.
testing::AssertionResult equals_the_engine(const std::string& id, int steps, int halvings,
                                           float scale, const MarchChange& before = {}) {
    for (int seed = 0; seed < rounds(40); ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const Map map = random_map(random, 4);
        Batch<float> batch(64);
        fill_surface(batch, random, {0.1, 0.2, 1, 0.0005, 0.4, true});
        batch.bind(TextureSlot::layers, map.sampled);
        Batch<float> given = batch;
        if (before) before(batch);
        batch.run(id,
                  id == "dual-depth"
                      ? Parameters{}
                      : Parameters{{"steps", steps}, {"binary_steps", halvings}, {"scale", scale}});
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            std::array<LegacySearch, 4> searches{LegacySearch(steps), LegacySearch(steps),
                                                 LegacySearch(steps), LegacySearch(steps)};
            std::array<Vec2, 4> S;
            for (int i = 0; i < 4; ++i) {
                // V normalised along the tangents; S = V.xy * -u_DepthScale / V.z
                const Vec3 V = normalize(tangent_view(given, 4 * quad + i));
                S[static_cast<std::size_t>(i)] = {V.x * -scale / V.z, V.y * -scale / V.z};
            }
            // Fragment after fragment, each with the depths that the others have by then.
            std::vector<std::array<vec4<float>, 4>> known;
            const int looks = steps - 1 + halvings;
            for (int n = 0; n <= looks; ++n) {
                vec2<Fetch> at;
                for (int i = 0; i < 4; ++i) {
                    const auto lane = static_cast<std::size_t>(i);
                    int made = 0;
                    float asked = 0;
                    searches[lane] = LegacySearch(steps);
                    searches[lane].run(steps, halvings, [&](float depth) {
                        if (made == n) asked = depth;
                        const bool has = made < n;
                        const vec4<float> t =
                            has ? known[static_cast<std::size_t>(made)][lane] : vec4<float>(0.0f);
                        ++made;
                        return std::pair(t.w, t.z);
                    });
                    const Vec2 uv = given.vector2(Value::uv, 4 * quad + i);
                    at.x.lane[lane] = uv.x + S[lane].x * asked;
                    at.y.lane[lane] = uv.y + S[lane].y * asked;
                }
                if (n == looks) break;
                const vec4<Fetch> t = texture(map.sampled, SampleContext<Fetch>(), at);
                known.emplace_back();
                for (std::size_t i = 0; i < 4; ++i)
                    known.back()[i] = {t.x.lane[i], t.y.lane[i], t.z.lane[i], t.w.lane[i]};
            }
            for (int i = 0; i < 4; ++i) {
                const int lane = 4 * quad + i;
                const auto k = static_cast<std::size_t>(i);
                const float best = searches[k].best;
                const Vec2 uv = given.vector2(Value::uv, lane) + S[k] * best;
                const Status status = best < 1 ? Status::hit : Status::floor;
                const bool equal =
                    same(batch.real(Value::hit_s, lane), best) &&
                    same(batch.real(Value::hit_uv, lane, 0), uv.x) &&
                    same(batch.real(Value::hit_uv, lane, 1), uv.y) &&
                    batch.integer(Value::hit_status, lane) == static_cast<int>(status) &&
                    batch.integer(Value::hit_fetches, lane) == searches[k].fetches;
                if (!equal)
                    return testing::AssertionFailure()
                           << seed << ", lane " << lane << ": " << batch.real(Value::hit_s, lane)
                           << " for " << best;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(LayerMarch, TheEnginesListingIsReproducedBitForBit) {
    EXPECT_TRUE(equals_the_engine("dual-depth@published", 16, 6, 0.03f));
    EXPECT_TRUE(equals_the_engine("dual-depth@published", 40, 3, -0.2f));
    EXPECT_FALSE(equals_the_engine("dual-depth", 16, 6, 0.03f));
    EXPECT_FALSE(equals_the_engine("dual-depth@published", 16, 6, 0.03f, [](Batch<float>& b) {
        for (int lane = 8; lane < 12; ++lane) b.real(Value::T, lane, 0) *= 1.001f;
    }));
}

/// What the listing gets wrong: a ray behind the back depth stops at the front's first sample.
TEST(LayerMarch, TheEngineHasNoMisses) {
    Random random(5);
    const Map sheet = make_map(
        4, 4, 4,
        [](int, int, int c) {
            return std::array{0.22f, 0.24f, 0.24f, 0.22f}[std::size_t(c)];
        },
        plain_sampler());
    Batch<float> rays(64);
    fill_surface(rays, random, {.least_r = 0.5});
    rays.bind(TextureSlot::layers, sheet.sampled);
    Batch<float> corrected = rays;
    rays.run("dual-depth@published");
    corrected.run("dual-depth");
    for (int lane = 0; lane < rays.lanes; ++lane) {
        EXPECT_EQ(rays.integer(Value::hit_status, lane), static_cast<int>(Status::hit));
        EXPECT_EQ(corrected.integer(Value::hit_status, lane), static_cast<int>(Status::clip));
    }
}

}  // namespace
}  // namespace quadrel::test
