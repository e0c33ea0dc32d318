// Searches in safe steps: their listings bit for bit, and what the corrected ones promise.
#include "relief/cone/cone_listings.hpp"
#include "relief/cone/cone_maps.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {
namespace {

using listings::ConeEnd;
using listings::ConeSampler;
using listings::ConeVec2;
using listings::ConeVec3;

// ---- Listings -----------------------------------------------------------------------------------

/// One level of a baked map, bilinear, at one coordinate.
template <int channels>
std::array<float, channels> read_map(const SampledTexture& map, const ConeVec2& uv, int layer = 0) {
    auto level = level_geometry<Fetch>(map.view, 0);
    level.offset =
        level.offset + Int<Fetch>(layer * map.view.width[0] * map.view.height[0] * channels);
    const auto texel = sample_linear<channels, Fetch>(map, level, {Fetch(uv.x), Fetch(uv.y)});
    std::array<float, channels> out;
    for (int c = 0; c < channels; ++c) out[c] = texel.channel[c].lane[0];
    return out;
}

ConeSampler cones_of(Batch<float>& batch, TextureSlot slot) {
    const SampledTexture* map = batch.bound(slot);
    return [map](const ConeVec2& uv) {
        const auto texel = read_map<2>(*map, uv);
        return ConeVec2(texel[0], texel[1]);
    };
}

/// The same map with each texel's root in place of its ratio.
ConeSampler roots_of(Batch<float>& batch, TextureSlot slot) {
    struct Roots {
        std::vector<float> texels;
        SampledTexture map;
    };
    const auto roots = std::make_shared<Roots>();
    roots->map = *batch.bound(slot);
    const TextureView& view = roots->map.view;
    for (int k = 0; k < 2 * view.width[0] * view.height[0]; ++k)
        roots->texels.push_back(k % 2 ? std::sqrt(view.texels[k]) : view.texels[k]);
    roots->map.view.texels = roots->texels.data();
    return [roots](const ConeVec2& uv) {
        const auto texel = read_map<2>(roots->map, uv);
        return ConeVec2(texel[0], texel[1]);
    };
}

/// Ratios, interpolated, and then their roots.
ConeSampler roots_of_interpolated(const ConeSampler& ratios) {
    return [=](const ConeVec2& uv) {
        const ConeVec2 texel = ratios(uv);
        return ConeVec2(texel.x, std::sqrt(texel.y));
    };
}

/// A map of roots, interpolated after squaring.
ConeSampler squared_first(Batch<float>& batch, TextureSlot slot) {
    SampledTexture map = *batch.bound(slot);
    const auto squares = std::make_shared<std::vector<float>>();
    for (int k = 0; k < 2 * map.view.width[0] * map.view.height[0]; ++k)
        squares->push_back(k % 2 ? map.view.texels[k] * map.view.texels[k] : map.view.texels[k]);
    map.view.texels = squares->data();
    return roots_of_interpolated([squares, map](const ConeVec2& uv) {
        const auto texel = read_map<2>(map, uv);
        return ConeVec2(texel[0], texel[1]);
    });
}

/// A stage and its listing for one lane.
struct ConeListing {
    std::string id;
    std::function<ConeEnd(Batch<float>&, int lane)> run;
    std::string corrected;  ///< a stage that this one must not be taken for
};

/// The unit view ray; upwards seen from behind.
ConeVec3 rabbid_direction(Batch<float>& b, int lane) {
    const ConeVec3 V = ConeVec3(0.0f) - b.vector3(Value::P, lane);
    const float frontFace = dot(b.vector3(Value::Ng, lane), V) < 0 ? -1.0f : 1.0f;
    return normalize(ConeVec3(b.vector2(Value::K, lane), -frontFace));
}

ConeVec2 map_size(Batch<float>& b) {
    const TextureView& view = b.bound(TextureSlot::cone)->view;
    return {static_cast<float>(view.width[0]), static_cast<float>(view.height[0])};
}

ConeEnd rabbid_by(Batch<float>& b, int lane, const ConeSampler& cones) {
    return listings::rabbid_cone_step(rabbid_direction(b, lane), b.vector2(Value::uv, lane),
                                      map_size(b), cones);
}

ConeEnd dummer_by(Batch<float>& b, int lane, const ConeSampler& cones) {
    return listings::dummer_exact(normalize(ConeVec3(b.vector2(Value::K, lane), 1.0f)),
                                  b.vector2(Value::uv, lane),
                                  static_cast<int>(std::max(map_size(b).x, map_size(b).y)), cones);
}

std::vector<ConeListing> cone_listings() {
    const auto K = [](Batch<float>& b, int lane) { return b.vector2(Value::K, lane); };
    const auto uv = [](Batch<float>& b, int lane) { return b.vector2(Value::uv, lane); };
    return {
        {"cone-rabbid",
         [](Batch<float>& b, int lane) {
             return rabbid_by(b, lane, cones_of(b, TextureSlot::cone_rabbid));
         },
         "cone-step"},
        {"cone-rabbid-float",
         [](Batch<float>& b, int lane) {
             return rabbid_by(b, lane, roots_of(b, TextureSlot::cone));
         },
         "cone-step"},
        {"cone-dummer-exact",
         [](Batch<float>& b, int lane) {
             return dummer_by(b, lane, roots_of(b, TextureSlot::cone));
         },
         "cone-step"},
        {"cone-gg3",
         [=](Batch<float>& b, int lane) {
             const float r = b.real(Value::r, lane);
             return listings::gg3_cone(uv(b, lane), K(b, lane) * r, r,
                                       cones_of(b, TextureSlot::cone));
         },
         "cone-step"},
        {"relaxed-cone@published",
         [=](Batch<float>& b, int lane) {
             return listings::gg3_relaxed(uv(b, lane), K(b, lane),
                                          cones_of(b, TextureSlot::relaxed_cone));
         },
         "relaxed-cone"},
        {"sphere-3d@published",
         [=](Batch<float>& b, int lane) {
             const SampledTexture& map = *b.bound(TextureSlot::distance);
             const float layers = static_cast<float>(map.view.faces), width = map_size(b).x;
             const auto volume = [&](const ConeVec3& p) {
                 const float at = clamp(p.z * layers - 0.5f, 0.0f, layers - 1.0f);
                 const int below = static_cast<int>(at);
                 const int above = std::min(below + 1, map.view.faces - 1);
                 const ConeVec2 xy(p.x, p.y);
                 return lerp(read_map<1>(map, xy, below)[0], read_map<1>(map, xy, above)[0],
                             at - static_cast<float>(below));
             };
             return listings::donnelly(uv(b, lane), ConeVec3(K(b, lane) * (width / layers), -1.0f),
                                       layers, width, volume);
         },
         "sphere-3d"},
    };
}

/// hit.uv and hit.s of the stage are the listing's, bit for bit, in every lane.
testing::AssertionResult is_the_listing(const ConeListing& listing, const Search& stage, int seed) {
    ConeBatch<float> cones(seed);
    Batch<float>& batch = cones.batch;
    batch.material.seat = 1;
    Batch<float> expected = batch;
    stage.run(batch);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const ConeEnd end = listing.run(expected, lane);
        expected.set(Value::hit_uv, lane, end.uv);
        expected.real(Value::hit_s, lane) = end.s;
    }
    return same_bits<float>(expected, batch, values(Value::hit_uv, Value::hit_s));
}

