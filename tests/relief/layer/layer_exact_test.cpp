// Exact searches of depth layers: never wrong by brute force and by rationals, the pyramid leaves
// out nothing, and what they say where the answer is known.
#include <cstdlib>

#include "effort.hpp"
#include "quadrel/num/quad.hpp"
#include "quadrel/relief/trace/layer/stages.hpp"
#include "relief/layer/layer_oracle.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {
namespace {

constexpr std::array exact_layer_rows{"dual-depth-exact", "multilayer-exact"};

/// Batches of 256 rays a kind of map. Set QUADREL_LAYER_RAYS for more.
int layer_batches(int fewest) {
    const char* const rays = std::getenv("QUADREL_LAYER_RAYS");
    const long wanted = rays != nullptr ? std::atol(rays) : 0;
    return std::max(rounds(fewest),
                    static_cast<int>(wanted / (256 * static_cast<long>(layer_kinds().size()))));
}

/// `check(row's map, batch)` on random rays over every kind of layers.
template <PlainFloat T, class Check>
testing::AssertionResult on_layers(int batches, const Check& check) {
    for (const LayerKind& kind : layer_kinds())
        for (int i = 0; i < batches; ++i) {
            Random random(static_cast<std::uint64_t>(i) * 7919 + 5);
            const LayerMaps maps = random_layer_maps(random, kind);
            Batch<float> rays;
            rays.material.seat =
                random.chance(0.5) ? 1.0f : static_cast<float>(random.below(5)) / 4;
            fill_stress_rays(rays, maps.layers, random);
            Batch<T> batch = in_number<T>(rays);
            batch.material = rays.material;
            maps.bind(batch);
            const testing::AssertionResult result = check(maps, batch);
            if (!result)
                return testing::AssertionFailure()
                       << kind.name << ", batch " << i << ": " << result.message();
        }
    return testing::AssertionSuccess();
}

/// Where a lane hit; infinite where it missed.
template <PlainFloat T>
oracle::Real found_at(Batch<T>& batch, int lane) {
    const bool hit = batch.integer(Value::hit_status, lane) == static_cast<int>(Status::hit);
    return hit ? static_cast<oracle::Real>(batch.real(Value::hit_s, lane))
               : std::numeric_limits<oracle::Real>::infinity();
}

/// Errors of the row's map: what is searched is not what is judged.
std::function<Depths(const Depths&)> flaw_of(const std::string& name) {
    if (name == "a lost layer") return [](const Depths& d) { return Depths{1, 1, d[2], d[3]}; };
    if (name == "parity off by one")
        return [](const Depths& d) { return Depths{d[1], d[2], d[3], 1}; };
    return [](const Depths& d) { return Depths{d[1], d[0], d[3], d[2]}; };
}
constexpr std::array layer_flaws{"a lost layer", "parity off by one", "swapped entry and exit"};

/// A row; or over a map with an error.
template <PlainFloat T>
struct LayerRow {
    std::string id, flaw = {};