TEST(ConeListings, StagesHaveTheirBits) {
    for (const ConeListing& listing : cone_listings()) {
        for (int seed = 0; seed < 6; ++seed)
            EXPECT_TRUE(is_the_listing(listing, {listing.id}, seed)) << listing.id;
        EXPECT_FALSE(is_the_listing(listing, {listing.corrected}, 0)) << listing.id;
        const auto nudge = [](Batch<float>& b) { b.real(Value::K, 5) *= 1.001f; };
        EXPECT_FALSE(is_the_listing(listing, {listing.id, nudge}, 0)) << listing.id;
    }
}

/// What is interpolated is the root: not so if the map were squared before.
TEST(ConeListings, RootsAreInterpolated) {
    const ConeListing rabbid = {"cone-rabbid",
                                [](Batch<float>& b, int lane) {
                                    return rabbid_by(b, lane,
                                                     squared_first(b, TextureSlot::cone_rabbid));
                                },
                                {}};
    const ConeListing dummer = {
        "cone-dummer-exact",
        [](Batch<float>& b, int lane) {
            return dummer_by(b, lane, roots_of_interpolated(cones_of(b, TextureSlot::cone)));
        },
        {}};
    for (const ConeListing& flawed : {rabbid, dummer}) {
        const auto equals = [&](int seed) -> bool {
            return is_the_listing(flawed, {flawed.id}, seed);
        };
        EXPECT_FALSE(equals(1) && equals(2) && equals(3))
            << flawed.id << " " << static_cast<int>(Planted::interpolated_squares);
    }
}

// ---- What the corrected ones promise ------------------------------------------------------------

const std::vector<std::string> corrected_rows = {
    "cone-step",   "cone-robust", "cone-robust-exact", "relaxed-cone", "relaxed-cone-exact",
    "cone-hybrid", "cone-quad",   "cone-aniso",        "sphere-3d"};

/// Straight down the height at uv is met, within `tolerance`.
template <PlainFloat T>
testing::AssertionResult meets_straight_down(const std::string& id, double nudge) {
    ConeBatch<T> cones(3);
    for (int lane = 0; lane < cones.batch.lanes; ++lane) cones.batch.set(Value::K, lane, dvec2(0));
    cones.batch.run(id, id == "sphere-3d" ? Parameters{{"steps", 4000}} : Parameters());
    // Volumes are coarse: walls beside the ray stop it, too.
    const double tolerance = id == "sphere-3d" ? 1 : 1.0 / 1000;
    for (int lane = 0; lane < cones.batch.lanes; ++lane) {
        const double expected = 1 - cones.height_at(lane, 0);
        const double s = cones.batch.real(Value::hit_s, lane) + nudge;
        if (!(s <= expected + 1e-5) || !(s >= expected - tolerance))
            return testing::AssertionFailure() << id << ": " << s << ", expected " << expected;
    }
    return testing::AssertionSuccess();
}