    Batch<T> run(const LayerMaps& maps, const Batch<T>& rays) const {
        Batch<T> found = rays;
        if (flaw.empty()) {
            found.run(id);
            return found;
        }
        const LayerMaps others(changed_layers(maps.layers, flaw_of(flaw)));
        others.bind(found);
        found.run(id);
        maps.bind(found);
        return found;
    }
};

// ---- None wrong ---------------------------------------------------------------------------------

/// Solids that are thicker by more than the error are met no later, thinner ones no earlier; a miss
/// is one of the thinner solids at least.
template <PlainFloat T>
testing::AssertionResult no_layer_hit_is_wrong(const LayerRow<T>& row, int batches) {
    return on_layers<T>(batches, [&](const LayerMaps& maps, Batch<T>& rays) {
        Batch<T> found = row.run(maps, rays);
        const oracle::LayerField field(maps.layers.sampled, layers_searched(row.id));
        for (int lane = 0; lane < rays.lanes; ++lane) {
            const oracle::Ray ray = oracle_ray(rays, lane);
            const oracle::Real error = height_error<T>(field.layer(0), ray, 1);
            const oracle::Real rounding = 4 * std::numeric_limits<T>::epsilon();
            const oracle::Real s = found_at(found, lane);
            const oracle::Real first = oracle::meet_layers<oracle::Real>(field, ray, error).s;
            const oracle::Real last = oracle::meet_layers<oracle::Real>(field, ray, -error).s;
            if (s >= first - rounding && s <= last + rounding) continue;
            return testing::AssertionFailure()
                   << "lane " << lane << ": " << double(s) << ", not in " << double(first) << " to "
                   << double(last);
        }
        return testing::AssertionSuccess();
    });
}

TEST(LayersExact, NoHitIsWrong) {
    for (const char* id : exact_layer_rows) {
        EXPECT_TRUE(no_layer_hit_is_wrong<float>({id}, layer_batches(3))) << id;
        EXPECT_TRUE(no_layer_hit_is_wrong<double>({id}, layer_batches(2))) << id;
        for (const char* flaw : layer_flaws)
            EXPECT_FALSE(no_layer_hit_is_wrong<float>({id, flaw}, 1)) << id << ", " << flaw;
    }
}

/// In double, a hit or a miss that is not flagged is the one that rationals decide on.
testing::AssertionResult unflagged_layer_hits_are_decided(const LayerRow<double>& row,
                                                          int batches = 1) {
    return on_layers<double>(batches, [&](const LayerMaps& maps, Batch<double>& rays) {
        Batch<double> found = row.run(maps, rays);
        const oracle::LayerField field(maps.layers.sampled, layers_searched(row.id));
        for (int lane = 0; lane < rounds(48); ++lane) {
            if (found.integer(Value::hit_flags, lane) & HitFlag::ambiguous) continue;
            const oracle::Real s = found_at(found, lane);
            const oracle::Real exact =
                oracle::meet_layers<mpq_class>(field, oracle_ray(rays, lane)).s;
            if (s == exact || std::fabs(s - exact) <= 1e-6L) continue;
            return testing::AssertionFailure()
                   << "lane " << lane << ": " << double(s) << " for " << double(exact);
        }
        return testing::AssertionSuccess();
    });
}

TEST(LayersExact, UnflaggedHitsAreThoseOfRationals) {
    for (const char* id : exact_layer_rows) {
        EXPECT_TRUE(unflagged_layer_hits_are_decided({id}, layer_batches(1))) << id;
        for (const char* flaw : layer_flaws)
            EXPECT_FALSE(unflagged_layer_hits_are_decided({id, flaw})) << id << ", " << flaw;
    }
}

/// No sample of a dense march is inside before the hit, and where one is, there is a hit; rims that
/// are thinner than the row's error are not judged.
testing::AssertionResult brute_force_finds_none_before(const LayerRow<float>& row,
                                                       int batches = 1) {
    constexpr int samples = 20000;
    return on_layers<float>(batches, [&](const LayerMaps& maps, Batch<float>& rays) {
        Batch<float> found = row.run(maps, rays);
        const oracle::LayerField field(maps.layers.sampled, layers_searched(row.id));
        for (int lane = 0; lane < std::max(rounds(8), 4); ++lane) {
            const oracle::Real s = found_at(found, lane);
            const oracle::Ray ray = oracle_ray(rays, lane);
            const oracle::Real error = height_error<float>(field.layer(0), ray, 1);
            const oracle::Real brute = oracle::march_layers(field, ray, samples, error).s;
            if (!(s > brute + 1e-4L)) continue;
            return testing::AssertionFailure()
                   << "lane " << lane << ": " << double(s) << " behind " << double(brute);
        }
        return testing::AssertionSuccess();
    });
}

TEST(LayersExact, BruteForceFindsNoneBefore) {
    for (const char* id : exact_layer_rows) {
        EXPECT_TRUE(brute_force_finds_none_before({id}, layer_batches(1))) << id;
        EXPECT_FALSE(brute_force_finds_none_before({id, "a lost layer"})) << id;
    }
}

// ---- The pyramid --------------------------------------------------------------------------------

/// Every cell on the way.
template <class Row, int layers>
struct LayerWalk : Row {
    template <class Io>
    void operator()(Io& io, const typename Row::Params&) const {
        using F = typename Io::Number;
        LayerSearch<Io, layers> search(io);
        for (;;) {
            search.count_step(1, 2);
            if (!any(search.active)) break;
            const CellExit<F> exit = search.exit(search.cell());
            search.test(search.active, exit);
            search.step(search.active, exit);
        }
        search.store();
    }
};

/// What the pyramid leaves out holds no hit: results have the bits of the walk over all cells.
template <PlainFloat T, class Row, int layers>
testing::AssertionResult walk_finds_the_same(const std::string& flaw, int batches) {
    return on_layers<T>(batches, [&](const LayerMaps& maps, Batch<T>& rays) {
        Batch<T> walked = rays;
        const typename Row::Params none{};
        walked.run(&run_stage<LayerWalk<Row, layers>, Quad<T>>, &none);
        Batch<T> found = LayerRow<T>{Row::text.id, flaw}.run(maps, rays);
        return same_bits<T>(walked, found, agreed_values);
    });
}

TEST(LayersExact, ThePyramidLeavesOutNothing) {
    const auto dual = [](const std::string& flaw, int batches) {
        return walk_finds_the_same<float, DualDepthExact, 2>(flaw, batches);
    };
    const auto multi = [](const std::string& flaw, int batches) {
        return walk_finds_the_same<double, MultilayerExact, 4>(flaw, batches);
    };
    EXPECT_TRUE(dual("", layer_batches(8)));
    EXPECT_TRUE(multi("", layer_batches(8)));
    EXPECT_FALSE(dual("a lost layer", 1));
    EXPECT_FALSE(multi("parity off by one", 1));
}

/// A pyramid over another map's layers does not serve.
TEST(LayersExact, BoundsOfAnotherMapAreFound) {
    const LayerMaps maps = layer_maps("slabs"), others = layer_maps("nothing");
    Random random(4);
    Batch<float> rays;
    fill_stress_rays(rays, maps.layers, random);
    maps.bind(rays);
    Batch<float> wrong = rays;
    wrong.bind(TextureSlot::layer_bounds, others.bounds.sampled);
    rays.run("multilayer-exact");
    wrong.run("multilayer-exact");
    EXPECT_FALSE(same_bits<float>(rays, wrong, agreed_values));
}

// ---- Known answers ------------------------------------------------------------------------------

/// 64 rays over a map of `depths` everywhere.
struct Slabs {
    LayerMaps maps;
    Batch<float> batch{64};

    explicit Slabs(const Depths& depths, float seat = 1)
        : maps(make_map(
              5, 7, 4, [&](int, int, int c) { return depths[static_cast<std::size_t>(c)]; },
              plain_sampler())) {
        Random random(6);
        fill_stress_rays(batch, maps.layers, random);
        batch.material.seat = seat;
        maps.bind(batch);
    }
    Slabs(const Slabs&) = delete;
};

/// All hits are at `depth`, of a layer at that depth; where it is above 1, all rays miss and say
/// so.
testing::AssertionResult meets_at(const std::string& id, const Depths& depths, float depth,
                                  float seat = 1) {
    Slabs slabs(depths, seat);
    Batch<float>& b = slabs.batch;
    b.run(id);
    for (int lane = 0; lane < b.lanes; ++lane) {
        const bool hits = depth <= 1;
        const Status expected = hits ? Status::hit : Status::clip;
        const float s = b.real(Value::hit_s, lane);
        const bool right =
            b.integer(Value::hit_status, lane) == static_cast<int>(expected) &&
            std::abs(s - (hits ? depth : 1)) < 1e-6f &&
            (!hits || std::abs(b.real(Value::hit_h, lane) - (1 - depth)) < 1e-6f) &&
            std::abs(b.real(Value::hit_depth, lane) - (s - (1 - seat)) * b.material.depth) < 1e-6f;
        if (!right) return testing::AssertionFailure() << id << ", lane " << lane << ", s " << s;
    }
    return testing::AssertionSuccess();
}

TEST(LayersExact, SlabsAreMetAtTheirFront) {
    for (const float seat : {1.0f, 0.5f, 0.0f}) {
        for (const char* id : exact_layer_rows) {
            EXPECT_TRUE(meets_at(id, {0.25f, 0.5f, 0.75f, 1}, 0.25f, seat));
            EXPECT_TRUE(meets_at(id, {0, 0.5f, 0.75f, 1}, 0, seat));
            EXPECT_FALSE(meets_at(id, {0.25f, 0.5f, 0.75f, 1}, 0.5f, seat));
        }
        // What the first pair lacks, the second has; and behind nothing there is nothing.
        EXPECT_TRUE(meets_at("multilayer-exact", {0.25f, 0.25f, 0.75f, 1}, 0.75f, seat));
        EXPECT_TRUE(meets_at("dual-depth-exact", {0.25f, 0.25f, 0.75f, 1}, 2, seat));
        EXPECT_TRUE(meets_at("multilayer-exact", {0.25f, 0.25f, 1, 1}, 2, seat));
    }
}

/// A solid without a bottom is a height field: where both are met it is at the same s.
TEST(LayersExact, WithoutABackLayersAreAHeightField) {
    for (int i = 0; i < rounds(12); ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const ExactMaps heights = random_exact_maps(random, stress_maps()[16], 24);
        const TextureView& view = heights.height.sampled.view;
        SamplerState sampler = heights.height.sampled.sampler;
        sampler.border[0] = 1 - sampler.border[0];
        sampler.border[1] = 2;
        const LayerMaps layers(make_map(
            view.width[0], view.height[0], 2,
            [&](int x, int y, int c) {
                return c == 1 ? 2.0f : 1 - view.texels[view.offset[0] + y * view.width[0] + x];
            },
            sampler));
        Batch<float> rays;
        fill_stress_rays(rays, heights.height, random);
        heights.bind(rays);
        layers.bind(rays);
        Batch<float> expected = rays;
        expected.run("texel-exact");
        rays.run("dual-depth-exact");
        for (int lane = 0; lane < rays.lanes; ++lane) {
            if (expected.integer(Value::hit_flags, lane) & HitFlag::ambiguous) continue;
            const float s = expected.real(Value::hit_s, lane);
            if (s > 0.999f) continue;  // the bottom plane is a surface to heights alone
            EXPECT_NEAR(rays.real(Value::hit_s, lane), s, 2e-4) << i << ", " << lane;
        }
    }
}

/// Mirrored in u, with the rays, hits have the same s.
testing::AssertionResult is_mirrored(const std::string& id, float tilt) {
    Random random(12);
    SamplerState sampler = plain_sampler();
    const Map map = make_layers(layer_kinds()[2], 16, 8, 4, sampler, random);
    const TextureView& view = map.sampled.view;
    const LayerMaps right(map),
        left(make_map(
            16, 8, 4, [&](int x, int y, int c) { return view.texels[(y * 16 + 15 - x) * 4 + c]; },
            sampler));
    Batch<float> a;
    for (int lane = 0; lane < a.lanes; ++lane) {
        a.set(Value::uv, lane, dvec2(random.below(4096) / 4096.0, random.below(4096) / 4096.0));
        a.set(Value::K, lane, dvec2(random.below(512) / 512.0, random.below(512) / 512.0 - 0.5));
        a.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
        a.integer(Value::frame_flags, lane) = 0;
    }
    Batch<float> b = a;
    for (int lane = 0; lane < a.lanes; ++lane) {
        b.real(Value::uv, lane, 0) = 1 - a.real(Value::uv, lane, 0);
        b.real(Value::K, lane, 0) = -a.real(Value::K, lane, 0) + tilt;
    }
    right.bind(a);
    left.bind(b);
    a.run(id);
    b.run(id);
    for (int lane = 0; lane < a.lanes; ++lane) {
        if (a.integer(Value::hit_flags, lane) & HitFlag::ambiguous) continue;
        if (std::abs(a.real(Value::hit_s, lane) - b.real(Value::hit_s, lane)) > 1e-4f)
            return testing::AssertionFailure() << id << ", lane " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(LayersExact, MirroredMapsAreMetAtTheSameDepth) {
    for (const char* id : exact_layer_rows) {
        EXPECT_TRUE(is_mirrored(id, 0));
        EXPECT_FALSE(is_mirrored(id, 0.05f));
    }
}

/// Lanes that cannot be searched, and maps that are broken, say so; without depth nothing moves.
TEST(LayersExact, WhatIsNoNumberSaysSo) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const char* id : exact_layer_rows) {
        Slabs broken({0.5f, nan, 0.75f, 1});
        broken.batch.run(id);
        Slabs rays({0.25f, 0.5f, 0.75f, 1});
        rays.batch.real(Value::uv, 3, 0) = nan;
        rays.batch.real(Value::K, 4, 0) = 1e7f;
        rays.batch.integer(Value::frame_status, 5) = static_cast<int>(Status::no_frame);
        rays.batch.run(id);
        const auto status = [](Batch<float>& b, int lane) {
            return static_cast<Status>(b.integer(Value::hit_status, lane));
        };
        EXPECT_EQ(status(broken.batch, 0), Status::nan);
        EXPECT_EQ(status(rays.batch, 3), Status::nan);
        EXPECT_EQ(status(rays.batch, 4), Status::cap);
        EXPECT_EQ(status(rays.batch, 5), Status::no_frame);
        EXPECT_EQ(status(rays.batch, 6), Status::hit);
        Slabs flat({0.25f, 0.5f, 0.75f, 1}, 0.75f);
        flat.batch.material.depth = 0;
        for (int lane = 0; lane < flat.batch.lanes; ++lane)
            flat.batch.set(Value::K, lane, dvec2(0));
        flat.batch.run(id);
        for (int lane = 0; lane < flat.batch.lanes; ++lane) {
            EXPECT_EQ(flat.batch.real(Value::hit_depth, lane), 0);
            EXPECT_EQ(flat.batch.vector2(Value::hit_uv, lane), flat.batch.vector2(Value::uv, lane));
        }
    }
}

/// Whether a ray keeps to a border between cells, begins close before one, or is at a corner: where
/// a front and a back meet there, a rounding decides whether it comes through the cell at all.
bool is_at_rim(const oracle::LayerField& field, const oracle::Ray& ray, oracle::Real s) {
    const oracle::LayerRay<oracle::Real> along(field.layer(0), ray);
    const auto is_on_border = [s](oracle::Real start, oracle::Real rate) {
        const oracle::Real at = start + rate * s;
        return std::fabs(at - std::round(at)) < 1e-5L;
    };
    const bool on_x = is_on_border(along.x, along.dx), on_y = is_on_border(along.y, along.dy);
    const bool begins = s > 0 && s < 1e-5L;
    return (on_x && (on_y || begins || along.dx == 0)) || (on_y && (begins || along.dy == 0));
}

/// Where thinning the solids by eight roundings makes the hit jump, it is flagged. (Thickening them
/// makes walls of rims where front and back meet, which a ray may pass or not by a rounding.)
template <PlainFloat T>
testing::AssertionResult flags_layer_grazes(const std::string& id, bool unflagged) {
    int jumps = 0;
    const auto result =
        on_layers<T>(std::max(3, layer_batches(3)), [&](const LayerMaps& maps, Batch<T>& rays) {
            constexpr oracle::Real nudge = 4 * std::numeric_limits<T>::epsilon();
            Batch<T> found = LayerRow<T>{id}.run(maps, rays);
            const oracle::LayerField field(maps.layers.sampled, layers_searched(id));
            for (int lane = 0; lane < rays.lanes; ++lane) {
                const oracle::Ray ray = oracle_ray(rays, lane);
                const oracle::Real first = oracle::meet_layers<oracle::Real>(field, ray).s;
                const oracle::Real last = oracle::meet_layers<oracle::Real>(field, ray, -nudge).s;
                if (first == last || last - first <= std::sqrt(nudge) * 64) continue;
                if (is_at_rim(field, ray, first)) continue;
                ++jumps;
                const int flags = found.integer(Value::hit_flags, lane);
                if ((flags & HitFlag::ambiguous) != 0 && !unflagged) continue;
                return testing::AssertionFailure()
                       << "lane " << lane << ": " << double(first) << " to " << double(last);
            }
            return testing::AssertionSuccess();
        });
    if (result && jumps == 0) return testing::AssertionFailure() << "no grazes";
    return result;
}

TEST(LayersExact, GrazesAreFlagged) {
    for (const char* id : exact_layer_rows) {
        EXPECT_TRUE(flags_layer_grazes<float>(id, false)) << id;
        EXPECT_FALSE(flags_layer_grazes<float>(id, true)) << id;
    }
}

}  // namespace
}  // namespace quadrel::test