TEST(Cones, MeetTheHeightStraightDown) {
    for (const std::string& id : corrected_rows) {
        EXPECT_TRUE(meets_straight_down<float>(id, 0));
        EXPECT_TRUE(meets_straight_down<double>(id, 0));
        EXPECT_FALSE(meets_straight_down<float>(id, id == "sphere-3d" ? 1 : 0.01)) << id;
    }
}

/// A border's texels are 0: no cone at all, which a ray straight down does not need.
TEST(Cones, StraightDownNeedsNoCone) {
    const Map bare = make_map(
        4, 4, 2, [](int, int, int c) { return c == 0 ? 0.25f : 0.0f; }, plain_sampler());
    for (const double shift : {0.0, 1e-5, 2e-4}) {  // all of them straight down, once normalised
        ConeBatch<float> cones(3);
        cones.batch.bind(TextureSlot::cone, bare.sampled);
        for (int lane = 0; lane < cones.batch.lanes; ++lane)
            cones.batch.set(Value::K, lane, dvec2(shift, 0));
        cones.batch.run("cone-dummer-exact");
        // A step is a texel longer than the cone's, and the end goes back by a texel.
        for (int lane = 0; lane < cones.batch.lanes; ++lane)
            EXPECT_NEAR(cones.batch.real(Value::hit_s, lane), 0.75, 1.0 / 4) << shift;
    }
}

/// How many of a batch's rays are behind the oracle's hit by more than `late` texels, and before it
/// by more than `early`.
struct Misses {
    int late = 0, early = 0, capped = 0, rays = 0;
};

template <PlainFloat T>
Misses count_misses(const Search& stage, double early, double late) {
    Misses misses;
    for (int seed = 0; seed < 8; ++seed) {
        ConeBatch<T> cones(seed);
        if constexpr (std::same_as<T, float>) {
            stage.run(cones.batch);
        } else {
            cones.batch.run(stage.id);
        }
        for (int lane = 0; lane < cones.batch.lanes; ++lane) {
            const auto status = static_cast<Status>(cones.batch.integer(Value::hit_status, lane));
            ++misses.rays;
            misses.capped += status == Status::cap;
            if (status != Status::hit) continue;
            const double texels = cones.texels_behind_the_oracle(lane);
            misses.late += texels > late;
            misses.early += texels < -early;
        }
    }
    return misses;
}

/// Conservative searches stop before the surface or on it; exact patches on it.
TEST(Cones, SpheresNeverPassTheSurface) {
    EXPECT_EQ(count_misses<float>({"sphere-3d"}, 1e9, 0.01).late, 0);
    EXPECT_EQ(count_misses<double>({"sphere-3d"}, 1e9, 0.01).late, 0);
    const auto advance = [](Batch<float>& b) {
        for (int lane = 0; lane < b.lanes; ++lane) b.real(Value::hit_s, lane) += 0.3f;
    };
    EXPECT_GT(count_misses<float>({"sphere-3d", {}, advance}, 1e9, 0.01).late, 0);
}

TEST(Cones, ExactPatchesAreNeverEarly) {
    const Misses misses = count_misses<float>({"cone-robust-exact"}, 0.01, 1);
    EXPECT_EQ(misses.early, 0);
    EXPECT_EQ(misses.capped, 0);
    EXPECT_LT(misses.late, misses.rays / 50);
}

/// Bisection ends at or behind a crossing: early by no more than rounding.
TEST(Cones, BisectedHitsAreNeverEarly) {
    for (const char* id : {"cone-robust", "relaxed-cone-exact"}) {
        const Misses misses = count_misses<float>({id}, 0.05, 1);
        EXPECT_EQ(misses.early, 0) << id;
        EXPECT_LT(misses.late, misses.rays / 20) << id;
    }
}

/// A hit is within the tolerance of the surface, wherever it is.
testing::AssertionResult ends_at_the_surface(const Search& stage) {
    ConeBatch<float> cones(11);
    stage.run(cones.batch);
    for (int lane = 0; lane < cones.batch.lanes; ++lane) {
        if (cones.batch.integer(Value::hit_status, lane) != static_cast<int>(Status::hit)) continue;
        const double s = cones.batch.real(Value::hit_s, lane);
        const double gap = (1 - s) - cones.height_at(lane, s);
        if (gap > 1.0 / 1000) return testing::AssertionFailure() << stage.id << ": gap " << gap;
    }
    return testing::AssertionSuccess();
}

TEST(Cones, HitsAreAtTheSurface) {
    for (const std::string& id : corrected_rows) {
        if (id != "sphere-3d") {
            EXPECT_TRUE(ends_at_the_surface({id}));
        }
    }
    const auto lift = [](Batch<float>& b) {
        for (int lane = 0; lane < b.lanes; ++lane) b.real(Value::hit_s, lane) -= 0.01f;
    };
    EXPECT_FALSE(ends_at_the_surface({"cone-step", {}, lift}));
}

}  // namespace
}  // namespace quadrel::test
